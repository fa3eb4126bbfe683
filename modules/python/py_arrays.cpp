// SPDX-License-Identifier: MIT
#include "modules/python/py_arrays.h"

#include "modules/image/image_io.h"
#include "modules/python/py_tree.h"
#include "modules/reference/image_metrics.h"
#include "modules/scene/mesh.h"

#include <pybind11/numpy.h>

#include <cstring>

namespace lucent::python {

namespace py = pybind11;

namespace {

// One conversion by numpy where the dtype or the layout is another; none where it fits.
using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<int64_t, py::array::c_style | py::array::forcecast>;

template <typename T>
T &object_of(const py::handle &p_handle, const char *p_what) {
	Object *object = is_handle(p_handle.ptr()) ? live_object(reinterpret_cast<Handle *>(p_handle.ptr())) : nullptr;
	if (PyErr_Occurred()) {
		throw py::error_already_set();
	}
	T *typed = dynamic_cast<T *>(object);
	if (!typed) {
		throw py::type_error(std::string("expected ") + p_what);
	}
	return *typed;
}

// (N, columns) into a vector; None is empty.
template <typename T>
std::vector<T> read_rows(const py::object &p_array, const char *p_name) {
	constexpr py::ssize_t COLUMNS = py::ssize_t(sizeof(T) / sizeof(float));
	if (p_array.is_none()) {
		return {};
	}
	const Floats array = Floats::ensure(p_array);
	if (!array) {
		throw py::error_already_set();
	}
	if (array.ndim() != 2 || array.shape(1) != COLUMNS) {
		throw py::value_error(fmt::format("{}: expected the shape (N, {}), got {}", p_name, COLUMNS,
				std::string(py::str(py::tuple(py::cast<py::object>(array).attr("shape"))))));
	}
	std::vector<T> rows(size_t(array.shape(0)));
	std::memcpy(static_cast<void *>(rows.data()), array.data(), rows.size() * sizeof(T));
	return rows;
}

std::vector<uint32_t> read_indices(const py::object &p_array, size_t p_vertices) {
	if (p_array.is_none()) {
		std::vector<uint32_t> all(p_vertices);
		for (size_t i = 0; i < all.size(); i++) {
			all[i] = uint32_t(i);
		}
		return all;
	}
	if (py::isinstance<py::array_t<uint32_t>>(p_array)) {
		const py::array_t<uint32_t, py::array::c_style> array = py::array_t<uint32_t, py::array::c_style>::ensure(
				p_array);
		return { array.data(), array.data() + array.size() };
	}
	const py::array any = py::array::ensure(p_array);
	if (!any || (any.dtype().kind() != 'i' && any.dtype().kind() != 'u')) {
		throw py::value_error("indices: expected integers");
	}
	const Indices array = Indices::ensure(any);
	std::vector<uint32_t> indices(size_t(array.size()));
	for (size_t i = 0; i < indices.size(); i++) {
		const int64_t index = array.data()[i];
		if (index < 0 || index >= int64_t(p_vertices)) {
			throw py::value_error(
					fmt::format("indices, row {}: there is no vertex {} of {}", i / 3, index, p_vertices));
		}
		indices[i] = uint32_t(index);
	}
	return indices;
}

void add_surface(const py::handle &p_mesh, const py::object &p_positions, const py::object &p_indices,
		const py::object &p_normals, const py::object &p_uvs, const py::object &p_colors,
		const py::object &p_material) {
	MeshSurface surface;
	surface.positions = read_rows<Vector3>(p_positions, "positions");
	surface.normals = read_rows<Vector3>(p_normals, "normals");
	surface.uvs = read_rows<Vector2>(p_uvs, "uvs");
	surface.colors = read_rows<Vector4>(p_colors, "colors");
	surface.indices = read_indices(p_indices, surface.positions.size());
	if (const Status status = scene::check_surface(surface, "ArrayMesh.from_arrays()"); !status) {
		throw py::value_error(status.error().message);
	}
	Entry entry;
	if (!entry) {
		throw py::error_already_set();
	}
	scene::ArrayMesh &mesh = object_of<scene::ArrayMesh>(p_mesh, "an ArrayMesh");
	Ref<scene::Material> material;
	if (!p_material.is_none()) {
		material = std::static_pointer_cast<scene::Material>(
				object_of<scene::Material>(p_material, "a Material").shared_from_this());
	}
	mesh.add_surface(std::move(surface), material);
	if (!entry.finish()) {
		throw py::error_already_set();
	}
}

// Views that keep the surface alive: (N, C), read-only.
py::dict surface_views(const py::handle &p_mesh, int p_surface) {
	const std::shared_ptr<const MeshSurface> surface = object_of<scene::Mesh>(p_mesh, "a Mesh")
															   .surface_get_arrays(p_surface);
	if (!surface) {
		throw py::index_error(fmt::format("there is no surface {}", p_surface));
	}
	const py::capsule owner(new std::shared_ptr<const MeshSurface>(surface),
			[](void *p_pointer) { delete static_cast<std::shared_ptr<const MeshSurface> *>(p_pointer); });
	py::dict views;
	const auto add = [&](const char *p_name, const auto &p_values) {
		using T = typename std::decay_t<decltype(p_values)>::value_type;
		if (!p_values.empty()) {
			py::array_t<float> view({ py::ssize_t(p_values.size()), py::ssize_t(sizeof(T) / sizeof(float)) },
					reinterpret_cast<const float *>(p_values.data()), owner);
			view.attr("flags").attr("writeable") = false;
			views[p_name] = view;
		}
	};
	add("positions", surface->positions);
	add("normals", surface->normals);
	add("uvs", surface->uvs);
	add("colors", surface->colors);
	py::array_t<uint32_t> indices(
			{ py::ssize_t(surface->indices.size() / 3), py::ssize_t(3) }, surface->indices.data(), owner);
	indices.attr("flags").attr("writeable") = false;
	views["indices"] = indices;
	return views;
}

// (H, W, 3 or 4): uint8 is sRGB-encoded, floats are linear.
void set_image(const py::handle &p_texture, const py::array &p_pixels) {
	const bool bytes = p_pixels.dtype().kind() == 'u' && p_pixels.itemsize() == 1;
	if (p_pixels.ndim() != 3 || (p_pixels.shape(2) != 3 && p_pixels.shape(2) != 4) ||
			(!bytes && p_pixels.dtype().kind() != 'f')) {
		throw py::value_error("pixels: expected the shape (H, W, 3) or (H, W, 4) of uint8 (sRGB) or floats (linear)");
	}
	auto image = std::make_shared<Image>();
	image->format = bytes ? ImageFormat::RGBA8 : ImageFormat::RGBA32F;
	image->height = uint32_t(p_pixels.shape(0));
	image->width = uint32_t(p_pixels.shape(1));
	const size_t channels = size_t(p_pixels.shape(2)), count = size_t(image->width) * image->height;
	image->texels.resize(count * image->texel_size_bytes());
	const auto copy = [&](const auto *p_from, auto p_opaque) {
		auto *to = reinterpret_cast<decltype(p_opaque) *>(image->texels.data());
		for (size_t i = 0; i < count; i++) {
			for (size_t channel = 0; channel < 4; channel++) {
				to[4 * i + channel] = channel < channels ? p_from[channels * i + channel] : p_opaque;
			}
		}
	};
	if (bytes) {
		copy(py::array_t<uint8_t, py::array::c_style | py::array::forcecast>(p_pixels).data(), uint8_t(255));
	} else {
		copy(Floats(p_pixels).data(), 1.0f);
	}
	object_of<scene::ImageTexture>(p_texture, "an ImageTexture").set_image(std::move(image));
}

MetricImage metric_image(const py::array &p_array, const char *p_name) {
	const Floats array = Floats::ensure(p_array);
	if (!array || array.ndim() != 3 || array.shape(2) != 3) {
		throw py::value_error(std::string(p_name) + ": expected a picture of the shape (H, W, 3)");
	}
	return { uint32_t(array.shape(1)), uint32_t(array.shape(0)),
		std::vector<float>(array.data(), array.data() + array.size()) };
}

py::dict compare(const py::array &p_a, const py::array &p_b, float p_exposure) {
	const MetricImage a = metric_image(p_a, "a"), b = metric_image(p_b, "b");
	MetricSettings settings;
	settings.exposure = p_exposure;
	Result<ImageMetrics> metrics = Error();
	{
		const py::gil_scoped_release release;
		metrics = compare_images(a, b, {}, settings);
	}
	if (!metrics) {
		throw py::value_error(metrics.error().message);
	}
	const ImageMetrics &m = metrics.value();
	py::dict result;
	const std::pair<const char *, double> figures[] = { { "mean_a", m.mean_a }, { "mean_b", m.mean_b },
		{ "rmse", m.rmse }, { "nrmse", m.nrmse }, { "relmse", m.relmse }, { "energy", m.energy },
		{ "over_lit", m.over_lit }, { "under_lit", m.under_lit }, { "max_error", m.max_error }, { "ssim", m.ssim },
		{ "flip", m.flip }, { "flip_p99", m.flip_p99 } };
	for (const auto &[name, value] : figures) {
		result[name] = value;
	}
	return result;
}

void check(const Status &p_status) {
	if (!p_status) {
		PyErr_SetString(PyExc_OSError, p_status.error().message.c_str());
		throw py::error_already_set();
	}
}

void write_png_file(
		const std::string &p_path, const py::array_t<uint8_t, py::array::c_style | py::array::forcecast> &p_pixels) {
	check(write_png(p_path, uint32_t(p_pixels.shape(1)), uint32_t(p_pixels.shape(0)), uint32_t(p_pixels.shape(2)),
			{ p_pixels.data(), size_t(p_pixels.size()) }));
}

// p_layers: name to array, "" is the picture. (H, W) or (H, W, 3).
void write_exr_file(const std::string &p_path, const py::dict &p_layers) {
	std::vector<Floats> arrays;
	std::vector<ExrLayer> layers;
	for (const auto &[key, value] : p_layers) {
		const std::string name = py::str(key);
		const Floats &array = arrays.emplace_back(Floats::ensure(value));
		const bool vector = name == "normal" || name == "motion";
		const std::vector<std::string> three = vector ? std::vector<std::string>{ "X", "Y", "Z" }
													  : std::vector<std::string>{ "R", "G", "B" };
		layers.push_back({ name,
				array.ndim() == 2 ? std::vector<std::string>{ "Z" }
								  : std::vector<std::string>(
											three.begin(), three.begin() + std::min<py::ssize_t>(3, array.shape(2))),
				{ array.data(), size_t(array.size()) } });
	}
	check(write_exr(p_path, uint32_t(arrays.front().shape(1)), uint32_t(arrays.front().shape(0)), layers));
}

} // namespace

void define_arrays(py::module_ &r_module) {
	r_module.def("add_surface", &add_surface);
	r_module.def("surface_views", &surface_views);
	r_module.def("set_image", &set_image);
	r_module.def("compare", &compare);
	r_module.def("write_png", &write_png_file);
	r_module.def("write_exr", &write_exr_file);
	r_module.def("make_picture",
			[](uint32_t p_width,
					uint32_t p_height) { // what handing a picture over costs: `lucent python -m lucent.overheads`
				return py::reinterpret_steal<py::object>(
						make_array(std::vector<float>(size_t(p_width) * p_height * 3, 0.5f), p_width, p_height, 3));
			});
}

} // namespace lucent::python
