// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace lucent {

// A weak handle to an Object: ObjectDB::get() answers null once the object is gone. 0 is no object.
struct ObjectID {
	uint64_t value = 0;

	bool is_valid() const { return value != 0; }
	bool operator==(const ObjectID &) const = default;
};

} // namespace lucent
