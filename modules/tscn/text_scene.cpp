// SPDX-License-Identifier: MIT
#include "modules/tscn/text_scene.h"

#include "modules/scene/load_report.h"
#include "modules/scene/node.h"
#include "modules/scene/node_3d.h"
#include "modules/scene/sky.h"
#include "modules/tscn/gd_script.h"
#include "modules/tscn/mesh_data.h"
#include "servers/core/class_db.h"

#include <algorithm>

namespace lucent {

namespace {

// Builds one instance of a TextScene.
class SceneBuilder {
public:
	SceneBuilder(const std::string &p_source, const std::vector<TscnNode> &p_nodes) :
			source(p_source), nodes(p_nodes) {}

	Result<std::unique_ptr<scene::Node>> build() {
		for (const TscnNode &node : nodes) {
			if (!add(node)) {
				return error;
			}
		}
		return std::move(root);
	}

private:
	bool fail(const TscnNode &p_node, const std::string &p_message) {
		error = make_error("{}:{}: {}", source, p_node.line, p_message);
		return false;
	}

	bool add(const TscnNode &p_node) {
		scene::Node *parent = nullptr;
		if (root) {
			parent = p_node.parent == "." ? root.get() : root->get_node_or_null(NodePath(p_node.parent));
			if (parent == nullptr) {
				scene::LoadReport::error(fmt::format("{}:{}: node '{}' is left out: there is no parent '{}'", source, p_node.line, p_node.name, p_node.parent));
				return true;
			}
		}
		if (parent != nullptr && p_node.type.empty() && !p_node.instance && !p_node.instance_failed) {
			return change_inherited(p_node, *parent);
		}
		std::unique_ptr<scene::Node> node;
		bool known_class = true;
		if (!make(p_node, parent, node, known_class)) {
			return false;
		}
		node->set_name(p_node.name);
		scene::Node *added = node.get();
		if (parent != nullptr) {
			parent->add_child(std::move(node));
			added->set_owner(root.get());
		} else {
			root = std::move(node);
		}
		configure(p_node, *added, known_class);
		return true;
	}

	// A node that an instanced scene brought, with other properties.
	bool change_inherited(const TscnNode &p_node, scene::Node &r_parent) {
		scene::Node *node = r_parent.get_node_or_null(NodePath(p_node.name));
		if (node == nullptr) {
			scene::LoadReport::error(fmt::format("{}:{}: node '{}' is left out: the scene that '{}' instances has no such node", source, p_node.line, p_node.name, p_node.parent));
			return true;
		}
		configure(p_node, *node, true);
		return true;
	}

	bool make(const TscnNode &p_node, const scene::Node *p_parent, std::unique_ptr<scene::Node> &r_node, bool &r_known_class) {
		if (p_node.instance) {
			Result<std::unique_ptr<scene::Node>> instance = p_node.instance->instantiate();
			if (!instance) {
				return fail(p_node, instance.error().message);
			}
			r_node = instance.take();
		} else if (p_node.instance_failed) { // said when it was read
			r_node = std::make_unique<scene::Node3D>();
			r_known_class = false;
			return true;
		} else if (p_node.type.empty()) {
			return fail(p_node, fmt::format("node '{}' has neither a type nor an instance", p_node.name));
		} else {
			r_node = ClassDB::instantiate_as<scene::Node>(p_node.type);
		}
		if (!r_node) {
			r_known_class = false;
			const scene::LeftOutKind *kind = scene::find_left_out(p_node.type);
			const bool spatial = kind != nullptr ? kind->spatial : p_parent == nullptr || dynamic_cast<const scene::Node3D *>(p_parent) != nullptr || p_node.type.ends_with("3D");
			scene::LoadReport::left_out_class(fmt::format("{}:{}", source, p_node.line), p_node.type);
			r_node = spatial ? std::make_unique<scene::Node3D>() : std::make_unique<scene::Node>();
		}
		return true;
	}

	void configure(const TscnNode &p_node, scene::Node &r_node, bool p_known_class) {
		for (const std::string &group : p_node.groups) {
			r_node.add_to_group(group);
		}
		for (const TscnProperty &property : p_node.properties) {
			if (p_known_class || r_node.has_property(property.name)) { // else the class's warning says enough
				set_text_property(r_node, property, source);
			}
		}
	}

