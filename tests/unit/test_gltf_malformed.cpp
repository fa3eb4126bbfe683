// SPDX-License-Identifier: MIT
// Each broken file is one error that says where, in bounded time and memory.
#include "tests/unit/gltf_builder.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace lucent;
using lucent::test::GltfBuilder;
using lucent::test::one_primitive;
using lucent::test::parse_text;

namespace {

const std::vector<float> TRIANGLE = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };

void check_error(const Result<GltfDocument> &p_result, const std::string &p_expected) {
	REQUIRE_MESSAGE(!p_result.ok(), p_expected);
	CHECK_MESSAGE(p_result.error().message.find(p_expected) != std::string::npos, p_result.error().message << " should contain " << p_expected);
	CHECK(p_result.error().message.find('\n') == std::string::npos);
}

// p_more: more of the top level, with a leading comma.
Result<GltfDocument> parse_members(const std::string &p_more) {
	return parse_text("{\"asset\":{\"version\":\"2.0\"}" + p_more + "}");
}

} // namespace

TEST_CASE("glTF: a missing, empty or unreadable file is named") {
	check_error(load_gltf("/nonexistent/a.glb"), "/nonexistent/a.glb: cannot read: No such file");
	check_error(parse_text(""), "test.gltf: the file is empty");
	check_error(parse_text("{"), "test.gltf: expected JSON: parse error at line 1, column 2");
	check_error(parse_text("[]"), "test.gltf: /: expected an object, found array");
	check_error(parse_text("{}"), "/asset/version: expected a string");
	check_error(parse_text("{\"asset\":{\"version\":\"1.0\"}}"), "/asset/version: expected glTF 2.x, found '1.0'");
	check_error(parse_text(std::string(100000, '[')), "nested deeper than 512 levels");
	check_error(parse_members(",\"extensionsRequired\":[\"EXT_made_up\"]"), "/extensionsRequired/0: the file needs the extension 'EXT_made_up'");
}

TEST_CASE("glTF: a .glb cut anywhere is an error") {
	GltfBuilder builder;
	builder.add(TRIANGLE, "VEC3", 5126, 3);
	const std::vector<std::byte> file = builder.glb(one_primitive("\"attributes\":{\"POSITION\":0}"));
	REQUIRE(parse_gltf(file, "test.glb", nullptr).ok());
	for (size_t size = 0; size < file.size(); size++) {
		const Result<GltfDocument> cut = parse_gltf(std::span(file).first(size), "test.glb", nullptr);
		REQUIRE(!cut.ok());
		CHECK(cut.error().message.starts_with("test.glb: "));
	}
}

