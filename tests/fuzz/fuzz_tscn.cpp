// SPDX-License-Identifier: MIT
// .tscn and .tres: from text to the server's scene.
#include "modules/tscn/text_loader.h"
#include "tests/fuzz/fuzz_support.h"

using namespace lucent;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *p_data, size_t p_size) {
	[[maybe_unused]] static const bool prepared = test::prepare_fuzzing();
	const Result<Ref<Resource>> resource = load_text_resource({ reinterpret_cast<const char *>(p_data), p_size }, "/nonexistent/fuzz.tscn");
	if (resource) {
		if (const auto packed = std::dynamic_pointer_cast<scene::PackedScene>(resource.value())) {
			test::show_scene(*packed);
		}
	}
	return 0;
}
