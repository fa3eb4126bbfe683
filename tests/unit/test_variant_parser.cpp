// SPDX-License-Identifier: MIT
#include "modules/tscn/variant_parser.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace lucent;

namespace {

Variant parse(const std::string &p_text) {
	Result<Variant> value = parse_variant_text(p_text, "text");
	INFO(p_text, ": ", value.error().message);
	REQUIRE(value.ok());
	return value.take();
}

template <typename T>
T parse_as(const std::string &p_text) {
	const Variant value = parse(p_text);
	INFO(p_text, " is ", value.to_string());
	REQUIRE(value.get_if<T>() != nullptr);
	return *value.get_if<T>();
}

std::string failure(const std::string &p_text) {
	const Result<Variant> value = parse_variant_text(p_text, "text");
	CHECK_MESSAGE(!value.ok(), p_text);
	return value.error().message;
}

} // namespace

TEST_CASE("tscn values: numbers and words") {
	CHECK(parse_as<int64_t>("42") == 42);
	CHECK(parse_as<int64_t>("-7") == -7);
	CHECK(parse_as<int64_t>(" 9223372036854775807 ") == INT64_MAX);
	CHECK(parse_as<double>("1.5") == 1.5);
	CHECK(parse_as<double>("-1e-05") == -1e-05);
	CHECK(parse_as<double>("2.") == 2.0);
	CHECK(parse_as<double>(".5") == 0.5);
	CHECK(parse_as<double>("99999999999999999999") == 1e20);
	CHECK(parse_as<double>("1e999") == HUGE_VAL);
	CHECK(parse_as<double>("1e-999") == 0.0);
	CHECK(parse_as<double>("inf") == HUGE_VAL);
	CHECK(parse_as<double>("-inf") == -HUGE_VAL);
	CHECK(parse_as<double>("inf_neg") == -HUGE_VAL);
	CHECK(std::isnan(parse_as<double>("nan")));
	CHECK(parse_as<bool>("true"));
	CHECK_FALSE(parse_as<bool>("false"));
	CHECK(parse("null").is_nil());
}

TEST_CASE("tscn values: texts") {
	CHECK(parse_as<std::string>("\"plain; # [ text\"") == "plain; # [ text");
	CHECK(parse_as<std::string>(R"("a\"b\\c\n\t")") == "a\"b\\c\n\t");
	CHECK(parse_as<std::string>("\"two\nlines\"") == "two\nlines");
	CHECK(parse_as<std::string>(R"("\u00e9\u20AC\ud83d\ude00\U01F600")") == "é€😀😀");
	CHECK(parse_as<std::string>("&\"name\"") == "name");
	CHECK(parse_as<NodePath>("^\"A/B:c\"").text == "A/B:c");
	CHECK(parse_as<NodePath>("NodePath(\"../A\")").text == "../A");
	CHECK(parse_as<std::string>("; a comment\n\"after\"") == "after");
}

TEST_CASE("tscn values: constructors") {
	CHECK(parse_as<Vector2>("Vector2(1, 2)") == Vector2(1, 2));
	CHECK(parse_as<Vector3>("Vector3(1, -2.5, 3)") == Vector3(1, -2.5, 3));
	CHECK(parse_as<Vector4>("Vector4(1, 2, 3, 4)") == Vector4(1, 2, 3, 4));
	CHECK(parse_as<Color>("Color(1, 0.5, 0, 0.25)") == Color{ 1, 0.5f, 0, 0.25f });
	CHECK(parse_as<Color>("Color(1, 0.5, 0)") == Color{ 1, 0.5f, 0, 1 });
	CHECK(parse_as<Color>("#ff8000") == Color{ 1, 128.0f / 255.0f, 0, 1 });
	CHECK(parse_as<Quaternion>("Quaternion(0, 1, 0, 0)").y == 1.0f);
	// Godot writes rows; columns are the images of the axes.
	const Transform3D transform = parse_as<Transform3D>("Transform3D(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12)");
	CHECK(transform.basis[0] == Vector3(1, 4, 7));
	CHECK(transform.basis[2] == Vector3(3, 6, 9));
	CHECK(transform.origin == Vector3(10, 11, 12));
	CHECK(parse_as<Basis>("Basis(1, 2, 3, 4, 5, 6, 7, 8, 9)")[1] == Vector3(2, 5, 8));
	CHECK(parse_as<AABB>("AABB(1, 2, 3, 10, 20, 30)") == AABB{ Vector3(1, 2, 3), Vector3(11, 22, 33) });
	CHECK(parse_as<Array>("Rect2(1, 2, 3, 4)").size() == 4);
	CHECK(parse("RID()").is_nil());
}