TEST_CASE("glTF: buffers are as long as they say and external ones are looked up safely") {
	check_error(parse_members(R"(,"buffers":[{"byteLength":9,"uri":"data:;base64,AAAA"}])"), "/buffers/0/byteLength: the buffer should have 9 bytes, found 3");
	check_error(parse_members(R"(,"buffers":[{"byteLength":3,"uri":"data:;base64,A!AA"}])"), "/buffers/0/uri: the data is not base64");
	check_error(parse_members(R"(,"buffers":[{"byteLength":3,"uri":"/etc/passwd"}])"), "/buffers/0/uri: expected a relative path");
	check_error(parse_members(R"(,"buffers":[{"byteLength":3,"uri":"http://example.org/a.bin"}])"), "/buffers/0/uri: expected a relative path");
	check_error(parse_members(R"(,"buffers":[{"byteLength":3,"uri":"a%00.bin"}])"), "/buffers/0/uri: expected a relative path");
	const std::string external = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":3,"uri":"with%20space/a.bin"}]})";
	std::string asked;
	const GltfFileReader reader = [&asked](const std::string &p_uri) -> Result<std::vector<std::byte>> {
		asked = p_uri;
		return make_error("{}: cannot read: No such file or directory", p_uri);
	};
	check_error(parse_gltf(lucent::test::text_bytes(external), "test.gltf", reader), "test.gltf: /buffers/0/uri: with space/a.bin: cannot read: No such file");
	CHECK(asked == "with space/a.bin");
}

TEST_CASE("glTF: buffer views and accessors stay inside their bytes") {
	const std::string buffer = R"(,"buffers":[{"byteLength":12,"uri":"data:;base64,AAAAAAAAAAAAAAAA"}])";
	const auto with = [&](const std::string &p_view, const std::string &p_accessor) {
		return parse_members(buffer + ",\"bufferViews\":[{\"buffer\":0" + p_view + "}],\"accessors\":[{" + p_accessor + "}]");
	};
	check_error(with(",\"byteLength\":13", ""), "/bufferViews/0: bytes 0 to 13 are outside the buffer of 12 bytes");
	check_error(with(",\"byteOffset\":8,\"byteLength\":8", ""), "/bufferViews/0: bytes 8 to 16 are outside");
	check_error(with(",\"byteOffset\":18446744073709551615,\"byteLength\":8", ""), "/bufferViews/0/byteOffset: expected an integer from 0");
	check_error(with(",\"byteLength\":-1", ""), "/bufferViews/0/byteLength: expected an integer");
	const std::string floats = R"("bufferView":0,"componentType":5126,"type":"VEC3")";
	check_error(with(",\"byteLength\":12", floats + ",\"count\":2"), "/accessors/0: 2 elements from byte 0 need 24 bytes, the buffer view has 12");
	check_error(with(",\"byteLength\":12", floats + ",\"count\":4294967296"), "/accessors/0/count: expected an integer from 0 to 4294967294");
	check_error(with(",\"byteLength\":12", floats + ",\"count\":1.5"), "/accessors/0/count: expected an integer");
	check_error(with(",\"byteLength\":12", floats + ",\"count\":4294967294"), "/accessors/0: 4294967294 elements from byte 0 need 51539607528 bytes");
	check_error(with(",\"byteLength\":12,\"byteStride\":8", floats + ",\"count\":1"), "/accessors/0: elements of 12 bytes do not fit bufferViews/0's byteStride of 8");
	check_error(with(",\"byteLength\":12,\"byteStride\":4294967296", floats + ",\"count\":1"), "/bufferViews/0/byteStride: expected an integer from 0 to 252");
	check_error(with(",\"byteLength\":12", R"("componentType":5124,"type":"VEC3","count":1)"), "/accessors/0/componentType: expected 5120");
	check_error(with(",\"byteLength\":12", R"("componentType":5126,"type":"VEC9","count":1)"), "/accessors/0/type: expected SCALAR");
	check_error(with(",\"byteLength\":12", R"("bufferView":7,"componentType":5126,"type":"VEC3","count":1)"), "/accessors/0/bufferView: expected an integer from 0 to 0, found 7");
	const std::string sparse = R"("componentType":5126,"type":"SCALAR","count":3,"sparse":{"count":2,"indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0}})";
	check_error(with(",\"byteLength\":12", sparse), "/accessors/0/sparse/indices: index 1 is 0: expected ascending indices below 3");
}

TEST_CASE("glTF: an accessor of 4 G elements without bytes is refused before it is allocated") {
	check_error(parse_members(R"(,"accessors":[{"componentType":5126,"type":"VEC3","count":4294967294}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])"),
			"bytes for a whole file");
}

