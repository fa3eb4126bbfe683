// SPDX-License-Identifier: MIT
// What outlives a frame: memory, the pipeline cache, reloaded shaders, the choice of the device.
#include "drivers/vulkan/vulkan_driver.h"
#include "tests/gpu/gpu_fixture.h"
#include "tests/gpu/scoped_environment.h"
#include "tests/gpu/shaders/test_io.h"
#include "tests/test_support.h"

#include <doctest/doctest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

namespace lucent {
namespace {

namespace fs = std::filesystem;
using test::GpuFixture;
using test::ScopedEnvironment;

class ScopedFolder {
public:
	explicit ScopedFolder(const std::string &p_name) :
			path(fs::temp_directory_path() / fmt::format("lucent-test-{}-{}", getpid(), p_name)) {
		fs::remove_all(path);
		fs::create_directories(path);
	}
	~ScopedFolder() { fs::remove_all(path); }
	const fs::path path;
};

std::string read_file(const fs::path &p_path) {
	std::ifstream file(p_path, std::ios::binary);
	return std::string((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
}

void write_file(const fs::path &p_path, const std::string &p_text) {
	fs::create_directories(p_path.parent_path());
	std::ofstream(p_path, std::ios::binary) << p_text;
}

// One pass that needs a pipeline: 1 + 2.
uint32_t add_one_and_two(GpuFixture &r_fixture) {
	const OwnedBuffer source = r_fixture.buffer("source", std::vector<uint32_t>{ 1 });
	const OwnedBuffer target = r_fixture.buffer("target", 4);
	r_fixture.frame([&](PassRecorder &r_recorder) {
		r_recorder.compute("add", Shader::TEST_ADD).read(TEST_SOURCE, source).write(TEST_TARGET, target).constants(shader::TestConstants{ .count = 1, .value = 2 }).dispatch_threads(1);
	});
	return r_fixture.device().read_back_buffer<uint32_t>(target)[0];
}

TEST_SUITE_BEGIN("gpu");

TEST_CASE("lifetime: the pipeline cache is written, used, and rebuilt when it is corrupt") {
	const ScopedFolder folder("cache");
	const ScopedEnvironment cache("XDG_CACHE_HOME", folder.path.string());
	const auto use_device = [] {
		GpuFixture fixture;
		CHECK(add_one_and_two(fixture) == 3);
	};
	use_device();
	REQUIRE(fs::exists(folder.path / "lucent"));
	REQUIRE(std::distance(fs::directory_iterator(folder.path / "lucent"), fs::directory_iterator()) == 1); // no temporary file
	const fs::path file = fs::directory_iterator(folder.path / "lucent")->path();
	const std::string good = read_file(file);
	CHECK(good.size() > 64);
	use_device();
	for (const std::string &bad : { good.substr(0, good.size() / 2), good.substr(0, 10), std::string(), good.substr(0, good.size() - 1) + char(good.back() ^ 1) }) {
		write_file(file, bad);
		use_device();
		CHECK(read_file(file).size() == good.size());
	}
}

TEST_CASE("lifetime: a cache folder that can't be written is no error") {
	const ScopedFolder folder("readonly");
	write_file(folder.path / "file", "not a folder");
	const ScopedEnvironment cache("XDG_CACHE_HOME", (folder.path / "file").string());
	const ScopedEnvironment mesa("MESA_SHADER_CACHE_DISABLE", "true"); // Mesa's own cache would complain
	std::vector<std::string> messages;
	const LogHandler previous = set_log_handler([&](LogLevel, std::string_view p_message) { messages.emplace_back(p_message); });
	{
		GpuFixture fixture;
		CHECK(add_one_and_two(fixture) == 3);
	}
	set_log_handler(previous);
	CHECK(messages.empty());
}

TEST_CASE("lifetime: changed shaders are reloaded, broken ones keep their old code") {
	if (std::system("glslangValidator --version > /dev/null 2>&1") != 0) {
		SKIP_MISSING_TOOL("glslangValidator");
	}
	const ScopedFolder folder("reload");
	GpuFixture fixture;
	CHECK(add_one_and_two(fixture) == 3);
	const std::string path = "tests/gpu/shaders/test_add.comp.glsl";
	std::string text = read_file(test::options().root + path);
	REQUIRE(!text.empty());
	for (const char *include : { "tests/gpu/shaders/test_io.h", "servers/rendering/device/shader_interop.h" }) {
		write_file(folder.path / include, read_file(test::options().root + include));
	}
	CHECK_FALSE(fixture.device().reload_shaders(test::options().root)); // nothing is newer than the device
	const std::string sum = "] + constants.value";
	REQUIRE(text.find(sum) != std::string::npos);
	text.replace(text.find(sum), sum.size(), "] * 10 + constants.value");
	write_file(folder.path / path, text);
	CHECK(fixture.device().reload_shaders(folder.path.string()));
	CHECK(add_one_and_two(fixture) == 12);
	CHECK_FALSE(fixture.device().reload_shaders(folder.path.string()));

	std::vector<std::string> messages;
	const LogHandler previous = set_log_handler([&](LogLevel, std::string_view p_message) { messages.emplace_back(p_message); });
	write_file(folder.path / path, text + "\nsyntax error");
	CHECK_FALSE(fixture.device().reload_shaders(folder.path.string()));
	set_log_handler(previous);
	REQUIRE(messages.size() == 1);
	CHECK(messages[0].find("syntax error") != std::string::npos);
	CHECK(add_one_and_two(fixture) == 12);
	// A change of an included file counts too.
	write_file(folder.path / path, text);
	CHECK(fixture.device().reload_shaders(folder.path.string()));
	write_file(folder.path / "tests/gpu/shaders/test_io.h", read_file(test::options().root + "tests/gpu/shaders/test_io.h") + "\n");
	CHECK(fixture.device().reload_shaders(folder.path.string()));
}

TEST_CASE("lifetime: LUCENT_POISON fills what was never written") {
	const ScopedEnvironment poison("LUCENT_POISON", "ff");
	GpuFixture fixture;
	const OwnedBuffer buffer = fixture.buffer("b", 8);
	CHECK(fixture.device().read_back_buffer<uint32_t>(buffer) == std::vector<uint32_t>(2, UINT32_MAX));
	const OwnedTexture image = fixture.texture("t", Format::R32_FLOAT, 2, 2, TEXTURE_SAMPLED);
	CHECK(std::isnan(fixture.texels<float>(image)[3]));
	const OwnedTexture index = fixture.texture("u", Format::R32_UINT, 2, 2, TEXTURE_SAMPLED);
	CHECK(fixture.texels<uint32_t>(index)[3] == UINT32_MAX);
}

TEST_CASE_FIXTURE(GpuFixture, "lifetime: resources made and freed in any order never overlap") {
	std::mt19937 random(1);
	struct Entry {
		OwnedBuffer buffer;
		uint32_t value = 0;
		uint32_t words = 0;
	};
	std::vector<Entry> entries(40);
	for (uint32_t step = 0; step < 400; step++) {
		Entry &entry = entries[random() % entries.size()];
		if (entry.words != 0) {
			const std::vector<uint32_t> words = device().read_back_buffer<uint32_t>(entry.buffer);
			REQUIRE(words.front() == entry.value);
			REQUIRE(words.back() == entry.value);
		}
		const uint32_t largest = step % 50 == 0 ? 6000000u : 60000u;
		entry.words = 1 + random() % largest;
		entry.value = step;
		entry.buffer = buffer("b", std::vector<uint32_t>(entry.words, step));
	}
	for (const Entry &entry : entries) {
		if (entry.words != 0) {
			CHECK(device().read_back_buffer<uint32_t>(entry.buffer) == std::vector<uint32_t>(entry.words, entry.value));
		}
	}
}

TEST_CASE("lifetime: devices are listed best first and chosen by index or name") {
	const Result<std::vector<DeviceInfo>> list = list_vulkan_devices();
	REQUIRE(list.ok());
	for (size_t i = 1; i < list.value().size(); i++) {
		CHECK(list.value()[i - 1].type <= list.value()[i].type);
	}
	const DeviceInfo &last = list.value().back();
	Result<std::unique_ptr<RenderingDeviceDriver>> by_index = create_vulkan_driver({ std::to_string(list.value().size() - 1), false });
	REQUIRE(by_index.ok());
	CHECK(by_index.value()->info().name == last.name);
	std::string part = last.name.substr(0, 4);
	part[1] = char(std::toupper(part[1]));
	CHECK(create_vulkan_driver({ part, false }).ok());
	const auto missing = create_vulkan_driver({ "no such device", false });
	REQUIRE_FALSE(missing.ok());
	CHECK(missing.error().message.find("no Vulkan device 'no such device'; there are 0: ") == 0);
	CHECK_FALSE(create_vulkan_driver({ "99", false }).ok());
}

TEST_SUITE_END();

} // namespace
} // namespace lucent
