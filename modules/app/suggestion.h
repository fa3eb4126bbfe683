// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace lucent {

// "; did you mean 'sdfgi_enabled'?" for the candidate nearest to p_word by edit distance, or "" where none is near: within p_most edits, by default a third
// of the word's letters, at least 2.
std::string suggestion(const std::string &p_word, const std::vector<std::string> &p_candidates, size_t p_most = 0);

} // namespace lucent
