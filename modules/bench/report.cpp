// SPDX-License-Identifier: MIT
#include "modules/bench/report.h"

#include "servers/core/file_io.h"

#include <algorithm>

namespace lucent {

namespace {

constexpr const char *STYLE = "body{font:15px/1.45 system-ui,sans-serif;margin:2em auto;max-width:1200px;padding:0 1em;color:#222;background:#fff}"
							  "h1{font-size:1.6em;margin-bottom:0}h2{font-size:1.2em;margin-top:2em}p.sub{color:#666;margin-top:.3em}"
							  "table{border-collapse:collapse;font-variant-numeric:tabular-nums;margin:1em 0}"
							  "td,th{padding:.25em .7em;border-bottom:1px solid #ddd;text-align:right}td:first-child,th:first-child{text-align:left}td{white-space:nowrap}"
							  "figure{margin:1em 0}img{width:min(100%,960px);image-rendering:pixelated}figcaption{color:#555;font-size:.9em}"
							  "svg{max-width:100%;height:auto;font:12px system-ui,sans-serif}";

std::string base64(std::span<const std::byte> p_bytes) {
	static constexpr char LETTERS[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
	std::string result;
	for (size_t i = 0; i < p_bytes.size(); i += 3) {
		const size_t count = std::min<size_t>(3, p_bytes.size() - i);
		uint32_t bits = 0;
		for (size_t k = 0; k < 3; k++) {
			bits = bits << 8 | (k < count ? uint32_t(p_bytes[i + k]) : 0u);
		}
		for (size_t k = 0; k < 4; k++) {
			result += k <= count ? LETTERS[(bits >> (18 - 6 * k)) & 63] : '=';
		}
	}
	return result;
}

// Columns on a terminal, not bytes: UTF-8's later bytes take no place.
size_t text_width(const std::string &p_text) {
	return size_t(std::count_if(p_text.begin(), p_text.end(), [](char c) { return (uint8_t(c) & 0xC0) != 0x80; }));
}

} // namespace

std::string html_escape(const std::string &p_text) {
	std::string result;
	for (const char c : p_text) {
		switch (c) {
			case '<':
				result += "&lt;";
				break;
			case '>':
				result += "&gt;";
				break;
			case '&':
				result += "&amp;";
				break;
			case '"':
				result += "&quot;";
				break;
			default:
				result += c;
		}
	}
	return result;
}

std::string table_text(const ReportTable &p_table) {
	std::vector<std::vector<std::string>> lines = { p_table.columns };
	lines.insert(lines.end(), p_table.rows.begin(), p_table.rows.end());
	std::vector<size_t> widths(p_table.columns.size());
	for (const std::vector<std::string> &line : lines) {
		for (size_t i = 0; i < line.size() && i < widths.size(); i++) {
			widths[i] = std::max(widths[i], text_width(line[i]));
		}
	}
	std::string text;
	for (const std::vector<std::string> &line : lines) {
		std::string row;
		for (size_t i = 0; i < line.size() && i < widths.size(); i++) {
			const std::string space(widths[i] - text_width(line[i]), ' ');
			row += (i == 0 ? "" : "  ") + (i == 0 ? line[i] + space : space + line[i]);
		}
		text += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
	}
	return text;
}

HtmlReport::HtmlReport(const std::string &p_title, const std::string &p_subtitle) :
		title(html_escape(p_title)), body("<h1>" + title + "</h1>\n<p class=\"sub\">" + html_escape(p_subtitle) + "</p>\n") {}

void HtmlReport::heading(const std::string &p_text) {
	body += "<h2>" + html_escape(p_text) + "</h2>\n";
}

void HtmlReport::paragraph(const std::string &p_text) {
	body += "<p>" + html_escape(p_text) + "</p>\n";
}

void HtmlReport::table(const ReportTable &p_table) {
	const auto row = [](const std::vector<std::string> &p_cells, const std::string &p_tag) {
		std::string text = "<tr>";
		for (const std::string &cell : p_cells) {
			text += "<" + p_tag + ">" + html_escape(cell) + "</" + p_tag + ">";
		}
		return text + "</tr>\n";
	};
	body += "<table>\n" + row(p_table.columns, "th");
	for (const std::vector<std::string> &cells : p_table.rows) {
		body += row(cells, "td");
	}
	body += "</table>\n";
}

Status HtmlReport::picture(const std::string &p_path, const std::string &p_caption) {
	const Result<std::vector<std::byte>> bytes = read_file(p_path);
	if (!bytes) {
		return bytes.error();
	}
	body += "<figure><img alt=\"" + html_escape(p_caption) + "\" src=\"data:image/png;base64," + base64(bytes.value()) + "\"><figcaption>" + html_escape(p_caption) + "</figcaption></figure>\n";
	return Ok();
}

std::string HtmlReport::text() const {
	return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + title + "</title><style>" + STYLE + "</style></head>\n<body>\n" + body + "</body></html>\n";
}

} // namespace lucent
