// SPDX-License-Identifier: MIT
#include "servers/rendering/device/resource_state_tracker.h"

#include <algorithm>

namespace lucent {

namespace {

// What one access must wait for; moves r_state on. Returns false if nothing needs waiting or changing.
bool advance(AccessState &r_state, uint32_t p_access, TextureLayout p_layout, bool p_discard, Barrier &r_barrier) {
	const bool writes = (p_access & ACCESS_ALL_WRITES) != 0;
	const bool transition = p_layout != r_state.layout;
	r_barrier.target = p_access;
	r_barrier.old_layout = p_discard ? TextureLayout::UNDEFINED : r_state.layout;
	r_barrier.new_layout = p_layout;
	if (!writes && !transition) {
		r_barrier.source = r_state.last;
		const bool wait = r_state.last != 0 && (p_access & ~r_state.readers) != 0;
		r_state.readers |= p_access;
		return wait;
	}
	r_barrier.source = r_state.last | r_state.readers;
	// A transition is itself a write: whoever reads next in another stage waits for the stage that it happened before.
	r_state.last = p_access;
	r_state.readers = writes ? 0 : p_access;
	r_state.layout = p_layout;
	return transition || r_barrier.source != 0;
}

} // namespace

void ResourceStateTracker::use_buffer(DriverBuffer p_buffer, AccessState &r_state, uint32_t p_access) {
	Barrier barrier;
	if (advance(r_state, p_access, TextureLayout::UNDEFINED, false, barrier)) {
		barrier.buffer = p_buffer;
		pending.push_back(barrier);
	}
}

bool ResourceStateTracker::use_texture(DriverTexture p_texture, TextureState &r_state, const TextureRange &p_range, uint32_t p_access, TextureLayout p_layout, bool p_discard) {
	Barrier barrier;
	barrier.texture = p_texture;
	barrier.range = p_range;
	std::vector<AccessState> &states = r_state.states;
	const bool whole = p_range == r_state.whole();
	bool agreed = true;
	const auto enter = [&](AccessState &r_subresource) {
		agreed = agreed && (command == 0 || r_subresource.command != command || r_subresource.layout == p_layout);
		r_subresource.command = command;
	};
	if (whole && states.size() == 1) {
		enter(states[0]);
		if (advance(states[0], p_access, p_layout, p_discard, barrier)) {
			pending.push_back(barrier);
		}
		return agreed;
	}
	if (states.size() == 1) {
		states.resize(size_t(r_state.mips) * r_state.layers, states[0]);
	}
	for (uint32_t layer = p_range.first_layer; layer < p_range.first_layer + p_range.layer_count; layer++) {
		for (uint32_t mip = p_range.first_mip; mip < p_range.first_mip + p_range.mip_count; mip++) {
			barrier.range = { mip, 1, layer, 1 };
			AccessState &subresource = states[layer * r_state.mips + mip];
			enter(subresource);
			if (!advance(subresource, p_access, p_layout, p_discard, barrier)) {
				continue;
			}
			// Neighbouring mips of a layer share a barrier.
			Barrier *last = pending.empty() ? nullptr : &pending.back();
			const bool joins = last != nullptr && mip > p_range.first_mip && last->texture == p_texture && last->range.first_layer == layer &&
					last->range.layer_count == 1 && last->range.first_mip + last->range.mip_count == mip && last->source == barrier.source &&
					last->target == barrier.target && last->old_layout == barrier.old_layout && last->new_layout == barrier.new_layout;
			if (joins) {
				last->range.mip_count++;
			} else {
				pending.push_back(barrier);
			}
		}
	}
	if (whole) {
		const bool all_agree = std::all_of(states.begin(), states.end(), [&](const AccessState &p_state) { return p_state.agrees(states[0]); });
		states.resize(all_agree ? 1 : states.size());
	}
	return agreed;
}

} // namespace lucent
