// SPDX-License-Identifier: MIT
// .glb and .gltf: from bytes to the server's scene.
#include "modules/gltf/gltf_scene.h"
#include "tests/fuzz/fuzz_support.h"

using namespace lucent;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *p_data, size_t p_size) {
	[[maybe_unused]] static const bool prepared = test::prepare_fuzzing();
	GltfLimits limits;
	limits.max_decoded_bytes = uint64_t(64) << 20;
	Result<GltfDocument> document = parse_gltf(std::as_bytes(std::span(p_data, p_size)), "fuzz.glb", nullptr, limits);
	if (document) {
		const Result<Ref<scene::PackedScene>> packed = gltf_to_scene(document.take(), "fuzz");
		if (packed) {
			test::show_scene(*packed.value());
		}
	}
	return 0;
}
