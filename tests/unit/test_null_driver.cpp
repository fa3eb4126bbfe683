// SPDX-License-Identifier: MIT
#include "drivers/null/null_driver.h"
#include "servers/rendering/device/rendering_device.h"
#include "tests/gpu/shaders/test_io.h"

#include <doctest/doctest.h>

namespace lucent {
namespace {

struct NullFixture {
	NullDriver *driver = nullptr;
	std::unique_ptr<RenderingDevice> device;
	NullFixture() {
		std::unique_ptr<NullDriver> made = create_null_driver();
		driver = made.get();
		device = RenderingDevice::create(std::move(made)).take();
	}
	std::string log() const {
		std::string text;
		for (const std::string &line : driver->log()) {
			text += line + "\n";
		}
		return text;
	}
};

TEST_CASE_FIXTURE(NullFixture, "null driver: a small frame, call by call") {
	const OwnedBuffer source = device->create_buffer({ 256, BUFFER_STORAGE, "source" });
	const OwnedBuffer target = device->create_buffer({ 256, BUFFER_STORAGE, "target" });
	const OwnedTexture color = device->create_texture({ .width = 8, .height = 8, .usage = TEXTURE_COLOR_TARGET, .name = "color" });
	device->upload_buffer(source, std::vector<uint32_t>(64, 1));
	const shader::TestConstants constants = { .count = 64, .value = 1 };
	DrawCommand draw;
	draw.state.vertex_shader = Shader::TEST_TRIANGLE_VERT;
	draw.state.fragment_shader = Shader::TEST_TRIANGLE_FRAG;
	draw.index_count = 3;
	PassRecorder &recorder = device->begin_frame();
	recorder.compute("add", Shader::TEST_ADD).read(TEST_SOURCE, source).write(TEST_TARGET, target).constants(constants).dispatch_threads(64);
	recorder.render("draw").color(0, { color }, LoadOp::CLEAR).read(TEST_SOURCE, target).draw({ &draw, 1 });
	device->end_frame();

	CHECK(log() == R"(create_buffer 1 'source' 256 bytes
create_buffer 2 'target' 256 bytes
create_texture 1 'color' rgba8_unorm 8x8x1
begin_commands 0
create_buffer 3 'staging' 8388608 bytes
copy buffer 3 at 0 to buffer 1 at 0, 256 bytes
create_shader 1 'test_add'
create_compute_pipeline 1 'test_add'
fill buffer 2 0+256 0x0
begin 'add'
barrier buffer 1 copy_write -> compute_read
barrier buffer 2 copy_write -> compute_write
bind pipeline 1
bind 0:buffer 1, 1:buffer 2
push_constants 8 bytes
dispatch 1 1 1
end
create_shader 2 'test_triangle_vert'
create_shader 3 'test_triangle_frag'
begin 'draw'
barrier texture 1 mips 0+1 layers 0+1 none -> color_read|color_write, undefined -> color_target
barrier buffer 2 compute_write -> graphics_read
color target 1 mips 0+1 layers 0+1 clear
begin_rendering 8x8
create_graphics_pipeline 2 'test_triangle_frag'
bind pipeline 2
bind 0:buffer 2
draw 0+3 instances 0+1
end_rendering
end
submit
)");
	REQUIRE(recorder.pass_list().size() == 2);
	CHECK(recorder.pass_list()[0].shader == "test_add");
	CHECK(recorder.pass_list()[0].reads == std::vector<std::string>{ "source" });
	CHECK(recorder.pass_list()[0].writes == std::vector<std::string>{ "target" });
	CHECK(recorder.pass_list()[1].writes == std::vector<std::string>{ "color" });
}

TEST_CASE_FIXTURE(NullFixture, "null driver: what was freed lives until its frame has finished") {
	OwnedBuffer buffer = device->create_buffer({ 4, BUFFER_STORAGE, "b" });
	const auto frame = [&] {
		device->begin_frame();
		device->end_frame();
		driver->clear_log();
	};
	PassRecorder &recorder = device->begin_frame();
	recorder.clear_buffer(buffer);
	buffer.reset();
	device->end_frame();
	CHECK(log().find("destroy") == std::string::npos);
	frame();
	device->begin_frame(); // the first frame's slot again
	CHECK(log() == "begin_commands 0\ndestroy buffer 1\n");
	device->end_frame();
}

TEST_CASE_FIXTURE(NullFixture, "null driver: the hook sees every pass and may copy") {
	const OwnedBuffer data = device->create_buffer({ 4, BUFFER_STORAGE, "data" });
	const OwnedBuffer copy = device->create_buffer({ 4, BUFFER_STORAGE, "copy" });
	PassRecorder &recorder = device->begin_frame();
	std::vector<std::string> seen;
	recorder.set_pass_hook([&](const PassInfo &p_pass) {
		seen.push_back(p_pass.name);
		recorder.copy_buffer(data, copy, 4);
	});
	recorder.clear_buffer(data, 1);
	recorder.clear_buffer(data, 2);
	recorder.set_pass_hook({});
	device->end_frame();
	CHECK(seen == std::vector<std::string>{ "clear data", "clear data" });
	CHECK(recorder.pass_list().size() == 4);
}

TEST_CASE_FIXTURE(NullFixture, "null driver: the caller's mistakes are refused") {
	std::vector<std::string> messages;
	const LogHandler previous = set_log_handler([&](LogLevel, std::string_view p_message) { messages.emplace_back(p_message); });
	CHECK_FALSE(device->create_buffer({ 0, BUFFER_STORAGE, "empty" }).is_valid());
	CHECK_FALSE(device->create_texture({ .width = 4, .height = 4, .mips = 4, .name = "mips" }).is_valid());
	CHECK_FALSE(device->create_texture({ .width = 0, .name = "flat" }).is_valid());
	CHECK_FALSE(device->create_texture({ .type = TextureType::TEXTURE_CUBE, .width = 4, .height = 2, .name = "cube" }).is_valid());
	const OwnedBuffer buffer = device->create_buffer({ 8, BUFFER_STORAGE, "b" });
	device->upload_buffer(buffer, 4, std::vector<std::byte>(8));
	device->upload_buffer(buffer, UINT64_MAX, std::vector<std::byte>(8));
	CHECK(device->read_back_buffer(buffer, 8, 4).empty());
	const OwnedTexture texture = device->create_texture({ .name = "t" });
	device->upload_texture(texture, 1, 0, std::vector<std::byte>(4));
	device->upload_texture(texture, 0, 0, std::vector<std::byte>(5));
	const SetBinding gap[] = { { .binding = 1, .buffer = buffer } };
	CHECK_FALSE(device->create_binding_set(gap, "gap").is_valid());
	const SetBinding no_sampler[] = { { .binding = 0, .texture = texture } };
	CHECK_FALSE(device->create_binding_set(no_sampler, "no sampler").is_valid());
	set_log_handler(previous);
	CHECK(messages.size() == 11);
	CHECK(log().find("copy") == std::string::npos);
}

TEST_CASE_FIXTURE(NullFixture, "null driver: the memory report names what is alive") {
	const OwnedBuffer buffer = device->create_buffer({ 100, BUFFER_STORAGE, "b" });
	{
		const OwnedTexture texture = device->create_texture({ .width = 4, .height = 4, .mips = 3, .name = "t" });
		CHECK(device->memory_report().total_bytes == 100 + 4 * (16 + 4 + 1));
	}
	const MemoryReport report = device->memory_report();
	REQUIRE(report.entries.size() == 1);
	CHECK(report.entries[0].name == "b");
	CHECK(report.total_bytes == 100);
}

} // namespace
} // namespace lucent
