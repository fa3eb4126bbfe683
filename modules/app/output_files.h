// SPDX-License-Identifier: MIT
#pragma once

#include "modules/app/render_options.h"
#include "servers/rendering/rendering_server.h"

#include <string>

namespace lucent {

// Whether a file of that name can be created or replaced; leaves nothing behind. Asked before the work, so that it isn't lost.
Status check_writable(const std::string &p_path);

// Writes every -o from the viewport's last frame: whole files or none.
Status write_pictures(RenderingServer &p_server, ViewportRid p_viewport, const RenderOptions &p_options);

} // namespace lucent
