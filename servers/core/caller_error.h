// SPDX-License-Identifier: MIT
#pragma once
// Where ERR_FAIL_*'s sentences go instead of into the log: a script wants them as errors of its own.

#include "servers/core/error.h"

#include <functional>
#include <string>

namespace lucent {

// True: the message is taken care of.
using CallerErrorHandler = std::function<bool(const std::string &p_message)>;

// Answers the one that was there; an empty one lets messages go into the log.
CallerErrorHandler set_caller_error_handler(CallerErrorHandler p_handler);

} // namespace lucent
