// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace lucent {

// "; did you mean 'sdfgi_enabled'?" for the candidate nearest to p_word by edit distance, or "" where none is near.
std::string suggestion(const std::string &p_word, const std::vector<std::string> &p_candidates);

} // namespace lucent
