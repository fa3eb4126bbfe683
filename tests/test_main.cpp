// SPDX-License-Identifier: MIT
// bin/lucent_tests [--gpu | --gpu-only] [--device NAME] [--filter TEXT] [--root DIR] [--results FILE] [doctest options]
// Runs the cases outside of the suite "gpu"; --gpu runs all, --gpu-only those alone. Exit code 0: every case passed.

#define DOCTEST_CONFIG_IMPLEMENT
#include "tests/test_support.h"

#include <doctest/doctest.h>

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

namespace lucent::test {
namespace {

struct Counts {
	int passed = 0;
	int failed = 0;
	int skipped = 0;
};

Options test_options = { "", "./" };
std::string results_path;
std::string missing; // why the running case was skipped
Counts counts;

// Rewritten after every case, so that a crash leaves the counts up to it.
void write_results() {
	if (results_path.empty()) {
		return;
	}
	if (std::FILE *file = std::fopen(results_path.c_str(), "w")) {
		std::fprintf(file, "%d %d %d\n", counts.passed, counts.failed, counts.skipped);
		std::fclose(file);
	}
}

struct CountingListener final : doctest::IReporter {
	const doctest::TestCaseData *current = nullptr;

	explicit CountingListener(const doctest::ContextOptions &) {}
	void report_query(const doctest::QueryData &) override {}
	void test_run_start() override {}
	void test_run_end(const doctest::TestRunStats &) override { write_results(); }
	void test_case_start(const doctest::TestCaseData &p_case) override {
		current = &p_case;
		missing.clear();
	}
	void test_case_reenter(const doctest::TestCaseData &) override {}
	void test_case_end(const doctest::CurrentTestCaseStats &p_stats) override {
		const char *verdict = "ok";
		if (!p_stats.testCaseSuccess) {
			counts.failed++;
			verdict = "FAILED";
		} else if (!missing.empty()) {
			counts.skipped++;
			verdict = "skipped";
		} else {
			counts.passed++;
		}
		std::printf("%-7s %6.2f s  %s%s%s\n", verdict, p_stats.seconds, current->m_name, missing.empty() ? "" : ": ", missing.c_str());
		std::fflush(stdout);
		write_results();
	}
	void test_case_exception(const doctest::TestCaseException &) override {}
	void subcase_start(const doctest::SubcaseSignature &) override {}
	void subcase_end() override {}
	void log_assert(const doctest::AssertData &) override {}
	void log_message(const doctest::MessageData &) override {}
	void test_case_skipped(const doctest::TestCaseData &p_case) override {
		if (p_case.m_skip) {
			std::printf("FAILED           %s: disabled in the source, which is not a reason to skip\n", p_case.m_name);
			counts.failed++;
		}
	}
};
REGISTER_LISTENER("counts", 1, CountingListener);

enum class Selection {
	UNIT,
	ALL,
	GPU
};

// Takes our options out of p_arguments; what is left is doctest's. False: an option lacks its value.
bool take_options(std::vector<char *> &r_arguments, Selection &r_selection, std::string &r_filter) {
	const struct {
		const char *name;
		std::string *value;
	} valued[] = { { "--device", &test_options.device }, { "--filter", &r_filter }, { "--root", &test_options.root }, { "--results", &results_path } };
	std::vector<char *> rest = { r_arguments[0] };
	for (size_t i = 1; i < r_arguments.size(); i++) {
		const char *argument = r_arguments[i];
		bool taken = false;
		for (const auto &option : valued) {
			if (std::strcmp(argument, option.name) == 0) {
				if (i + 1 == r_arguments.size()) {
					std::fprintf(stderr, "lucent_tests: %s needs a value\n", argument);
					return false;
				}
				*option.value = r_arguments[++i];
				taken = true;
			}
		}
		if (std::strcmp(argument, "--gpu") == 0) {
			r_selection = Selection::ALL;
		} else if (std::strcmp(argument, "--gpu-only") == 0) {
			r_selection = Selection::GPU;
		} else if (!taken) {
			rest.push_back(r_arguments[i]);
		}
	}
	r_arguments = rest;
	return true;
}

} // namespace

const Options &options() {
	return test_options;
}

std::string program() {
	std::error_code error;
	std::string path = std::filesystem::read_symlink("/proc/self/exe", error).string();
	const size_t at = path.rfind("lucent_tests");
	REQUIRE(at != std::string::npos);
	return path.replace(at, std::strlen("lucent_tests"), "lucent");
}

void note_missing(const std::string &p_reason) {
	missing = p_reason;
}

} // namespace lucent::test

int main(int p_argument_count, char **p_arguments) {
	using namespace lucent::test;
	std::vector<char *> arguments(p_arguments, p_arguments + p_argument_count);
	Selection selection = Selection::UNIT;
	std::string filter;
	if (!take_options(arguments, selection, filter)) {
		return 2;
	}
	if (!test_options.root.ends_with('/')) {
		test_options.root += '/';
	}

	doctest::Context context;
	context.setOption("no-version", true);
	context.setOption("minimal", true);
	context.applyCommandLine(int(arguments.size()), arguments.data());
	if (selection != Selection::ALL) {
		context.addFilter(selection == Selection::GPU ? "test-suite" : "test-suite-exclude", "gpu");
	}
	if (!filter.empty()) {
		context.addFilter("test-case", ("*" + filter + "*").c_str());
	}
	const int result = context.run();
	if (context.shouldExit()) { // a query such as --list-test-cases
		return result;
	}
	std::printf("%d passed, %d failed, %d skipped\n", counts.passed, counts.failed, counts.skipped);
	return counts.failed == 0 && result == 0 ? 0 : 1;
}
