// SPDX-License-Identifier: MIT
#pragma once
// What the steps of reading one file share.

#include "modules/gltf/gltf_document.h"
#include "modules/gltf/gltf_json.h"

#include <algorithm>

namespace lucent {

struct GltfContext {
	const std::string &name;
	const GltfFileReader &reader;
	const GltfLimits &limits;
	JsonView root;
	std::span<const std::byte> binary_chunk;
	bool has_binary_chunk = false;
	GltfDocument document;
	uint64_t decoded_bytes = 0;

	// Counts p_count * p_size bytes that are about to be read or made; fails above the limit, so before they are allocated.
	void charge(uint64_t p_count, uint64_t p_size, const JsonView &p_where) {
		const uint64_t left = limits.max_decoded_bytes - decoded_bytes;
		if (p_size != 0 && p_count > left / p_size) {
			p_where.fail("{} elements of {} bytes are more than the limit of {} bytes for a whole file", p_count, p_size, limits.max_decoded_bytes);
		}
		decoded_bytes += p_count * p_size;
	}

	template <typename... Args>
	void warn(fmt::format_string<Args...> p_format, Args &&...p_args) {
		add_message(document.warnings, fmt::format("{}: {}", name, fmt::format(p_format, std::forward<Args>(p_args)...)));
	}

	// A part that is left out because it can't be read.
	template <typename... Args>
	void report_error(fmt::format_string<Args...> p_format, Args &&...p_args) {
		add_message(document.errors, fmt::format("{}: {}", name, fmt::format(p_format, std::forward<Args>(p_args)...)));
	}

	static void add_message(std::vector<std::string> &r_messages, std::string p_message) {
		// A broken file may warn about each of its million elements; a person reads the first few.
		if (r_messages.size() < 100 && std::find(r_messages.begin(), r_messages.end(), p_message) == r_messages.end()) {
			r_messages.push_back(std::move(p_message));
		}
	}

	// The bytes behind "uri" (data: or external). Fails with a sentence.
	std::vector<std::byte> read_uri(const JsonView &p_uri);
};

} // namespace lucent
