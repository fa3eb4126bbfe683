// SPDX-License-Identifier: MIT
#ifndef LIGHT_CLUSTERS_IO_H
#define LIGHT_CLUSTERS_IO_H
#include "servers/rendering/device/shader_interop.h"
#define LIGHT_CLUSTERS_FRAME 0
#define LIGHT_CLUSTERS_LIGHTS 1
#define LIGHT_CLUSTERS_MASKS 2
INTEROP_BEGIN
struct LightClustersConstants {
	mat4 view_from_clip;
	uint light_count;
};
INTEROP_END
#endif