	const std::string &source;
	const std::vector<TscnNode> &nodes;
	std::unique_ptr<scene::Node> root;
	Error error;
};

// Connections to methods that are here; the others are scripts'.
void connect(scene::Node &r_root, const TscnConnection &p_connection) {
	scene::Node *from = r_root.get_node_or_null(NodePath(p_connection.from));
	scene::Node *to = r_root.get_node_or_null(NodePath(p_connection.to));
	if (from == nullptr || to == nullptr || !ClassDB::has_signal(from->get_class(), p_connection.signal) || ClassDB::get_method(to->get_class(), p_connection.method) == nullptr) {
		return;
	}
	const ObjectID target = to->get_instance_id();
	const auto handler = [target, method = p_connection.method](const Array &p_arguments) {
		Object *object = ObjectDB::get(target);
		if (object == nullptr) {
			return;
		}
		if (const Result<Variant> result = object->call(method, p_arguments); !result) {
			log_error("{}", result.error().message);
		}
	};
	from->connect(p_connection.signal, handler, to);
}

} // namespace

void set_text_property(Object &r_object, const TscnProperty &p_property, const std::string &p_source) {
	const std::string place = fmt::format("{}:{}", p_source, p_property.line);
	if (scene::ArrayMesh *mesh = dynamic_cast<scene::ArrayMesh *>(&r_object); mesh != nullptr && p_property.name == "_surfaces") {
		add_mesh_surfaces(*mesh, p_property.value, p_source, p_property.line);
		return;
	}
	if (p_property.name == "script") {
		if (const Resource *script = dynamic_cast<const Resource *>(p_property.value.get_object())) { // the first stands for all
			scene::LoadReport::left_out_script(r_object);
			const std::string notice = fmt::format("{}: {}", place, gd_script_notice(r_object, *script));
			if (!scene::LoadReport::warning("script", notice)) {
				scene::LoadReport::note(notice, notice);
			}
		}
		return;
	}
	if (!r_object.has_property(p_property.name)) {
		scene::LoadReport::left_out_property(place, r_object, p_property.name);
		return;
	}
	if (p_property.value.is_nil() && p_property.name == "sky_material" && r_object.is_class("Sky")) {
		scene::LoadReport::warning("sky_material", fmt::format("{}: the sky's material is not supported; a procedural sky takes its place", place));
		r_object.set("sky_material", std::make_shared<scene::ProceduralSkyMaterial>());
		return;
	}
	if (p_property.value.is_nil()) { // null, or a resource that is left out: the default stays
		return;
	}
	const std::string key = fmt::format("value {} {}", r_object.get_class(), p_property.name);
	const PropertyInfo *info = ClassDB::get_property(r_object.get_class(), p_property.name);
	bool clamped = false;
	const Status status = info != nullptr ? info->stored_set(r_object, p_property.value, clamped) : r_object.set_property(p_property.name, p_property.value);
	if (!status) {
		scene::LoadReport::warning(key, fmt::format("{}: {}; skipped", place, status.error().message));
	} else if (clamped) {
		scene::LoadReport::warning(key, fmt::format("{}: {}.{} can't be {}; it becomes {}", place, r_object.get_class(), p_property.name, p_property.value.to_string(), r_object.get(p_property.name).to_string()));
	}
}

static Result<std::unique_ptr<scene::Node>> build_scene(const TscnSceneData &p_data) {
	const scene::LoadReport::Scope report;
	Result<std::unique_ptr<scene::Node>> root = SceneBuilder(p_data.source, p_data.nodes).build();
	if (root) {
		root.value()->set_scene_file_path(p_data.source);
		for (const TscnConnection &connection : p_data.connections) {
			connect(*root.value(), connection);
		}
	}
	return root;
}

TextScene::TextScene(std::shared_ptr<const TscnSceneData> p_data) :
		PackedScene([p_data] { return build_scene(*p_data); }), data(p_data) {}

} // namespace lucent
