// SPDX-License-Identifier: MIT
#pragma once
// Godot's text form of values: 1, 2.5, "text", &"name", ^"a/path", true, null, Color(1, 0, 0, 1), [1, 2], { "key": 1 },
// PackedFloat32Array(…), Array[int]([1]), SubResource("id"), ExtResource("id"), Resource("res://…").

#include "modules/tscn/tscn_tokenizer.h"
#include "servers/core/variant.h"

#include <functional>
#include <string_view>

namespace lucent {

enum class TscnReference : uint8_t {
	SUB_RESOURCE,
	EXT_RESOURCE,
	PATH
};

// Answers SubResource("id"), ExtResource("id") and Resource("path"). The error needs no file or line.
using TscnResolver = std::function<Result<Variant>(TscnReference p_kind, const std::string &p_id)>;

// Takes one value from the text. False: see the tokenizer's error().
bool parse_variant(TscnTokenizer &r_tokenizer, const TscnResolver &p_resolver, Variant &r_value);

// A whole text that is one value, without resources. p_source names it in messages.
Result<Variant> parse_variant_text(std::string_view p_text, const std::string &p_source);

} // namespace lucent
