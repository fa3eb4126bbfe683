// SPDX-License-Identifier: MIT
#include "servers/rendering/device/resource_state_tracker.h"

#include <doctest/doctest.h>

namespace lucent {
namespace {

constexpr DriverBuffer BUFFER = { 1 };
constexpr DriverTexture TEXTURE = { 2 };

// Accesses one after another, each by a command of its own; returns the barriers before the last.
std::vector<Barrier> before_last(const std::vector<uint32_t> &p_accesses) {
	AccessState state;
	std::vector<Barrier> result;
	for (uint32_t access : p_accesses) {
		ResourceStateTracker tracker;
		tracker.use_buffer(BUFFER, state, access);
		result = tracker.barriers();
	}
	return result;
}

std::vector<Barrier> one(uint32_t p_source, uint32_t p_target) {
	Barrier barrier;
	barrier.buffer = BUFFER;
	barrier.source = p_source;
	barrier.target = p_target;
	return { barrier };
}

TEST_CASE("state tracker: hazards of buffers") {
	const uint32_t read = ACCESS_COMPUTE_READ, write = ACCESS_COMPUTE_WRITE, indirect = ACCESS_INDIRECT_READ, vertex = ACCESS_GRAPHICS_READ;
	const std::vector<Barrier> none;
	// first use
	CHECK(before_last({ read }) == none);
	CHECK(before_last({ write }) == none);
	// read after read
	CHECK(before_last({ read, read }) == none);
	CHECK(before_last({ read, indirect }) == none);
	// read after write: once for each kind of reader
	CHECK(before_last({ write, read }) == one(write, read));
	CHECK(before_last({ write, read, read }) == none);
	CHECK(before_last({ write, read, indirect }) == one(write, indirect));
	CHECK(before_last({ write, read, indirect, read }) == none);
	CHECK(before_last({ write, read, read | vertex }) == one(write, read | vertex));
	// write after write, write after read
	CHECK(before_last({ write, write }) == one(write, write));
	CHECK(before_last({ read, write }) == one(read, write));
	CHECK(before_last({ write, read, indirect, write }) == one(write | read | indirect, write));
	CHECK(before_last({ read | write, read | write }) == one(read | write, read | write));
	CHECK(before_last({ ACCESS_COPY_WRITE, ACCESS_COPY_WRITE }) == one(ACCESS_COPY_WRITE, ACCESS_COPY_WRITE));
	// readers before a write do not count after it
	CHECK(before_last({ write, vertex, write, read }) == one(write, read));
}

struct Textures {
	ResourceStateTracker tracker;
	TextureState state;
	explicit Textures(uint32_t p_mips = 1, uint32_t p_layers = 1) :
			state(p_mips, p_layers) {}
	std::vector<Barrier> use(const TextureRange &p_range, uint32_t p_access, TextureLayout p_layout, bool p_discard = false) {
		tracker.next_command();
		tracker.use_texture(TEXTURE, state, p_range, p_access, p_layout, p_discard);
		return tracker.barriers();
	}
};

Barrier texture_barrier(const TextureRange &p_range, uint32_t p_source, uint32_t p_target, TextureLayout p_old, TextureLayout p_new) {
	return { {}, TEXTURE, p_range, p_source, p_target, p_old, p_new };
}

TEST_CASE("state tracker: layouts") {
	const TextureRange whole = {};
	Textures t;
	CHECK(t.use(whole, ACCESS_COPY_WRITE, TextureLayout::COPY_TARGET) == std::vector{ texture_barrier(whole, 0, ACCESS_COPY_WRITE, TextureLayout::UNDEFINED, TextureLayout::COPY_TARGET) });
	CHECK(t.use(whole, ACCESS_COMPUTE_SAMPLE, TextureLayout::SHADER_READ) == std::vector{ texture_barrier(whole, ACCESS_COPY_WRITE, ACCESS_COMPUTE_SAMPLE, TextureLayout::COPY_TARGET, TextureLayout::SHADER_READ) });
	CHECK(t.use(whole, ACCESS_COMPUTE_SAMPLE, TextureLayout::SHADER_READ).empty());
	// Another stage waits for the stage that the transition happened before.
	CHECK(t.use(whole, ACCESS_GRAPHICS_SAMPLE, TextureLayout::SHADER_READ) == std::vector{ texture_barrier(whole, ACCESS_COMPUTE_SAMPLE, ACCESS_GRAPHICS_SAMPLE, TextureLayout::SHADER_READ, TextureLayout::SHADER_READ) });
	CHECK(t.use(whole, ACCESS_GRAPHICS_SAMPLE, TextureLayout::SHADER_READ).empty());
	// A transition waits for all readers. Discarded contents need no old layout.
	CHECK(t.use(whole, ACCESS_COLOR_WRITE, TextureLayout::COLOR_TARGET, true) == std::vector{ texture_barrier(whole, ACCESS_COMPUTE_SAMPLE | ACCESS_GRAPHICS_SAMPLE, ACCESS_COLOR_WRITE, TextureLayout::UNDEFINED, TextureLayout::COLOR_TARGET) });
	CHECK(t.use(whole, ACCESS_COLOR_WRITE, TextureLayout::COLOR_TARGET) == std::vector{ texture_barrier(whole, ACCESS_COLOR_WRITE, ACCESS_COLOR_WRITE, TextureLayout::COLOR_TARGET, TextureLayout::COLOR_TARGET) });
}

TEST_CASE("state tracker: mips and layers apart") {
	Textures t(3, 2);
	const TextureRange whole = t.state.whole();
	const TextureLayout general = TextureLayout::GENERAL;
	t.use(whole, ACCESS_COMPUTE_WRITE, general);
	// Reading one mip of one layer leaves the others alone.
	const TextureRange part = { 1, 1, 1, 1 };
	CHECK(t.use(part, ACCESS_COMPUTE_SAMPLE, general) == std::vector{ texture_barrier(part, ACCESS_COMPUTE_WRITE, ACCESS_COMPUTE_SAMPLE, general, general) });
	CHECK(t.use(part, ACCESS_COMPUTE_SAMPLE, general).empty());
	CHECK(t.state.at(1, 1).readers == ACCESS_COMPUTE_SAMPLE);
	CHECK(t.state.at(1, 0).readers == 0);
	// One command reads mip 0 and writes mip 1 of layer 0.
	t.tracker.next_command();
	t.tracker.use_texture(TEXTURE, t.state, { 0, 1, 0, 1 }, ACCESS_COMPUTE_SAMPLE, general);
	t.tracker.use_texture(TEXTURE, t.state, { 1, 1, 0, 1 }, ACCESS_COMPUTE_WRITE, general);
	CHECK(t.tracker.barriers() == std::vector{ texture_barrier({ 0, 1, 0, 1 }, ACCESS_COMPUTE_WRITE, ACCESS_COMPUTE_SAMPLE, general, general), texture_barrier({ 1, 1, 0, 1 }, ACCESS_COMPUTE_WRITE, ACCESS_COMPUTE_WRITE, general, general) });
	// Reading all: only what has not been waited for, neighbouring mips together.
	CHECK(t.use(whole, ACCESS_COMPUTE_SAMPLE, general) == std::vector{ texture_barrier({ 1, 2, 0, 1 }, ACCESS_COMPUTE_WRITE, ACCESS_COMPUTE_SAMPLE, general, general), texture_barrier({ 0, 1, 1, 1 }, ACCESS_COMPUTE_WRITE, ACCESS_COMPUTE_SAMPLE, general, general), texture_barrier({ 2, 1, 1, 1 }, ACCESS_COMPUTE_WRITE, ACCESS_COMPUTE_SAMPLE, general, general) });
	// Now all agree again: one barrier.
	CHECK(t.use(whole, ACCESS_COMPUTE_WRITE, general) == std::vector{ texture_barrier(whole, ACCESS_COMPUTE_WRITE | ACCESS_COMPUTE_SAMPLE, ACCESS_COMPUTE_WRITE, general, general) });
}

TEST_CASE("state tracker: one command can't have a texture in two layouts") {
	Textures t(2, 1);
	const TextureRange whole = t.state.whole();
	t.use(whole, ACCESS_COMPUTE_SAMPLE, TextureLayout::SHADER_READ);
	t.tracker.next_command();
	CHECK(t.tracker.use_texture(TEXTURE, t.state, whole, ACCESS_GRAPHICS_SAMPLE, TextureLayout::SHADER_READ));
	CHECK(t.tracker.use_texture(TEXTURE, t.state, whole, ACCESS_COMPUTE_SAMPLE, TextureLayout::SHADER_READ));
	CHECK_FALSE(t.tracker.use_texture(TEXTURE, t.state, { 1, 1, 0, 1 }, ACCESS_COLOR_WRITE, TextureLayout::COLOR_TARGET));
	t.tracker.next_command();
	CHECK(t.tracker.use_texture(TEXTURE, t.state, { 0, 1, 0, 1 }, ACCESS_COLOR_WRITE, TextureLayout::COLOR_TARGET));
	CHECK(t.tracker.use_texture(TEXTURE, t.state, { 1, 1, 0, 1 }, ACCESS_GRAPHICS_SAMPLE, TextureLayout::SHADER_READ));
	CHECK_FALSE(t.tracker.use_texture(TEXTURE, t.state, whole, ACCESS_GRAPHICS_SAMPLE, TextureLayout::SHADER_READ));
}

} // namespace
} // namespace lucent
