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

// Notes that the running case does nothing because the device lacks p_feature. No other reason for a skip is accepted.
void note_missing_feature(const std::string &p_feature);

} // namespace lucent::test

// Ends the running case: SKIP_MISSING_FEATURE("timestamps");
#define SKIP_MISSING_FEATURE(m_feature) \
	do { \
		::lucent::test::note_missing_feature(m_feature); \
		return; \
	} while (false)
