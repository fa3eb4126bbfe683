// SPDX-License-Identifier: MIT
#pragma once
// Typed resource ids: an index and a generation. A stale id is detected, never dereferenced.

#include "servers/core/error.h"

#include <cstdint>
#include <vector>

namespace lucent {

template <typename Tag>
struct Rid {
	uint32_t index = UINT32_MAX;
	uint32_t generation = 0;

	bool is_valid() const { return index != UINT32_MAX; }
	bool operator==(const Rid &) const = default;
};

// Owns the values behind Rids of one tag. get() returns null for stale and null ids.
template <typename T, typename Tag = T>
class RidOwner {
public:
	Rid<Tag> make(T p_value) {
		uint32_t index;
		if (!free_slots.empty()) {
			index = free_slots.back();
			free_slots.pop_back();
		} else {
			index = uint32_t(slots.size());
			slots.emplace_back();
		}
		slots[index].value = std::move(p_value);
		slots[index].alive = true;
		alive_count++;
		return { index, slots[index].generation };
	}
	T *get(Rid<Tag> p_rid) {
		return const_cast<T *>(std::as_const(*this).get(p_rid));
	}
	const T *get(Rid<Tag> p_rid) const {
		if (p_rid.index >= slots.size() || !slots[p_rid.index].alive || slots[p_rid.index].generation != p_rid.generation) {
			return nullptr;
		}
		return &slots[p_rid.index].value;
	}
	bool free(Rid<Tag> p_rid) {
		if (!get(p_rid)) {
			return false;
		}
		Slot &slot = slots[p_rid.index];
		slot.value = T();
		slot.alive = false;
		slot.generation++;
		free_slots.push_back(p_rid.index);
		alive_count--;
		return true;
	}
	uint32_t size() const { return alive_count; }
	// Calls p_visit(Rid, T &) for every live value, in slot order.
	template <typename F>
	void for_each(F &&p_visit) {
		for (uint32_t i = 0; i < slots.size(); i++) {
			if (slots[i].alive) {
				p_visit(Rid<Tag>{ i, slots[i].generation }, slots[i].value);
			}
		}
	}
	template <typename F>
	void for_each(F &&p_visit) const {
		for (uint32_t i = 0; i < slots.size(); i++) {
			if (slots[i].alive) {
				p_visit(Rid<Tag>{ i, slots[i].generation }, slots[i].value);
			}
		}
	}

private:
	struct Slot {
		T value{};
		uint32_t generation = 0;
		bool alive = false;
	};
	std::vector<Slot> slots;
	std::vector<uint32_t> free_slots;
	uint32_t alive_count = 0;
};

} // namespace lucent
