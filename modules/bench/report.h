// SPDX-License-Identifier: MIT
#pragma once
// What a benchmark found, as text for a terminal and as one HTML file that needs nothing else: pictures and curves are inside of it.

#include "servers/core/error.h"

#include <string>
#include <vector>

namespace lucent {

// Text that stands for itself in HTML and SVG.
std::string html_escape(const std::string &p_text);

struct ReportTable {
	std::vector<std::string> columns; // the first is left-aligned, the others right
	std::vector<std::vector<std::string>> rows;
};

// Aligned columns, a line a row, each ending in a newline.
std::string table_text(const ReportTable &p_table);

struct ReportSeries {
	std::string name;
	std::vector<double> x;
	std::vector<double> y;
};

struct ReportChart {
	std::string title;
	std::string x_label;
	std::string y_label;
	bool log_x = false; // values of 0 and below are left out on logarithmic axes
	bool log_y = false;
	std::vector<ReportSeries> series; // at most 8
};

class HtmlReport {
public:
	// p_subtitle: conditions that hold for everything.
	HtmlReport(const std::string &p_title, const std::string &p_subtitle);
	void heading(const std::string &p_text);
	void paragraph(const std::string &p_text);
	void table(const ReportTable &p_table);
	void chart(const ReportChart &p_chart);
	// The .png is read now and goes into the file. Fails where it can't be read.
	Status picture(const std::string &p_path, const std::string &p_caption);
	// The whole document.
	std::string text() const;

private:
	std::string title;
	std::string body;
};

} // namespace lucent
