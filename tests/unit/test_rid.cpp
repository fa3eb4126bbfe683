// SPDX-License-Identifier: MIT
#include "servers/core/rid.h"

#include <doctest/doctest.h>

#include <string>

using namespace lucent;

TEST_CASE("core: a freed rid stays dead after its slot is used again") {
	RidOwner<std::string, struct NameTag> owner;
	const Rid<NameTag> first = owner.make("first");
	const Rid<NameTag> second = owner.make("second");
	CHECK(owner.free(first));
	CHECK_FALSE(owner.free(first));
	const Rid<NameTag> third = owner.make("third");
	CHECK(third.index == first.index);
	CHECK(owner.get(first) == nullptr);
	REQUIRE(owner.get(third) != nullptr);
	CHECK(*owner.get(third) == "third");
	CHECK(*owner.get(second) == "second");
	CHECK(owner.get(Rid<NameTag>()) == nullptr);
	CHECK(owner.size() == 2);
}