TEST_CASE("tscn values: containers") {
	CHECK(parse_as<std::vector<float>>("PackedFloat32Array(0, 0.5, 1,)") == std::vector<float>{ 0, 0.5f, 1 });
	CHECK(parse_as<std::vector<int32_t>>("PackedInt32Array()").empty());
	CHECK(parse_as<std::vector<uint8_t>>("PackedByteArray(1, 2, 255)") == std::vector<uint8_t>{ 1, 2, 255 });
	CHECK(parse_as<std::vector<uint8_t>>("PackedByteArray(\"AQL/\")") == std::vector<uint8_t>{ 1, 2, 255 });
	CHECK(parse_as<std::vector<Vector3>>("PackedVector3Array(1, 2, 3, 4, 5, 6)")[1] == Vector3(4, 5, 6));
	CHECK(parse_as<std::vector<Color>>("PackedColorArray(0, 0, 0, 1)")[0] == Color{});
	CHECK(parse_as<std::vector<std::string>>("PackedStringArray(\"a\", \"b\")") == std::vector<std::string>{ "a", "b" });
	const Array array = parse_as<Array>("[1, \"two\", [3], ]");
	REQUIRE(array.size() == 3);
	CHECK(array[1] == Variant("two"));
	CHECK(parse_as<Array>("Array[int]([1, 2])").size() == 2);
	CHECK(parse_as<Array>("Array[ExtResource(\"1\")]([])").empty());
	const Dictionary dictionary = parse_as<Dictionary>("{\n\"a\": 1,\n&\"b\": Vector2(1, 2), 3: { }\n}");
	REQUIRE(dictionary.entries.size() == 3);
	CHECK(*dictionary.find("a") == Variant(1));
	CHECK(parse_as<Dictionary>("Dictionary[String, int]({ \"a\": 1 })").entries.size() == 1);
}

TEST_CASE("tscn values: what is wrong is said with its line") {
	CHECK(failure("") == "text:1: expected a value, found the end of the text");
	CHECK(failure("\n\nVector3(1, 2)") == "text:3: Vector3 takes 3 numbers, found 2");
	CHECK(failure("Vector3(1, 2, ") == "text:1: expected a number in Vector3, found the end of the text");
	CHECK(failure("Vector3(1 2 3)") == "text:1: expected ',' between numbers, found a number");
	CHECK(failure("\n\"open\n\n") == "text:2: this string has no closing quote");
	CHECK(failure("Gizmo(1)") == "text:1: there is no type 'Gizmo'");
	CHECK(failure("bogus") == "text:1: 'bogus' is no value");
	CHECK(failure("1 2") == "text:1: expected one value, found a number after it");
	CHECK(failure("1.2.3") == "text:1: malformed number '1.2.3'");
	CHECK(failure("PackedVector3Array(1, 2)") == "text:1: PackedVector3Array takes a multiple of 3 numbers, found 2");
	CHECK(failure("PackedByteArray(\"A*\")") == "text:1: PackedByteArray's text is not base64");
	CHECK(failure("ExtResource(\"1\")") == "text:1: ExtResource can't be used here");
	CHECK(failure(R"("\u12")").find("4 hexadecimal digits") != std::string::npos);
	CHECK(failure("{ \"a\" 1 }").find("expected ':'") != std::string::npos);
	CHECK(failure(std::string(100000, '[')).find("nested more than 64 deep") != std::string::npos);
	CHECK(failure(std::string("\x01", 1)).find("0x01") != std::string::npos);
	for (const char *text : { "[", "{", "[1,", "{1:", "Array[", "Array[int](", "PackedStringArray(\"a\"", "&", "^", "#12", "-", "\"\\", "\"\\u", "NodePath(", "SubResource(" }) {
		CHECK_FALSE(failure(text).empty());
	}
}
