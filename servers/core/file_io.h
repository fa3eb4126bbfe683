// SPDX-License-Identifier: MIT
#pragma once
// Whole files in and out. Paths are UTF-8. Errors read "path: what went wrong".

#include "servers/core/error.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lucent {

// The file's bytes. An error when it is missing, not a regular file, unreadable or larger than p_max_bytes.
Result<std::vector<std::byte>> read_file(const std::string &p_path, uint64_t p_max_bytes = uint64_t(2) << 30);

// Writes to a temporary file in p_path's folder and renames it, so that p_path is either whole or as it was. An existing device
// or pipe (/dev/stdout) is written to directly; a symbolic link keeps pointing where it did.
Status write_file(const std::string &p_path, std::span<const std::byte> p_bytes);

// "dir/" of "dir/name", "" of "name".
std::string path_folder(const std::string &p_path);

// Lower-case extension without the dot: "glb" of "a/b.GLB", "" where there is none.
std::string path_extension(const std::string &p_path);

} // namespace lucent
