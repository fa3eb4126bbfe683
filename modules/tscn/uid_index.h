// SPDX-License-Identifier: MIT
#pragma once
// Files by their UIDs, as Godot 4 writes them: into the headers of .tscn and .tres, into .import files and into .uid files.

#include <string>

namespace lucent {

// "uid://…" of a file itself; "" where it has none.
std::string file_uid(const std::string &p_path);

// The file below p_root that has p_uid; "" where there is none. The first question about a root reads the folder (names that begin
// with "." are left out; at most 200 000 files), later ones remember it.
std::string find_by_uid(const std::string &p_root, const std::string &p_uid);

} // namespace lucent
