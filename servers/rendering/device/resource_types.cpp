// SPDX-License-Identifier: MIT
#include "servers/rendering/device/resource_types.h"

namespace lucent {

namespace {

struct FormatInfo {
	const char *name;
	uint32_t size_bytes;
	FormatKind kind;
};

FormatInfo format_info(Format p_format) {
	switch (p_format) {
		case Format::UNDEFINED:
			break;
		case Format::R8_UNORM:
			return { "r8_unorm", 1, FormatKind::UNORM };
		case Format::R8_UINT:
			return { "r8_uint", 1, FormatKind::UINT };
		case Format::RG8_UNORM:
			return { "rg8_unorm", 2, FormatKind::UNORM };
		case Format::RGBA8_UNORM:
			return { "rgba8_unorm", 4, FormatKind::UNORM };
		case Format::RGBA8_SRGB:
			return { "rgba8_srgb", 4, FormatKind::SRGB };
		case Format::R16_UINT:
			return { "r16_uint", 2, FormatKind::UINT };
		case Format::R16_FLOAT:
			return { "r16_float", 2, FormatKind::FLOAT };
		case Format::RG16_FLOAT:
			return { "rg16_float", 4, FormatKind::FLOAT };
		case Format::RG16_UNORM:
			return { "rg16_unorm", 4, FormatKind::UNORM };
		case Format::RGBA16_FLOAT:
			return { "rgba16_float", 8, FormatKind::FLOAT };
		case Format::R32_UINT:
			return { "r32_uint", 4, FormatKind::UINT };
		case Format::R32_FLOAT:
			return { "r32_float", 4, FormatKind::FLOAT };
		case Format::RG32_UINT:
			return { "rg32_uint", 8, FormatKind::UINT };
		case Format::RG32_FLOAT:
			return { "rg32_float", 8, FormatKind::FLOAT };
		case Format::RGBA32_UINT:
			return { "rgba32_uint", 16, FormatKind::UINT };
		case Format::RGBA32_FLOAT:
			return { "rgba32_float", 16, FormatKind::FLOAT };
		case Format::RGB10A2_UNORM:
			return { "rgb10a2_unorm", 4, FormatKind::UNORM };
		case Format::D32_FLOAT:
			return { "d32_float", 4, FormatKind::DEPTH };
	}
	return { "undefined", 0, FormatKind::UNORM };
}

} // namespace

uint32_t format_size_bytes(Format p_format) {
	return format_info(p_format).size_bytes;
}

FormatKind format_kind(Format p_format) {
	return format_info(p_format).kind;
}

const char *format_name(Format p_format) {
	return format_info(p_format).name;
}

} // namespace lucent
