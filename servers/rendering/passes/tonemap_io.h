// SPDX-License-Identifier: MIT
#ifndef TONEMAP_IO_H
#define TONEMAP_IO_H
#include "servers/rendering/device/shader_interop.h"
#define TONEMAP_SOURCE 0
#define TONEMAP_TARGET 1
INTEROP_BEGIN
struct TonemapConstants {
	uint tone_mapper; // ToneMapper
	float exposure;
	float white;
};
INTEROP_END
#endif
