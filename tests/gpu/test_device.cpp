// SPDX-License-Identifier: MIT
#include "tests/gpu/gpu_fixture.h"
#include "tests/gpu/shaders/test_io.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <numeric>

namespace lucent {
namespace {

using test::GpuFixture;

std::vector<uint32_t> counting(size_t p_count, uint32_t p_first = 0) {
	std::vector<uint32_t> values(p_count);
	std::iota(values.begin(), values.end(), p_first);
	return values;
}

template <typename T>
std::span<const std::byte> bytes_of(const std::vector<T> &p_values) {
	return std::as_bytes(std::span(p_values));
}

TEST_SUITE_BEGIN("gpu");

TEST_CASE_FIXTURE(GpuFixture, "device: a buffer comes back as it was uploaded") {
	for (size_t count : { size_t(1), size_t(1000), size_t(5000000) }) {
		const OwnedBuffer data = buffer("data", counting(count, 7));
		CHECK(device().read_back_buffer<uint32_t>(data) == counting(count, 7));
	}
	const OwnedBuffer odd = buffer("odd", 7);
	const std::vector<std::byte> bytes(3, std::byte(0xab));
	device().upload_buffer(odd, 2, bytes);
	const std::vector<std::byte> expected = { std::byte(0), std::byte(0), std::byte(0xab), std::byte(0xab), std::byte(0xab), std::byte(0), std::byte(0) };
	CHECK(device().read_back_buffer(odd, 0, 7) == expected);
}

TEST_CASE_FIXTURE(GpuFixture, "device: new resources are zero") {
	const OwnedBuffer data = buffer("data", 4096);
	CHECK(device().read_back_buffer<uint32_t>(data) == std::vector<uint32_t>(1024, 0));
	const OwnedTexture image = texture("image", Format::RGBA16_FLOAT, 5, 3, TEXTURE_SAMPLED);
	CHECK(texels<uint16_t>(image) == std::vector<uint16_t>(5 * 3 * 4, 0));
	const OwnedTexture depth = texture("depth", Format::D32_FLOAT, 5, 3, TEXTURE_DEPTH_TARGET | TEXTURE_SAMPLED);
	CHECK(texels<float>(depth) == std::vector<float>(15, 0.0f));
}

TEST_CASE_FIXTURE(GpuFixture, "device: every mip and layer of every texture type comes back as it was uploaded") {
	TextureDesc desc;
	desc.format = Format::R32_UINT;
	desc.width = 12;
	desc.height = 6;
	desc.mips = 3;
	for (TextureType type : { TextureType::TEXTURE_2D, TextureType::TEXTURE_2D_ARRAY, TextureType::TEXTURE_3D, TextureType::TEXTURE_CUBE }) {
		desc.type = type;
		desc.depth = type == TextureType::TEXTURE_3D ? 5 : 1;
		desc.layers = type == TextureType::TEXTURE_2D_ARRAY ? 4 : 1;
		desc.height = type == TextureType::TEXTURE_CUBE ? desc.width : 6;
		const OwnedTexture image = device().create_texture(desc);
		for (uint32_t layer = 0; layer < desc.layer_count(); layer++) {
			for (uint32_t mip = 0; mip < desc.mips; mip += 2) { // mip 1 stays as it was made
				device().upload_texture(image, mip, layer, bytes_of(counting(desc.mip_size_bytes(mip) / 4, 1000 * layer + 100000 * mip)));
			}
		}
		for (uint32_t layer = 0; layer < desc.layer_count(); layer++) {
			CHECK(texels<uint32_t>(image, 0, layer) == counting(desc.mip_size_bytes(0) / 4, 1000 * layer));
			CHECK(texels<uint32_t>(image, 1, layer) == std::vector<uint32_t>(desc.mip_size_bytes(1) / 4, 0));
			CHECK(texels<uint32_t>(image, 2, layer) == counting(desc.mip_size_bytes(2) / 4, 1000 * layer + 200000));
		}
	}
}

TEST_CASE_FIXTURE(GpuFixture, "device: passes that hand a buffer on see one another's writes") {
	constexpr uint32_t COUNT = 100000;
	const OwnedBuffer first = buffer("first", counting(COUNT));
	const OwnedBuffer second = buffer("second", COUNT * 4);
	const shader::TestConstants constants = { .count = COUNT, .value = 3 };
	for (int frame_index = 0; frame_index < 5; frame_index++) { // frames overlap: no wait in between
		PassRecorder &recorder = device().begin_frame();
		recorder.compute("there", Shader::TEST_ADD).read(TEST_SOURCE, first).read_write(TEST_TARGET, second).constants(constants).dispatch_threads(COUNT);
		recorder.compute("back", Shader::TEST_ADD).read(TEST_SOURCE, second).write(TEST_TARGET, first).constants(constants).dispatch_threads(COUNT);
		device().end_frame();
	}
	CHECK(device().read_back_buffer<uint32_t>(first) == counting(COUNT, 30));
	CHECK(device().read_back_buffer<uint32_t>(second) == counting(COUNT, 27));
	if (device().info().timestamps) {
		REQUIRE(device().timings().size() == 2);
		CHECK(device().timings()[0].name == "there");
		CHECK(device().timings()[1].gpu_ms > 0.0);
	}
}

TEST_CASE_FIXTURE(GpuFixture, "device: a frame of many passes outgrows the first descriptor pool") {
	constexpr uint32_t PASSES = 700;
	const OwnedBuffer buffers[] = { buffer("even", 256), buffer("odd", 256) };
	for (int repeat = 0; repeat < 3; repeat++) {
		frame([&](PassRecorder &r_recorder) {
			for (uint32_t i = 0; i < PASSES; i++) {
				r_recorder.compute("add", Shader::TEST_ADD).read(TEST_SOURCE, buffers[i % 2]).write(TEST_TARGET, buffers[1 - i % 2]).constants(shader::TestConstants{ .count = 64, .value = 1 }).dispatch_threads(64);
			}
		});
	}
	CHECK(device().read_back_buffer<uint32_t>(buffers[0]) == std::vector<uint32_t>(64, 3 * PASSES));
	CHECK((!device().info().timestamps || device().timings().size() == PASSES));
}

TEST_CASE_FIXTURE(GpuFixture, "device: copies, clears and updates are ordered with the passes around them") {
	constexpr uint32_t COUNT = 1000;
	const OwnedBuffer first = buffer("first", COUNT * 4);
	const OwnedBuffer second = buffer("second", COUNT * 4);
	const OwnedBuffer third = buffer("third", COUNT * 4);
	const shader::TestConstants constants = { .count = COUNT, .value = 1 };
	const uint32_t word = 50;
	frame([&](PassRecorder &r_recorder) {
		r_recorder.clear_buffer(first, 10);
		r_recorder.compute("add", Shader::TEST_ADD).read(TEST_SOURCE, first).write(TEST_TARGET, second).constants(constants).dispatch_threads(COUNT);
		r_recorder.clear_buffer(first, 20);
		r_recorder.copy_buffer(second, third, COUNT * 4);
		r_recorder.update_buffer(third, 40, std::as_bytes(std::span(&word, 1)));
		r_recorder.compute("add", Shader::TEST_ADD).read(TEST_SOURCE, third).write(TEST_TARGET, second).constants(constants).dispatch_threads(COUNT);
		device().upload_buffer(third, 0, std::as_bytes(std::span(&word, 1)));
	});
	std::vector<uint32_t> expected(COUNT, 12);
	expected[10] = 51;
	CHECK(device().read_back_buffer<uint32_t>(second) == expected);
	CHECK(device().read_back_buffer<uint32_t>(first) == std::vector<uint32_t>(COUNT, 20));
	CHECK(device().read_back_buffer<uint32_t>(third)[0] == 50);
}

TEST_CASE_FIXTURE(GpuFixture, "device: a pass may write one mip and read the one before") {
	TextureDesc desc;
	desc.format = Format::R32_FLOAT;
	desc.width = desc.height = 64;
	desc.mips = 7;
	desc.usage = TEXTURE_SAMPLED | TEXTURE_STORAGE;
	const OwnedTexture pyramid = device().create_texture(desc);
	device().upload_texture(pyramid, 0, 0, bytes_of(std::vector<float>(64 * 64, 1.0f)));
	for (int repeat = 0; repeat < 2; repeat++) {
		frame([&](PassRecorder &r_recorder) {
			for (uint32_t mip = 1; mip < desc.mips; mip++) {
				r_recorder.compute("downsample", Shader::TEST_DOWNSAMPLE).read(TEST_SOURCE, TextureView{ pyramid, mip - 1 }).write(TEST_TARGET, TextureView{ pyramid, mip }).dispatch_threads(64u >> mip, 64u >> mip);
			}
		});
	}
	CHECK(texels<float>(pyramid, 3) == std::vector<float>(64, 64.0f));
	CHECK(texels<float>(pyramid, 6) == std::vector<float>(1, 4096.0f));
}

TEST_CASE_FIXTURE(GpuFixture, "device: a volume keeps what compute passes add") {
	TextureDesc desc;
	desc.type = TextureType::TEXTURE_3D;
	desc.format = Format::R32_UINT;
	desc.width = 17;
	desc.height = 9;
	desc.depth = 5;
	desc.usage = TEXTURE_STORAGE;
	const OwnedTexture volume = device().create_texture(desc);
	const OwnedTexture copy = device().create_texture(desc);
	frame([&](PassRecorder &r_recorder) {
		r_recorder.clear_texture(volume, Vector4(5.0f));
		for (int i = 0; i < 2; i++) {
			r_recorder.compute("volume", Shader::TEST_VOLUME).read_write(TEST_TARGET, volume).dispatch_threads(17, 9, 5);
		}
		r_recorder.copy_texture(volume, copy);
		r_recorder.compute("volume", Shader::TEST_VOLUME).read_write(TEST_TARGET, volume).dispatch_threads(17, 9, 5);
	});
	const std::vector<uint32_t> values = texels<uint32_t>(copy);
	CHECK(values[0] == 5);
	CHECK(values[(4 * 9 + 8) * 17 + 16] == 5 + 2 * (16 + 800 + 40000));
	CHECK(texels<uint32_t>(volume)[(4 * 9 + 8) * 17 + 16] == 5 + 3 * (16 + 800 + 40000));
}

TEST_CASE_FIXTURE(GpuFixture, "device: indirect dispatch and specialised group sizes") {
	const OwnedBuffer arguments = buffer("arguments", counting(8), BUFFER_STORAGE | BUFFER_INDIRECT); // at byte 4: 1 2 3
	const OwnedBuffer counter = buffer("counter", 4);
	const OwnedBuffer raised = buffer("raised", 32, BUFFER_STORAGE | BUFFER_INDIRECT);
	const shader::TestConstants constants = { .count = 8, .value = 1 };
	frame([&](PassRecorder &r_recorder) {
		r_recorder.compute("count", Shader::TEST_COUNT).read_write(TEST_TARGET, counter).specialize(7, 16).dispatch_indirect(arguments, 4);
		r_recorder.compute("raise", Shader::TEST_ADD).read(TEST_SOURCE, arguments).write(TEST_TARGET, raised).constants(constants).dispatch_threads(8);
		r_recorder.compute("count", Shader::TEST_COUNT).read_write(TEST_TARGET, counter).specialize(7, 16).dispatch_indirect(raised, 4); // 2 3 4
		r_recorder.compute("count", Shader::TEST_COUNT).read_write(TEST_TARGET, counter).specialize(7, 32).dispatch_threads(33); // two groups
	});
	CHECK(device().read_back_buffer<uint32_t>(counter)[0] == 6 * 16 + 24 * 16 + 64);
}

TEST_CASE_FIXTURE(GpuFixture, "device: samplers and array textures in compute passes") {
	TextureDesc desc;
	desc.type = TextureType::TEXTURE_2D_ARRAY;
	desc.width = 2;
	desc.layers = 2;
	const OwnedTexture image = device().create_texture(desc);
	device().upload_texture(image, 0, 0, bytes_of(std::vector<uint32_t>{ 0x00000000u, 0x000000ffu }));
	device().upload_texture(image, 0, 1, bytes_of(std::vector<uint32_t>{ 0x00ff0000u, 0x00ff0000u }));
	const OwnedBuffer result = buffer("result", 32);
	const SamplerHandle linear = device().sampler({});
	CHECK(device().sampler({}) == linear);
	frame([&](PassRecorder &r_recorder) {
		r_recorder.compute("sample", Shader::TEST_SAMPLE_ARRAY).read(TEST_SOURCE, image).sampler(TEST_SAMPLER, linear).write(TEST_TARGET, result).dispatch_threads(2);
	});
	const std::vector<Vector4> values = device().read_back_buffer<Vector4>(result);
	CHECK(values[0].x == doctest::Approx(0.5f).epsilon(0.01));
	CHECK(values[0].z == 0.0f);
	CHECK(values[1].z == 1.0f);
}

TEST_CASE_FIXTURE(GpuFixture, "device: a struct is the same in C++ and GLSL") {
	std::vector<shader::TestStruct> values(2);
	std::vector<uint32_t> words = counting(sizeof(shader::TestStruct) * 2 / 4, 0x3f800000u); // ordinary floats
	std::memcpy(static_cast<void *>(values.data()), words.data(), words.size() * 4);
	const OwnedBuffer source = buffer("source", values);
	const OwnedBuffer target = buffer("target", words.size() * 4);
	frame([&](PassRecorder &r_recorder) {
		r_recorder.compute("copy", Shader::TEST_STRUCT).read(TEST_SOURCE, source).write(TEST_TARGET, target).dispatch_threads(2);
	});
	CHECK(device().read_back_buffer<uint32_t>(target) == words);
}

TEST_SUITE_END();

} // namespace
} // namespace lucent
