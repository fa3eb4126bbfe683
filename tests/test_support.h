// SPDX-License-Identifier: MIT
#pragma once
// What the test program offers to its tests. Cases that need a GPU sit in TEST_SUITE("gpu").

#include <string>

namespace lucent::test {

struct Options {
	std::string device; // --device NAME: index or part of the name; empty: the default choice
	std::string root; // the repository, with a trailing slash; data files are root + "tests/data/..."
};
const Options &options();

// The program beside the test program, of the same build.
std::string program();

// Notes that the running case does nothing for what is missing: "the device lacks timestamps". No other reason for a skip is accepted.
void note_missing(const std::string &p_reason);

} // namespace lucent::test

// Ends the running case: SKIP_MISSING_FEATURE("timestamps");
#define SKIP_MISSING_FEATURE(m_feature) \
	do { \
		::lucent::test::note_missing(std::string("the device lacks ") + m_feature); \
		return; \
	} while (false)
// For a program that `./lucent test` installs, so that only a test program carried to another machine can lack it.
#define SKIP_MISSING_TOOL(m_program) \
	do { \
		::lucent::test::note_missing(std::string("the machine lacks the program ") + m_program); \
		return; \
	} while (false)
