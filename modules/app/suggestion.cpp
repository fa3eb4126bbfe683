// SPDX-License-Identifier: MIT
#include "modules/app/suggestion.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace lucent {

// Levenshtein's distance, letters' case ignored.
static size_t edit_distance(const std::string &p_a, const std::string &p_b) {
	std::vector<size_t> row(p_b.size() + 1);
	std::iota(row.begin(), row.end(), size_t(0));
	for (size_t i = 0; i < p_a.size(); i++) {
		size_t diagonal = row[0];
		row[0] = i + 1;
		for (size_t j = 0; j < p_b.size(); j++) {
			const bool same = std::tolower(static_cast<unsigned char>(p_a[i])) == std::tolower(static_cast<unsigned char>(p_b[j]));
			const size_t replaced = diagonal + (same ? 0 : 1);
			diagonal = row[j + 1];
			row[j + 1] = std::min({ replaced, row[j] + 1, row[j + 1] + 1 });
		}
	}
	return row.back();
}

std::string suggestion(const std::string &p_word, const std::vector<std::string> &p_candidates, size_t p_most) {
	size_t best = (p_most > 0 ? p_most : std::max<size_t>(2, p_word.size() / 3)) + 1;
	const std::string *nearest = nullptr;
	for (const std::string &candidate : p_candidates) {
		const size_t distance = edit_distance(p_word, candidate);
		if (distance < best) {
			best = distance;
			nearest = &candidate;
		}
	}
	return nearest == nullptr ? "" : "; did you mean '" + *nearest + "'?";
}

} // namespace lucent
