// SPDX-License-Identifier: MIT
#include "modules/scene/visual_instance_3d.h"

#include "modules/scene/scene_tree.h"
#include "modules/scene/viewport.h"
#include "servers/core/class_builder.h"

#include <algorithm>

namespace lucent::scene {

void VisualInstance3D::_notification(int p_what) {
	Node3D::_notification(p_what);
	switch (p_what) {
		case NOTIFICATION_ENTER_WORLD:
			context = is_in_tree_world(*this) ? get_tree()->get_context() : nullptr;
			if (context) {
				RenderingServer &server = context->server();
				instance = server.instance_create();
				server.instance_set_transform(instance, get_global_transform());
				server.instance_set_visible(instance, is_shown());
				server.instance_set_layer_mask(instance, layers);
				send_instance(server);
				server.instance_set_scenario(instance, get_tree()->get_scenario());
			}
			break;
		case NOTIFICATION_EXIT_WORLD:
			if (context) {
				context->server().free(instance);
				free_base(context->server());
				instance = {};
				context = nullptr;
			}
			break;
		case NOTIFICATION_TRANSFORM_CHANGED:
			if (context) {
				context->server().instance_set_transform(instance, get_global_transform());
			}
			break;
		case NOTIFICATION_VISIBILITY_CHANGED:
			update_visibility();
			break;
	}
}

void VisualInstance3D::update_visibility() {
	if (context) {
		context->server().instance_set_visible(instance, is_shown());
	}
}

void VisualInstance3D::set_layer_mask(uint32_t p_mask) {
	layers = p_mask;
	if (context) {
		context->server().instance_set_layer_mask(instance, layers);
		look_changed();
	}
}

// Null where there is no material.
static MaterialRid rid_of(const Ref<Material> &p_material, SceneContext &p_context) {
	return p_material ? p_material->get_rid(p_context) : MaterialRid();
}

void GeometryInstance3D::set_material_override(const Ref<Material> &p_material) {
	const Ref<Material> old = std::exchange(material_override, p_material); // lives until the server has the new one
	if (get_context()) {
		get_context()->server().instance_geometry_set_material_override(get_instance(), rid_of(material_override, *get_context()));
		look_changed();
	}
}

void GeometryInstance3D::set_cast_shadow(ShadowCasting p_setting) {
	cast_shadow = p_setting;
	if (get_context()) {
		get_context()->server().instance_geometry_set_cast_shadows_setting(get_instance(), cast_shadow);
		look_changed();
	}
}

void GeometryInstance3D::set_gi_mode(GiMode p_mode) {
	gi_mode = p_mode;
	if (get_context()) {
		get_context()->server().instance_geometry_set_gi_mode(get_instance(), gi_mode);
		look_changed();
	}
}

void GeometryInstance3D::set_transparency(float p_transparency) {
	transparency = glm::clamp(p_transparency, 0.0f, 1.0f);
	if (get_context()) {
		get_context()->server().instance_geometry_set_transparency(get_instance(), 1.0f - (1.0f - transparency) * (1.0f - faded));
		look_changed();
	}
}

void GeometryInstance3D::_notification(int p_what) {
	VisualInstance3D::_notification(p_what);
	if (p_what == NOTIFICATION_ENTER_WORLD) {
		state_changed();
	} else if (p_what == NOTIFICATION_EXIT_WORLD && listed) {
		get_tree()->visibility_range_left(this);
		listed = false;
	}
}

void GeometryInstance3D::state_changed() {
	const bool has_range = visibility_range.begin > 0.0f || visibility_range.end > 0.0f;
	if (!get_context() || has_range == listed) {
		return;
	}
	listed = has_range;
	if (has_range) {
		get_tree()->visibility_range_entered(this);
	} else {
		get_tree()->visibility_range_left(this);
		in_range = true;
		faded = 0.0f;
		set_transparency(transparency);
		update_visibility();
	}
}

void GeometryInstance3D::update_visibility_range(const Vector3 &p_eye) {
	const VisibilityRange &r = visibility_range;
	const bool fades = r.fade_mode == FadeMode::SELF;
	const float outwards = fades || in_range ? 1.0f : -1.0f; // without a fade a hidden level comes back later than it went
	const AABB box = get_aabb().xform(get_global_transform());
	const float distance = glm::length(p_eye - (box.is_empty() ? get_global_transform().origin : box.center()));
	const bool shown = (r.begin <= 0.0f || distance >= r.begin - outwards * r.begin_margin) && (r.end <= 0.0f || distance <= r.end + outwards * r.end_margin);
	float fade = 0.0f;
	if (fades && shown && r.begin > 0.0f && r.begin_margin > 0.0f) {
		fade = std::max(fade, 1.0f - (distance - r.begin + r.begin_margin) / (2.0f * r.begin_margin));
	}
	if (fades && shown && r.end > 0.0f && r.end_margin > 0.0f) {
		fade = std::max(fade, (distance - r.end + r.end_margin) / (2.0f * r.end_margin));
	}
	fade = glm::clamp(fade, 0.0f, 1.0f);
	if (shown != in_range) {
		in_range = shown;
		update_visibility();
	}
	if (fade != faded) {
		faded = fade;
		set_transparency(transparency);
	}
}

void GeometryInstance3D::send_instance(RenderingServer &p_server) {
	p_server.instance_geometry_set_material_override(get_instance(), rid_of(material_override, *get_context()));
	p_server.instance_geometry_set_cast_shadows_setting(get_instance(), cast_shadow);
	p_server.instance_geometry_set_gi_mode(get_instance(), gi_mode);
	p_server.instance_geometry_set_transparency(get_instance(), 1.0f - (1.0f - transparency) * (1.0f - faded));
}

void MeshInstance3D::send_instance(RenderingServer &p_server) {
	GeometryInstance3D::send_instance(p_server);
	send_mesh(p_server);
}

void MeshInstance3D::send_mesh(RenderingServer &p_server) {
	p_server.instance_set_base(get_instance(), mesh ? mesh->get_rid(*get_context()) : MeshRid());
	for (int i = 0; i < int(override_materials.size()); i++) {
		send_override(p_server, i);
	}
}

void MeshInstance3D::send_override(RenderingServer &p_server, int p_surface) {
	if (mesh && p_surface < mesh->get_surface_count()) {
		p_server.instance_set_surface_override_material(get_instance(), uint32_t(p_surface), rid_of(override_materials[size_t(p_surface)], *get_context()));
	}
}

void MeshInstance3D::set_mesh(const Ref<Mesh> &p_mesh) {
	const Ref<Mesh> old = std::exchange(mesh, p_mesh);
	if (get_context()) {
		send_mesh(get_context()->server());
	}
}

void MeshInstance3D::set_surface_override_material(int p_surface, const Ref<Material> &p_material) {
	// 256: Godot's limit of surfaces a mesh.
	ERR_FAIL_COND_MSG(p_surface < 0 || p_surface >= 256, "surface {}", p_surface);
	if (size_t(p_surface) >= override_materials.size()) {
		override_materials.resize(size_t(p_surface) + 1);
	}
	const Ref<Material> old = std::exchange(override_materials[size_t(p_surface)], p_material);
	if (get_context()) {
		send_override(get_context()->server(), p_surface);
	}
}

Ref<Material> MeshInstance3D::get_surface_override_material(int p_surface) const {
	return p_surface >= 0 && size_t(p_surface) < override_materials.size() ? override_materials[size_t(p_surface)] : nullptr;
}

int MeshInstance3D::get_surface_override_material_count() const {
	return mesh ? mesh->get_surface_count() : int(override_materials.size());
}

Ref<Material> MeshInstance3D::get_active_material(int p_surface) const {
	if (get_material_override()) {
		return get_material_override();
	}
	const Ref<Material> material = get_surface_override_material(p_surface);
	return material || !mesh ? material : mesh->surface_get_material(p_surface);
}

// The N of "surface_material_override/N", or -1.
static int override_surface(const std::string &p_name) {
	static const std::string PREFIX = "surface_material_override/";
	const std::string digits = p_name.starts_with(PREFIX) ? p_name.substr(PREFIX.size()) : "";
	const bool is_number = !digits.empty() && digits.size() <= 3 && digits.find_first_not_of("0123456789") == std::string::npos;
	return is_number ? std::stoi(digits) : -1;
}

bool MeshInstance3D::_set(const std::string &p_name, const Variant &p_value) {
	const int surface = override_surface(p_name);
	const std::optional<Ref<Material>> material = variant_cast<Ref<Material>>(p_value);
	if (surface < 0 || surface >= 256 || !material) {
		return false;
	}
	set_surface_override_material(surface, *material);
	return true;
}

bool MeshInstance3D::_get(const std::string &p_name, Variant &r_value) const {
	const int surface = override_surface(p_name);
	if (surface < 0 || surface >= std::max(get_surface_override_material_count(), int(override_materials.size()))) {
		return false;
	}
	r_value = get_surface_override_material(surface);
	return true;
}

void MeshInstance3D::_get_property_list(std::vector<PropertyInfo> &r_list) const {
	for (int i = 0; i < get_surface_override_material_count(); i++) {
		PropertyInfo property;
		property.name = fmt::format("surface_material_override/{}", i);
		property.type = Variant::Type::OBJECT;
		property.class_name = "Material";
		property.hint = PropertyHint::RESOURCE_TYPE;
		r_list.push_back(std::move(property));
	}
}

void VisualInstance3D::bind(ClassBuilder<VisualInstance3D> &r_class) {
	r_class.doc("Base of all nodes that can be seen or that light others.");
	r_class.property("layers", &VisualInstance3D::set_layer_mask, &VisualInstance3D::get_layer_mask).doc("The layers that it is in, as bits; a camera's cull_mask chooses among them.");
	r_class.method("get_aabb", &VisualInstance3D::get_aabb).doc("The box around it, in its own space.");
}

void GeometryInstance3D::bind(ClassBuilder<GeometryInstance3D> &r_class) {
	r_class.doc("Base of nodes with a surface.");
	r_class.enumeration("ShadowCastingSetting", { { "SHADOW_CASTING_SETTING_OFF", ShadowCasting::OFF }, { "SHADOW_CASTING_SETTING_ON", ShadowCasting::ON }, { "SHADOW_CASTING_SETTING_DOUBLE_SIDED", ShadowCasting::DOUBLE_SIDED }, { "SHADOW_CASTING_SETTING_SHADOWS_ONLY", ShadowCasting::SHADOWS_ONLY } });
	r_class.enumeration("GIMode", { { "GI_MODE_DISABLED", GiMode::DISABLED }, { "GI_MODE_STATIC", GiMode::STATIC }, { "GI_MODE_DYNAMIC", GiMode::DYNAMIC } });
	r_class.property("material_override", &GeometryInstance3D::set_material_override, &GeometryInstance3D::get_material_override).doc("Draws every surface, in place of their own materials.");
	r_class.property("transparency", &GeometryInstance3D::set_transparency, &GeometryInstance3D::get_transparency).range(0, 1, 0.01).enforced().doc("0 is as the material has it, 1 is invisible.");
	r_class.property("cast_shadow", &GeometryInstance3D::set_cast_shadow, &GeometryInstance3D::get_cast_shadow).enum_of("ShadowCastingSetting").doc("What the surface does in shadow maps.");
	constexpr auto V = &GeometryInstance3D::visibility_range;
	r_class.enumeration("VisibilityRangeFadeMode", { { "VISIBILITY_RANGE_FADE_DISABLED", FadeMode::DISABLED }, { "VISIBILITY_RANGE_FADE_SELF", FadeMode::SELF }, { "VISIBILITY_RANGE_FADE_DEPENDENCIES", FadeMode::DEPENDENCIES } });
	r_class.field("visibility_range_begin", V, &VisibilityRange::begin).range(0, 4096, 0.01).or_greater().doc("The nearest that a camera may be for it to show, in metres; 0 is no limit.");
	r_class.field("visibility_range_begin_margin", V, &VisibilityRange::begin_margin).range(0, 4096, 0.01).or_greater().doc("Width of the change at visibility_range_begin, in metres.");
	r_class.field("visibility_range_end", V, &VisibilityRange::end).range(0, 4096, 0.01).or_greater().doc("The farthest that a camera may be for it to show, in metres; 0 is no limit.");
	r_class.field("visibility_range_end_margin", V, &VisibilityRange::end_margin).range(0, 4096, 0.01).or_greater().doc("Width of the change at visibility_range_end, in metres.");
	r_class.field("visibility_range_fade_mode", V, &VisibilityRange::fade_mode).enum_of("VisibilityRangeFadeMode").doc("Whether it fades in and out within the margins; dependencies do not.");
	r_class.property("gi_mode", &GeometryInstance3D::set_gi_mode, &GeometryInstance3D::get_gi_mode).enum_of("GIMode").doc("Static geometry blocks and bounces light; dynamic geometry only receives it.");
}

void MeshInstance3D::bind(ClassBuilder<MeshInstance3D> &r_class) {
	r_class.doc("Shows a mesh.");
	r_class.property("mesh", &MeshInstance3D::set_mesh, &MeshInstance3D::get_mesh).doc("The mesh; many nodes may share one.");
	r_class.method("get_surface_override_material_count", &MeshInstance3D::get_surface_override_material_count).doc("How many surfaces can have a material of their own here.");
	r_class.method("get_surface_override_material", &MeshInstance3D::get_surface_override_material, { "surface" }).doc("This node's own material of a surface, or null.");
	r_class.method("set_surface_override_material", &MeshInstance3D::set_surface_override_material, { "surface", "material" }).doc("Gives a surface a material for this node alone.");
	r_class.method("get_active_material", &MeshInstance3D::get_active_material, { "surface" }).doc("The material that draws a surface, or null.");
}

} // namespace lucent::scene
