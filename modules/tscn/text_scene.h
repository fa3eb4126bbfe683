// SPDX-License-Identifier: MIT
#pragma once
// A .tscn in memory: what to build, with resources already loaded and shared by every copy.

#include "modules/scene/packed_scene.h"
#include "modules/tscn/text_file.h"

#include <memory>
#include <string>
#include <vector>

namespace lucent {

struct TscnNode {
	std::string name;
	std::string type; // empty: instance, or a node that the instanced scene brings
	std::string parent; // path from the root; empty: this is the root
	Ref<scene::PackedScene> instance;
	bool instance_failed = false; // it can't be read, which was said: an empty node takes its place
	std::vector<std::string> groups;
	std::vector<TscnProperty> properties;
	int line = 0;
};

struct TscnConnection {
	std::string signal;
	std::string from;
	std::string to;
	std::string method;
};

// Sets a property read from p_source, as Godot stores it: ranges are the inspector's. Unknown ones and wrong values: a warning.
void set_text_property(Object &r_object, const TscnProperty &p_property, const std::string &p_source);

// What a TextScene and its copies share.
struct TscnSceneData {
	std::string source; // the file, for messages
	std::vector<TscnNode> nodes; // the first is the root; parents come before children
	std::vector<TscnConnection> connections;
	size_t node_count = 0; // of one copy, with those of the text scenes in it
};

// instantiate(): unknown classes and properties are warned of once each; errors name file and line.
class TextScene : public scene::PackedScene {
public:
	explicit TextScene(std::shared_ptr<const TscnSceneData> p_data);
	size_t get_node_count() const { return data->node_count; }

private:
	std::shared_ptr<const TscnSceneData> data;
};

} // namespace lucent
