// SPDX-License-Identifier: MIT
#pragma once
// What the device and its drivers are asked for: descriptions, typed handles, owning wrappers.

#include "servers/core/math_types.h"
#include "servers/core/rid.h"

#include <cstdint>
#include <string>

namespace lucent {

enum class Format : uint8_t {
	UNDEFINED,
	R8_UNORM,
	R8_UINT,
	RG8_UNORM,
	RGBA8_UNORM,
	RGBA8_SRGB,
	R16_UINT,
	R16_FLOAT,
	RG16_FLOAT,
	RG16_UNORM,
	RGBA16_FLOAT,
	R32_UINT,
	R32_FLOAT,
	RG32_UINT,
	RG32_FLOAT,
	RGBA32_UINT,
	RGBA32_FLOAT,
	RGB10A2_UNORM,
	D32_FLOAT,
};
enum class FormatKind : uint8_t {
	UNORM,
	SRGB,
	UINT,
	FLOAT,
	DEPTH
};
uint32_t format_size_bytes(Format p_format); // of one texel
FormatKind format_kind(Format p_format);
const char *format_name(Format p_format); // "rgba16_float"

enum class TextureType : uint8_t {
	TEXTURE_2D,
	TEXTURE_2D_ARRAY,
	TEXTURE_3D,
	TEXTURE_CUBE
};

enum TextureUsage : uint32_t {
	TEXTURE_SAMPLED = 1,
	TEXTURE_STORAGE = 2,
	TEXTURE_COLOR_TARGET = 4,
	TEXTURE_DEPTH_TARGET = 8,
};

// Every texture can also be the source and the target of copies (debugging, read-back).
struct TextureDesc {
	TextureType type = TextureType::TEXTURE_2D;
	Format format = Format::RGBA8_UNORM;
	uint32_t width = 1;
	uint32_t height = 1;
	uint32_t depth = 1; // TEXTURE_3D only
	uint32_t layers = 1; // 2D_ARRAY; a cube has 6
	uint32_t mips = 1;
	uint32_t usage = TEXTURE_SAMPLED; // TextureUsage bits
	std::string name; // for debuggers and --stats: "sdfgi.cascade2.sdf"

	uint32_t layer_count() const { return type == TextureType::TEXTURE_CUBE ? 6 : (type == TextureType::TEXTURE_2D_ARRAY ? layers : 1); }
	glm::uvec3 mip_size(uint32_t p_mip) const { return glm::max(glm::uvec3(width, height, type == TextureType::TEXTURE_3D ? depth : 1) >> p_mip, glm::uvec3(1)); }
	// Of one mip of one layer, tightly packed.
	uint64_t mip_size_bytes(uint32_t p_mip) const {
		const glm::uvec3 size = mip_size(p_mip);
		return uint64_t(size.x) * size.y * size.z * format_size_bytes(format);
	}
};

enum BufferUsage : uint32_t {
	BUFFER_STORAGE = 1,
	BUFFER_UNIFORM = 2,
	BUFFER_INDEX = 4,
	BUFFER_INDIRECT = 8,
};

// Device-local; every buffer can also be the source and the target of copies.
struct BufferDesc {
	uint64_t size_bytes = 0;
	uint32_t usage = BUFFER_STORAGE; // BufferUsage bits
	std::string name;
};

enum class LoadOp : uint8_t {
	LOAD,
	CLEAR,
	DONT_CARE
};
enum class CullMode : uint8_t {
	NONE,
	FRONT,
	BACK
};
enum class CompareOp : uint8_t {
	NEVER,
	LESS,
	EQUAL,
	LESS_OR_EQUAL,
	GREATER,
	GREATER_OR_EQUAL,
	ALWAYS
};
enum class BlendMode : uint8_t {
	NONE,
	MIX,
	ADD,
	SUB,
	MUL,
	PREMULTIPLIED
};

enum class Filter : uint8_t {
	NEAREST,
	LINEAR
};
enum class AddressMode : uint8_t {
	REPEAT,
	MIRRORED_REPEAT,
	CLAMP_TO_EDGE,
	CLAMP_TO_BORDER
};

struct SamplerDesc {
	Filter mag_filter = Filter::LINEAR;
	Filter min_filter = Filter::LINEAR;
	Filter mip_filter = Filter::LINEAR;
	AddressMode address_u = AddressMode::REPEAT;
	AddressMode address_v = AddressMode::REPEAT;
	AddressMode address_w = AddressMode::REPEAT;
	float max_anisotropy = 1.0f; // clamped to the device's limit
	float max_lod = 1000.0f;
	bool compare = false; // shadow maps: LESS_OR_EQUAL
	bool operator==(const SamplerDesc &) const = default;
};

using TextureHandle = Rid<struct TextureTag>;
using BufferHandle = Rid<struct BufferTag>;
using SamplerHandle = Rid<struct SamplerTag>;
using BindingSetHandle = Rid<struct BindingSetTag>;

class RenderingDevice;

// Frees its resource when it dies, after the frames that used it have finished. Move-only.
template <typename Handle>
class Owned {
public:
	Owned() = default;
	Owned(RenderingDevice *p_device, Handle p_handle) :
			device(p_device), owned_handle(p_handle) {}
	Owned(Owned &&p_other) noexcept { swap(p_other); }
	Owned &operator=(Owned &&p_other) noexcept {
		if (this != &p_other) {
			reset();
			swap(p_other);
		}
		return *this;
	}
	~Owned() { reset(); }

	Handle handle() const { return owned_handle; }
	operator Handle() const { return owned_handle; }
	bool is_valid() const { return owned_handle.is_valid(); }
	void reset(); // rendering_device.cpp

private:
	void swap(Owned &p_other) {
		std::swap(device, p_other.device);
		std::swap(owned_handle, p_other.owned_handle);
	}
	RenderingDevice *device = nullptr;
	Handle owned_handle;
};

using OwnedTexture = Owned<TextureHandle>;
using OwnedBuffer = Owned<BufferHandle>;
using OwnedBindingSet = Owned<BindingSetHandle>;

} // namespace lucent
