// SPDX-License-Identifier: MIT
#pragma once
// Trees with a server each, one device for all, pictures.

#include "modules/python/py_object.h"

#include <string>
#include <vector>

namespace lucent::python {

// A SceneTree and its server. The device comes with the first picture.
std::unique_ptr<Object> make_tree();
// Ends the tree, then its server.
void close_tree(std::unique_ptr<Object> p_tree);
// All that are left, and the device.
void close_all();

struct RenderRequest {
	uint32_t width = 0;
	uint32_t height = 0;
	uint32_t frames = 0; // 0: until converged
	double delta_s = 1.0 / 60.0;
	bool srgb = true;
	ObjectID camera; // none: as `lucent render` chooses
	std::string device;
	std::vector<std::string> aovs;
};

// (color, srgb or None, {aov: array}, statistics as JSON text). Null: an error is set.
PyObject *render(Object &r_tree, const RenderRequest &p_request);

struct ReferenceRequest {
	uint32_t width = 0;
	uint32_t height = 0;
	uint32_t spp = 64;
	uint32_t seed = 0;
	ObjectID camera;
	std::vector<std::string> aovs;
};
// (color, variance, {aov: array}, rays, seconds).
PyObject *reference(Object &r_tree, const ReferenceRequest &p_request);

// `lucent open`: what RenderSession::load adds to a scene without environment.
PyObject *open_scene(Object &r_tree, const std::string &p_path);

// A numpy array that owns the values: no copy. p_channels 1: (H, W), else (H, W, C).
PyObject *make_array(std::vector<float> p_values, uint32_t p_width, uint32_t p_height, uint32_t p_channels);

} // namespace lucent::python