TEST_CASE("glTF: indices, positions and attribute counts are checked") {
	GltfBuilder builder;
	builder.add(TRIANGLE, "VEC3", 5126, 3);
	builder.add(std::vector<uint16_t>{ 0, 1, 3, 0 }, "SCALAR", 5123, 3);
	std::vector<float> broken = TRIANGLE;
	broken[4] = NAN;
	builder.add(broken, "VEC3", 5126, 3);
	broken[4] = INFINITY;
	builder.add(broken, "VEC3", 5126, 3);
	builder.add(std::vector<float>{ 0, 0, 0, 0 }, "VEC2", 5126, 2);
	builder.add(TRIANGLE, "VEC2", 5126, 3);
	check_error(builder.parse(one_primitive("\"attributes\":{\"POSITION\":0},\"indices\":1")), "test.glb: /meshes/0/primitives/0/indices: index 2 is 3, the primitive has 3 vertices");
	check_error(builder.parse(one_primitive("\"attributes\":{\"POSITION\":2}")), "/meshes/0/primitives/0/attributes/POSITION: element 1 is not a finite number");
	check_error(builder.parse(one_primitive("\"attributes\":{\"POSITION\":3}")), "/meshes/0/primitives/0/attributes/POSITION: element 1 is not a finite number");
	check_error(builder.parse(one_primitive("\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":4}")), "TEXCOORD_0: expected 3 elements as in POSITION, found 2");
	check_error(builder.parse(one_primitive("\"attributes\":{\"POSITION\":9}")), "POSITION: expected an integer from 0 to 5, found 9");
	check_error(builder.parse(one_primitive("\"attributes\":{\"POSITION\":5}")), "POSITION: expected 3 components, found 2");
	check_error(builder.parse(one_primitive("\"attributes\":{\"POSITION\":0},\"indices\":0")), "expected SCALAR");
	check_error(builder.parse(one_primitive("\"attributes\":{\"POSITION\":0},\"material\":0")), "/meshes/0/primitives/0/material: refers to an array that is missing");
	check_error(builder.parse(one_primitive("\"attributes\":{\"POSITION\":0},\"mode\":7")), "/meshes/0/primitives/0/mode: expected an integer from 0 to 6, found 7");
}

TEST_CASE("glTF: the hierarchy is a forest of bounded depth") {
	check_error(parse_members(R"(,"nodes":[{"children":[0]}])"), "/nodes/0: the node is its own ancestor");
	check_error(parse_members(R"(,"nodes":[{},{"children":[2]},{"children":[3]},{"children":[1]}])"), "the node is its own ancestor");
	check_error(parse_members(R"(,"nodes":[{"children":[2]},{"children":[2]},{}])"), "/nodes/1/children/0: node 2 already has the parent 0");
	check_error(parse_members(R"(,"nodes":[{"children":[5]}])"), "/nodes/0/children/0: expected an integer from 0 to 0, found 5");
	check_error(parse_members(R"(,"nodes":[{"children":[1]},{}],"scenes":[{"nodes":[1]}])"), "/scenes/0/nodes/0: node 1 is not a root");
	check_error(parse_members(R"(,"nodes":[{"mesh":0}])"), "/nodes/0/mesh: refers to an array that is missing");
	check_error(parse_members(R"(,"nodes":[{"translation":[1e300,0,0]}])"), "/nodes/0/translation/0: 1e+300 does not fit a 32-bit float");
	std::string chain = ",\"nodes\":[";
	for (int i = 0; i < 100000; i++) {
		chain += fmt::format("{{\"children\":[{}]}},", i + 1);
	}
	check_error(parse_members(chain + "{}]"), "the nodes are nested deeper than 256 levels");
}

TEST_CASE("glTF: wrong types anywhere are errors, not crashes") {
	for (const char *key : { "accessors", "bufferViews", "buffers", "cameras", "images", "materials", "meshes", "nodes", "scenes", "skins", "textures", "extensions" }) {
		for (const char *value : { "null", "true", "1", "\"text\"", "[null]", "[1]", "[[[]]]", "{\"a\":[]}" }) {
			const Result<GltfDocument> result = parse_members(fmt::format(",\"{}\":{}", key, value));
			if (!result.ok()) {
				CHECK(result.error().message.starts_with("test.gltf: /"));
			}
		}
	}
	check_error(parse_members(",\"meshes\":3"), "test.gltf: /meshes: expected an array, found number");
}

TEST_CASE("glTF: broken compressed data is an error") {
	const std::string buffer = R"(,"buffers":[{"byteLength":12,"uri":"data:;base64,AAAAAAAAAAAAAAAA"}])";
	check_error(parse_members(buffer + R"(,"bufferViews":[{"buffer":0,"byteLength":12,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteLength":12,"byteStride":4,"count":3,"mode":"ATTRIBUTES"}}}])"),
			"/bufferViews/0/extensions/EXT_meshopt_compression: broken meshopt data");
	check_error(parse_members(buffer + R"(,"bufferViews":[{"buffer":0,"byteLength":12}],"accessors":[{"componentType":5126,"type":"VEC3","count":3}],
		"meshes":[{"primitives":[{"attributes":{"POSITION":0},"extensions":{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0}}}}]}])"),
			"/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression: broken Draco data");
}

TEST_CASE("glTF: empty accessors and views are read around with a warning") {
	const std::string buffer = R"(,"buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteLength":0}])";
	const Result<GltfDocument> parsed = parse_members(buffer + R"(,"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3},{"componentType":5126,"type":"VEC3","count":0},
		{"bufferView":1,"componentType":5126,"type":"VEC3","count":0}],
		"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]},{"primitives":[{"attributes":{"POSITION":1}}]},{"primitives":[{"attributes":{"POSITION":2}}]}])");
	INFO(parsed.error().message);
	REQUIRE(parsed.ok());
	const GltfDocument &document = parsed.value();
	REQUIRE(document.meshes.size() == 3);
	CHECK(document.warnings.size() == 5); // a view, two accessors, two primitives
	CHECK(document.warnings[0].find("/bufferViews/1: the view is empty") != std::string::npos);
	CHECK(document.warnings[1].find("/accessors/1: the accessor is empty") != std::string::npos);
}

TEST_CASE("glTF: backslashes in URIs are slashes, and nothing more") {
	std::string asked;
	const GltfFileReader reader = [&asked](const std::string &p_uri) -> Result<std::vector<std::byte>> {
		asked = p_uri;
		return std::vector<std::byte>(4);
	};
	const auto parse = [&](const std::string &p_uri) {
		return parse_gltf(lucent::test::text_bytes(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":")" + p_uri + "\"}]}"), "test.gltf", reader);
	};
	const Result<GltfDocument> parsed = parse("textures\\\\a.bin");
	REQUIRE(parsed.ok());
	CHECK(asked == "textures/a.bin");
	CHECK(parsed.value().warnings.size() == 1);
	CHECK_FALSE(parse("\\\\etc\\\\passwd").ok()); // an absolute path stays refused
	CHECK_FALSE(parse("C:\\\\a.bin").ok());
}
