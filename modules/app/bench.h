// SPDX-License-Identifier: MIT
#pragma once
// The parts of `lucent bench`. Each returns an ExitCode.

#include "modules/app/bench_options.h"

namespace lucent {

int bench_quality(const BenchOptions &p_options);
int bench_furnace(const BenchOptions &p_options);
int bench_speed(const BenchOptions &p_options);
int bench_response(const BenchOptions &p_options);
int bench_truth(const BenchOptions &p_options);

} // namespace lucent
