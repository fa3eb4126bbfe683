// SPDX-License-Identifier: MIT
#include "servers/core/class_builder.h"
#include "servers/core/class_db.h"

#include <doctest/doctest.h>

using namespace lucent;

namespace {

enum class Fruit : uint8_t {
	APPLE,
	PEAR
};

class Basket : public Resource {
	LUCENT_CLASS(Basket, Resource)
public:
	struct State {
		float ripeness = 0.2f;
		Fruit fruit = Fruit::PEAR;
		Ref<Resource> label;
		Color color{ 0.5f, 0.25f, 1.0f, 1.0f };
	};
	void set_count(int p_count) { count = p_count; }
	int get_count() const { return count; }
	bool set_odd(int p_value) { return p_value % 2 == 1; }
	int get_odd() const { return 1; }
	std::string greet(const std::string &p_who, int p_times) const { return p_who + std::to_string(p_times); }
	void state_changed() { changes++; }

	int changes = 0;

private:
	State state;
	int count = 3;
};

class SmallBasket : public Basket {
	LUCENT_CLASS(SmallBasket, Basket)
public:
	SmallBasket() { set_count(1); }
};

void Basket::bind(ClassBuilder<Basket> &r_class) {
	r_class.enumeration("Fruit", { { "APPLE", Fruit::APPLE }, { "PEAR", Fruit::PEAR } });
	r_class.property("count", &Basket::set_count, &Basket::get_count).range(0, 10, 1).doc("How many.");
	r_class.property("odd", &Basket::set_odd, &Basket::get_odd);
	r_class.field("ripeness", &Basket::state, &State::ripeness).range(0.01, 1, 0.01).or_greater();
	r_class.field("fruit", &Basket::state, &State::fruit).enum_of("Fruit");
	r_class.field("label", &Basket::state, &State::label);
	r_class.field("color", &Basket::state, &State::color);
	r_class.method("greet", &Basket::greet, { "who", "times" });
	r_class.signal("eaten");
}

void SmallBasket::bind(ClassBuilder<SmallBasket> &r_class) {
	r_class.doc("Holds less.");
}

void register_baskets() {
	register_core_classes();
	ClassDB::register_class<Basket>();
	ClassDB::register_class<SmallBasket>();
}

} // namespace

TEST_CASE("class registry: classes, defaults and inheritance") {
	register_baskets();
	CHECK(ClassDB::class_exists("Basket"));
	CHECK_FALSE(ClassDB::class_exists("Bucket"));
	CHECK(ClassDB::is_parent_class("SmallBasket", "Object"));
	CHECK_FALSE(ClassDB::is_parent_class("Basket", "SmallBasket"));
	CHECK(ClassDB::get_property_default("Basket", "count") == Variant(3));
	CHECK(ClassDB::get_property_default("SmallBasket", "count") == Variant(1));
	CHECK(ClassDB::get_property_default("SmallBasket", "ripeness").to_string() == "0.2");
	CHECK(ClassDB::get_property("SmallBasket", "fruit")->class_name == "Basket.Fruit");
	CHECK(ClassDB::get_property("Basket", "count")->documentation == "How many.");
	CHECK(ClassDB::get_property_list("SmallBasket").front()->name == "resource_name");
	CHECK(ClassDB::instantiate("Bucket") == nullptr);
	const Ref<Basket> basket = ClassDB::instantiate_resource<Basket>("SmallBasket");
	REQUIRE(basket);
	CHECK(std::string(basket->get_class()) == "SmallBasket");
	CHECK(basket->weak_from_this().lock() == basket);
}

TEST_CASE("properties: conversion, ranges, enums, rejection") {
	register_baskets();
	const auto basket = std::make_shared<Basket>();
	CHECK(basket->set("count", 7.0));
	CHECK(basket->get_count() == 7);
	CHECK_FALSE(basket->set("count", 11));
	CHECK_FALSE(basket->set("count", 2.5));
	CHECK_FALSE(basket->set("count", "7"));
	CHECK(basket->get_count() == 7);
	CHECK_FALSE(basket->set("odd", 2));
	CHECK(basket->set("odd", 3));
	CHECK(basket->set("ripeness", 0.01));
	CHECK(basket->set("ripeness", 50));
	CHECK_FALSE(basket->set("ripeness", 0.005));
	CHECK_FALSE(basket->set("ripeness", std::nan("")));
	CHECK(basket->set("fruit", 0));
	CHECK_FALSE(basket->set("fruit", 2));
	CHECK(basket->set("label", Variant(std::make_shared<Resource>())));
	CHECK(basket->set("label", Variant()));
	CHECK(basket->get("label").is_null());
	const Status status = basket->set_property("weight", 1);
	CHECK(status.error().message == "Basket has no property 'weight'");
	const int changes = basket->changes;
	CHECK(basket->set("ripeness", 50));
	CHECK(basket->changes == changes);
}

