// SPDX-License-Identifier: MIT
#pragma once
// Meshes, images and measures from numpy's arrays.

namespace pybind11 {
class module_;
}

namespace lucent::python {

void define_arrays(pybind11::module_ &r_module);

} // namespace lucent::python
