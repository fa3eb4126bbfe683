// SPDX-License-Identifier: MIT
#pragma once

#include "servers/rendering/device/rendering_device_impl.h"

namespace lucent {

// Checks the declared bindings against Impl::scratch_shaders, fills Impl::scratch_bindings and scratch_kinds, and puts the
// resources into the tracker and into r_info.
void resolve_bindings(RenderingDevice::Impl &r_impl, std::span<const PassBinding> p_bindings, bool p_graphics, PassInfo &r_info);

} // namespace lucent
