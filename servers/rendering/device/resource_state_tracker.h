// SPDX-License-Identifier: MIT
#pragma once
// Derives barriers from what each command says it touches. Knows no graphics API.

#include "servers/rendering/device/rendering_device_driver.h"

namespace lucent {

// What has happened to one buffer, or to one mip of one layer, since its last write.
struct AccessState {
	uint32_t last = 0; // Access bits that the next user must wait for: the last write, or the first user of the last layout
	uint32_t readers = 0; // that already waited for `last`
	TextureLayout layout = TextureLayout::UNDEFINED;
	uint32_t command = 0; // that used it last
	bool agrees(const AccessState &p_other) const { return last == p_other.last && readers == p_other.readers && layout == p_other.layout; }
};

class TextureState {
public:
	TextureState() = default;
	TextureState(uint32_t p_mips, uint32_t p_layers) :
			mips(p_mips), layers(p_layers), states(1) {}
	TextureRange whole() const { return { 0, mips, 0, layers }; }
	const AccessState &at(uint32_t p_mip, uint32_t p_layer) const { return states.size() == 1 ? states[0] : states[p_layer * mips + p_mip]; }

private:
	friend class ResourceStateTracker;
	uint32_t mips = 1;
	uint32_t layers = 1;
	std::vector<AccessState> states; // one for all subresources while they agree, else layer-major
};

// Collects the barriers that must precede the next command. A command may use a resource several times.
class ResourceStateTracker {
public:
	ResourceStateTracker() = default;
	// p_command 0: its uses are of no command, and conflict with none.
	explicit ResourceStateTracker(uint32_t p_command) :
			command(p_command) {}
	void use_buffer(DriverBuffer p_buffer, AccessState &r_state, uint32_t p_access);
	// p_discard: the old contents are not needed. False: this command needs it in two layouts at once.
	bool use_texture(DriverTexture p_texture, TextureState &r_state, const TextureRange &p_range, uint32_t p_access, TextureLayout p_layout, bool p_discard = false);

	const std::vector<Barrier> &barriers() const { return pending; }
	// The command has been recorded; what follows belongs to the next.
	void next_command() {
		pending.clear();
		command++;
	}

private:
	uint32_t command = 1;
	std::vector<Barrier> pending;
};

} // namespace lucent
