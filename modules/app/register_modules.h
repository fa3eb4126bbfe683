// SPDX-License-Identifier: MIT
#pragma once

namespace lucent {

// Classes and loaders of every module that is built in.
void register_modules();

} // namespace lucent
