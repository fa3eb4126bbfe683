// SPDX-License-Identifier: MIT
#include "modules/app/bench.h"
#include "modules/app/bench_results.h"
#include "modules/app/commands.h"

namespace lucent {

int bench_command(const std::vector<std::string> &p_args) {
	const Result<BenchOptions> options = parse_bench_options(p_args);
	if (!options) {
		return bench_failure(EXIT_USAGE, options.error());
	}
	if (options.value().exit) {
		return EXIT_OK;
	}
	switch (options.value().kind) {
		case BenchKind::QUALITY:
			return bench_quality(options.value());
		case BenchKind::FURNACE:
			return bench_furnace(options.value());
		case BenchKind::SPEED:
			return bench_speed(options.value());
		case BenchKind::RESPONSE:
			return bench_response(options.value());
		case BenchKind::TRUTH:
			break;
	}
	return bench_truth(options.value());
}

} // namespace lucent
