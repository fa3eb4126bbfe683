// SPDX-License-Identifier: MIT
// The registry against Godot's class reference (tests/data/godot_api.json: names, types and defaults of Godot 4's classes).
#include "modules/scene/class_documentation.h"
#include "modules/scene/register_scene_types.h"
#include "servers/core/class_db.h"
#include "tests/test_support.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <set>

using namespace lucent;

namespace {

nlohmann::json load_api() {
	std::ifstream file(test::options().root + "tests/data/godot_api.json");
	REQUIRE(file.good());
	return nlohmann::json::parse(file);
}

// Ours on purpose: the reasons are in their descriptions.
const std::set<std::string> OTHER_DEFAULTS = { "sdfgi_use_occlusion", "sdfgi_bounce_feedback" };

std::string type_name(const PropertyInfo &p_property) {
	if (!p_property.class_name.empty()) {
		return p_property.class_name;
	}
	return Variant::get_type_name(p_property.type);
}

bool same_type(const std::string &p_ours, const std::string &p_theirs) {
	return p_ours == p_theirs || (p_theirs == "StringName" && p_ours == "String") || p_ours.ends_with("." + p_theirs);
}

} // namespace

TEST_CASE("registered properties have Godot's names, types and defaults") {
	scene::register_scene_classes();
	const nlohmann::json api = load_api();
	int compared = 0;
	for (const auto &item : api.items()) {
		const std::string &class_name = item.key();
		const nlohmann::json &theirs = item.value();
		const ClassInfo *ours = ClassDB::get_class_info(class_name);
		INFO(class_name);
		REQUIRE(ours);
		const std::string parent = theirs["inherits"];
		CHECK((ours->parent == parent || (parent == "RefCounted" && ours->parent == "Object")));
		for (const PropertyInfo &property : ours->properties) {
			INFO(property.name);
			CHECK_FALSE(property.documentation.empty());
			REQUIRE(theirs["members"].contains(property.name));
			CHECK_MESSAGE(same_type(type_name(property), theirs["members"][property.name][0]), type_name(property));
		}
		for (const auto &member_item : theirs["members"].items()) {
			const std::string &name = member_item.key();
			const nlohmann::json &member = member_item.value();
			const PropertyInfo *property = ClassDB::get_property(class_name, name);
			if (!property || member[1].is_null() || !(property->usage & PROPERTY_USAGE_STORAGE) || OTHER_DEFAULTS.contains(name)) {
				continue;
			}
			INFO(name);
			CHECK(ClassDB::get_property_default(class_name, name).to_string() == member[1].get<std::string>());
			compared++;
		}
	}
	CHECK(compared > 130);
}

TEST_CASE("constants and signals are Godot's") {
	scene::register_scene_classes();
	const nlohmann::json api = load_api();
	for (const auto &item : api.items()) {
		const std::string &class_name = item.key();
		const nlohmann::json &theirs = item.value();
		INFO(class_name);
		const ClassInfo &ours = *ClassDB::get_class_info(class_name);
		for (const ConstantInfo &constant : ours.constants) {
			if (constant.enum_name == "EulerOrder") {
				continue; // of Godot's global scope
			}
			INFO(constant.name);
			REQUIRE(theirs["constants"].contains(constant.name));
			CHECK(theirs["constants"][constant.name] == constant.value);
		}
		for (const SignalInfo &signal : ours.signals) {
			INFO(signal.name);
			CHECK(std::find(theirs["signals"].begin(), theirs["signals"].end(), signal.name) != theirs["signals"].end());
		}
	}
}

TEST_CASE("every sdfgi property of Godot is there") {
	scene::register_scene_classes();
	const nlohmann::json api = load_api();
	int count = 0;
	for (const auto &member_item : api["Environment"]["members"].items()) { // clang 14: a structured binding cannot be captured by INFO
		const std::string &name = member_item.key();
		if (name.starts_with("sdfgi_")) {
			INFO(name);
			CHECK(ClassDB::get_property("Environment", name));
			count++;
		}
	}
	CHECK(count == 12);
}

TEST_CASE("setting every property to its default works and changes nothing") {
	scene::register_scene_classes();
	for (const std::string &class_name : ClassDB::get_class_list()) {
		if (!ClassDB::can_instantiate(class_name)) {
			continue;
		}
		const std::unique_ptr<Object> object = ClassDB::instantiate(class_name);
		for (const PropertyInfo *property : ClassDB::get_property_list(class_name)) {
			if (property->usage & PROPERTY_USAGE_STORAGE) {
				INFO(class_name, ".", property->name);
				const Status status = object->set_property(property->name, ClassDB::get_property_default(class_name, property->name));
				CHECK_MESSAGE(status.ok(), status.error().message);
				CHECK(object->get(property->name) == ClassDB::get_property_default(class_name, property->name));
			}
		}
	}
}

TEST_CASE("class documents") {
	scene::register_scene_classes();
	const std::string xml = scene::class_xml("OmniLight3D");
	CHECK(xml.find("<class name=\"OmniLight3D\" inherits=\"Light3D\">") != std::string::npos);
	CHECK(xml.find("<member name=\"omni_range\" type=\"float\" setter=\"set_omni_range\" getter=\"get_omni_range\" default=\"5.0\">") != std::string::npos);
	CHECK(xml.find("<member name=\"light_specular\" type=\"float\" setter=\"set_light_specular\" getter=\"get_light_specular\" overrides=\"Light3D\" default=\"0.5\" />") != std::string::npos);
	CHECK(scene::class_xml("Environment").find("type=\"int\" enum=\"Environment.BGMode\"") != std::string::npos);
	CHECK(scene::class_xml("NoSuchClass").empty());
	const std::filesystem::path folder = std::filesystem::temp_directory_path() / "lucent_test_doctool";
	CHECK(scene::write_class_xml(folder.string()).ok());
	CHECK(std::filesystem::file_size(folder / "Node.xml") > 500);
	CHECK_FALSE(scene::write_class_xml((folder / "Node.xml").string()).ok());
	std::filesystem::remove_all(folder);
}