TEST_CASE("methods check names, counts and types") {
	register_baskets();
	const auto basket = std::make_shared<Basket>();
	CHECK(basket->call("greet", { "you", 2 }).value() == Variant("you2"));
	CHECK_FALSE(basket->call("greet", { "you" }).ok());
	CHECK_FALSE(basket->call("greet", { "you", "two" }).ok());
	CHECK_FALSE(basket->call("shout").ok());
	CHECK(basket->call("set_count", { 4 }).ok());
	CHECK(basket->call("get_count").value() == Variant(4));
	CHECK_FALSE(basket->call("set_count", { 40 }).ok());
}

TEST_CASE("signals end with their target and may disconnect while emitting") {
	register_baskets();
	Basket basket;
	int calls = 0;
	auto listener = std::make_unique<Object>();
	basket.connect(
			"eaten", [&](const Array &p_arguments) { calls += int(p_arguments.size()); }, listener.get());
	basket.emit_signal("eaten", { 1, 2 });
	CHECK(calls == 2);
	listener.reset();
	basket.emit_signal("eaten", { 1 });
	CHECK(calls == 2);
	ConnectionID once = 0;
	once = basket.connect("eaten", [&](const Array &) { calls += 10, basket.disconnect(once); });
	basket.emit_signal("eaten");
	basket.emit_signal("eaten");
	CHECK(calls == 12);
	LogHandler previous = set_log_handler([](LogLevel, std::string_view) {});
	CHECK(basket.connect("thrown", [](const Array &) {}) == 0);
	set_log_handler(previous);
}

TEST_CASE("object ids are weak") {
	ObjectID id;
	{
		Object object;
		id = object.get_instance_id();
		CHECK(ObjectDB::get(id) == &object);
		CHECK(Variant(&object).get_object() == &object);
	}
	CHECK(ObjectDB::get(id) == nullptr);
	Object next; // takes the slot, not the id
	CHECK(ObjectDB::get(id) == nullptr);
	CHECK(ObjectDB::get(ObjectID()) == nullptr);
}

TEST_CASE("Variant writes Godot's text") {
	CHECK(Variant().to_string() == "null");
	CHECK(Variant(true).to_string() == "true");
	CHECK(Variant(1.0f).to_string() == "1.0");
	CHECK(Variant(12.8f).to_string() == "12.8");
	CHECK(Variant("a\"b").to_string() == "\"a\\\"b\"");
	CHECK(Variant(Vector3(1, 2.5f, -3)).to_string() == "Vector3(1, 2.5, -3)");
	CHECK(Variant(Color{ 0, 0.5f, 1, 1 }).to_string() == "Color(0, 0.5, 1, 1)");
	CHECK(Variant(NodePath("A/B:c")).to_string() == "NodePath(\"A/B:c\")");
	CHECK(Variant(Array{ 1, "x" }).to_string() == "[1, \"x\"]");
	CHECK(Variant(AABB()).to_string() == "AABB(0, 0, 0, 0, 0, 0)");
	Transform3D transform;
	transform.basis[0] = Vector3(1, 2, 3); // a column
	transform.origin = Vector3(7, 8, 9);
	CHECK(Variant(transform).to_string() == "Transform3D(1, 0, 0, 2, 1, 0, 3, 0, 1, 7, 8, 9)");
	CHECK(Variant(1) == Variant(1.0));
	CHECK_FALSE(Variant(1) == Variant(true));
}

TEST_CASE("Variant components and conversion") {
	Variant color(Color{ 0, 0.5f, 1, 1 });
	CHECK(color.get_component("g") == Variant(0.5f));
	CHECK(color.set_component("r", 0.25));
	CHECK(color.get_if<Color>()->r == 0.25f);
	CHECK_FALSE(color.set_component("x", 1));
	Variant transform{ Transform3D() };
	CHECK(transform.set_component("origin", Vector3(1, 2, 3)));
	CHECK(transform.get_component("origin") == Variant(Vector3(1, 2, 3)));
	CHECK(variant_cast<Vector3>(Variant(Vector3i(1, 2, 3))) == Vector3(1, 2, 3));
	CHECK(variant_cast<uint8_t>(Variant(256)) == std::nullopt);
	CHECK(variant_cast<float>(Variant(1e300)) == std::nullopt);
	CHECK(variant_cast<std::vector<float>>(Variant(Array{ 1, 2.5 })) == std::vector<float>{ 1, 2.5f });
	CHECK(variant_cast<std::vector<float>>(Variant(Array{ 1, "x" })) == std::nullopt);
	const NodePath path("../Sun/./Lamp:light_color:r");
	CHECK(path.get_names() == std::vector<std::string>{ "..", "Sun", "Lamp" });
	CHECK(path.get_subnames() == std::vector<std::string>{ "light_color", "r" });
}
