// SPDX-License-Identifier: MIT
// The triangles of a cascade's surfaces in its cells' coordinates, and what boxes they touch.
#ifndef VOXEL_TRIANGLE_INC
#define VOXEL_TRIANGLE_INC
#include "servers/rendering/gi/world/world_inc.glsl"
#include "servers/rendering/shaders/scene_io.h"

#define VOXEL_SURFACES 10
#define VOXEL_POSITIONS 11
#define VOXEL_INDICES 12
#define VOXEL_INSTANCES 13
#define VOXEL_MATERIALS 14
#define VOXEL_ATTRIBUTES 15
#define VOXEL_TEXTURES 16
#define VOXEL_SAMPLER 17
#define VOXEL_STRETCHES 18

layout(set = 0, binding = VOXEL_SURFACES, scalar) readonly buffer SurfacesBlock {
	GiSurface surfaces[];
};
layout(set = 0, binding = VOXEL_POSITIONS, scalar) readonly buffer PositionsBlock {
	vec3 positions[];
};
layout(set = 0, binding = VOXEL_INDICES, scalar) readonly buffer IndicesBlock {
	uint indices[];
};
layout(set = 0, binding = VOXEL_INSTANCES, scalar) readonly buffer InstancesBlock {
	InstanceData instances[];
};
layout(push_constant, scalar) uniform VoxelizePush {
	VoxelizeConstants constants;
};

struct VoxelTriangle {
	vec3 v[3]; // cells, from the cascade's origin
	uint surface;
	uvec3 vertex; // indices of its vertices
	uint world_triangle; // in the list of all surfaces
};

// Does a triangle touch the box [low, low + size]? Schwarz and Seidel, "Fast Parallel Surface and Solid Voxelization on GPUs", 2010.
struct TriangleBoxTest {
	vec3 normal;
	float plane_near;
	float plane_far;
	vec3 low;
	vec3 high;
	vec3 edge[9]; // xy of the edge's inward normal in its projection, z: offset; projections xy, yz, zx
};

void set_edge(inout TriangleBoxTest test, uint slot, vec2 a, vec2 b, float facing, vec2 size) {
	vec2 e = b - a;
	vec2 n = vec2(-e.y, e.x) * facing;
	test.edge[slot] = vec3(n, -dot(n, a) + max(0.0, size.x * n.x) + max(0.0, size.y * n.y));
}

TriangleBoxTest make_box_test(vec3 v[3], float box_size, float touch) {
	TriangleBoxTest test;
	vec3 size = vec3(box_size + 2.0 * touch);
	vec3 n = cross(v[1] - v[0], v[2] - v[0]);
	test.normal = n;
	vec3 corner = vec3(n.x > 0.0 ? size.x : 0.0, n.y > 0.0 ? size.y : 0.0, n.z > 0.0 ? size.z : 0.0);
	test.plane_near = dot(n, corner - v[0]);
	test.plane_far = dot(n, size - corner - v[0]);
	test.low = min(v[0], min(v[1], v[2])) - size;
	test.high = max(v[0], max(v[1], v[2]));
	// A projection in which the triangle is a line decides nothing.
	float tiny = 1e-6 * max(abs(n.x), max(abs(n.y), abs(n.z)));
	vec3 facing = vec3(abs(n.x) > tiny ? sign(n.x) : 0.0, abs(n.y) > tiny ? sign(n.y) : 0.0, abs(n.z) > tiny ? sign(n.z) : 0.0);
	for (uint i = 0u; i < 3u; i++) {
		vec3 a = v[i];
		vec3 b = v[(i + 1u) % 3u];
		set_edge(test, i, a.xy, b.xy, facing.z, size.xy);
		set_edge(test, 3u + i, a.yz, b.yz, facing.x, size.yz);
		set_edge(test, 6u + i, a.zx, b.zx, facing.y, size.zx);
	}
	return test;
}

// low: the box's lowest corner less `touch`.
bool touches_box(TriangleBoxTest test, vec3 low) {
	if (any(lessThan(low, test.low)) || any(greaterThan(low, test.high))) {
		return false;
	}
	float along = dot(test.normal, low);
	if ((along + test.plane_near) * (along + test.plane_far) > 0.0) {
		return false;
	}
	for (uint i = 0u; i < 3u; i++) {
		if (dot(test.edge[i].xy, low.xy) + test.edge[i].z < 0.0 || dot(test.edge[3u + i].xy, low.yz) + test.edge[3u + i].z < 0.0 || dot(test.edge[6u + i].xy, low.zx) + test.edge[6u + i].z < 0.0) {
			return false;
		}
	}
	return true;
}

#define CELL_TOUCH (WORLD_TOUCH_SUB_VOXELS / float(WORLD_SUB_VOXELS))

vec3 world_from_local(InstanceData instance, vec3 p) {
	vec4 h = vec4(p, 1.0);
	return vec3(dot(instance.world_from_local[0], h), dot(instance.world_from_local[1], h), dot(instance.world_from_local[2], h));
}

// The last surface whose first triangle is at or before `triangle`.
uint find_surface(uint triangle) {
	uint low = 0u;
	uint high = constants.surface_count - 1u;
	for (uint i = 0u; i < 32u && low < high; i++) {
		uint middle = (low + high + 1u) / 2u;
		if (surfaces[middle].first_triangle <= triangle) {
			low = middle;
		} else {
			high = middle - 1u;
		}
	}
	return low;
}

VoxelTriangle load_triangle(uint triangle) {
	VoxelTriangle result;
	result.surface = find_surface(triangle);
	GiSurface surface = surfaces[result.surface];
	uint first = surface.first_index + (triangle - surface.first_triangle) * 3u;
	result.world_triangle = surface.world_triangle + triangle - surface.first_triangle;
	GiCascade c = world.cascades[constants.cascade];
	for (uint i = 0u; i < 3u; i++) {
		result.vertex[i] = uint(int(indices[first + i]) + surface.vertex_offset);
		// Divided first: the same in every cascade position, whatever the origin.
		result.v[i] = world_from_local(instances[surface.instance], positions[result.vertex[i]]) / c.cell_m - vec3(c.origin_cells);
	}
	return result;
}

uint main_axis(vec3 n) {
	vec3 a = abs(n);
	return a.x >= a.y && a.x >= a.z ? 0u : (a.y >= a.z ? 1u : 2u);
}

// The columns of cells, along the main axis of its normal, over which a triangle's box within the cascade lies.
struct TriangleColumns {
	ivec3 low;
	ivec3 size;
	uint count; // 0: outside, without area, or not finite
};

TriangleColumns columns_of_triangle(VoxelTriangle triangle) {
	TriangleColumns result;
	vec3 n = cross(triangle.v[1] - triangle.v[0], triangle.v[2] - triangle.v[0]);
	vec3 low = min(triangle.v[0], min(triangle.v[1], triangle.v[2])) - CELL_TOUCH;
	vec3 high = max(triangle.v[0], max(triangle.v[1], triangle.v[2])) + CELL_TOUCH;
	float size = float(world.grid_size);
	result.count = 0u;
	// Written so that NaN fails.
	if (dot(n, n) > 1e-24 && all(lessThan(low, vec3(size))) && all(greaterThan(high, vec3(0.0)))) {
		result.low = ivec3(clamp(floor(low), vec3(0.0), vec3(size - 1.0)));
		result.size = ivec3(clamp(floor(high), vec3(0.0), vec3(size - 1.0))) - result.low + 1;
		uint k = main_axis(n);
		result.count = uint(result.size[(k + 1u) % 3u] * result.size[(k + 2u) % 3u]);
	}
	return result;
}

#endif
