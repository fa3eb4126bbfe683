// SPDX-License-Identifier: MIT
#pragma once

#include "modules/scene/mesh.h"
#include "modules/scene/node_3d.h"

namespace lucent::scene {

// A node that the server has an instance of, from entering the tree to leaving it.
class VisualInstance3D : public Node3D {
	LUCENT_CLASS(VisualInstance3D, Node3D)
public:
	VisualInstance3D() { set_notify_transform(true); }

	void set_layer_mask(uint32_t p_mask);
	uint32_t get_layer_mask() const { return layers; }
	InstanceRid get_instance() const { return instance; } // invalid outside of a tree with a server
	virtual AABB get_aabb() const { return {}; } // local; empty: nothing to see

protected:
	void _notification(int p_what) override;
	// Null outside of a tree with a server.
	SceneContext *get_context() const { return context; }
	// Tells the server all about the new instance but its place, layers and visibility.
	virtual void send_instance(RenderingServer &) {}
	virtual void free_base(RenderingServer &) {}
	// Layers, material, shadows, GI or transparency changed, in a tree with a server; for classes with more than one instance.
	virtual void look_changed() {}
	virtual bool is_shown() const { return is_visible_in_tree(); }
	void update_visibility();

private:
	uint32_t layers = 1;
	SceneContext *context = nullptr;
	InstanceRid instance;
};

// What has a surface.
class GeometryInstance3D : public VisualInstance3D {
	LUCENT_CLASS(GeometryInstance3D, VisualInstance3D)
public:
	void set_material_override(const Ref<Material> &p_material);
	Ref<Material> get_material_override() const { return material_override; }
	void set_cast_shadow(ShadowCasting p_setting);
	ShadowCasting get_cast_shadow() const { return cast_shadow; }
	void set_gi_mode(GiMode p_mode);
	GiMode get_gi_mode() const { return gi_mode; }
	void set_transparency(float p_transparency);
	float get_transparency() const { return transparency; }

	enum class FadeMode : uint8_t {
		DISABLED,
		SELF,
		DEPENDENCIES
	};
	// Distances between the camera and the middle of the box around the mesh at which it shows, in metres; 0: no limit. With a fade
	// the margin is where it comes and goes, without it is how far the camera must go back for the level to change back.
	struct VisibilityRange {
		float begin = 0.0f;
		float begin_margin = 0.0f;
		float end = 0.0f;
		float end_margin = 0.0f;
		FadeMode fade_mode = FadeMode::DISABLED;
	};
	VisibilityRange visibility_range; // after an edit: state_changed()
	void state_changed();
	// Shows, hides or fades it for a camera there. The tree calls it in flush().
	void update_visibility_range(const Vector3 &p_eye);

protected:
	void _notification(int p_what) override;
	bool is_shown() const override { return in_range && VisualInstance3D::is_shown(); }
	void send_instance(RenderingServer &p_server) override;

private:
	Ref<Material> material_override;
	ShadowCasting cast_shadow = ShadowCasting::ON;
	GiMode gi_mode = GiMode::STATIC;
	float transparency = 0.0f;
	float faded = 0.0f; // what the range adds to transparency
	bool in_range = true;
	bool listed = false; // in the tree's list
};

class MeshInstance3D : public GeometryInstance3D {
	LUCENT_CLASS(MeshInstance3D, GeometryInstance3D)
public:
	void set_mesh(const Ref<Mesh> &p_mesh);
	Ref<Mesh> get_mesh() const { return mesh; }
	// Instead of the mesh's own; null: the mesh's own. May be set before the mesh is.
	void set_surface_override_material(int p_surface, const Ref<Material> &p_material);
	Ref<Material> get_surface_override_material(int p_surface) const;
	int get_surface_override_material_count() const;
	// The material that draws the surface: material_override, the surface's override, the mesh's own, or null.
	Ref<Material> get_active_material(int p_surface) const;
	AABB get_aabb() const override { return mesh ? mesh->get_aabb() : AABB(); }

	// surface_material_override/N
	bool _set(const std::string &p_name, const Variant &p_value) override;
	bool _get(const std::string &p_name, Variant &r_value) const override;
	void _get_property_list(std::vector<PropertyInfo> &r_list) const override;

protected:
	void send_instance(RenderingServer &p_server) override;

private:
	void send_mesh(RenderingServer &p_server);
	void send_override(RenderingServer &p_server, int p_surface);

	Ref<Mesh> mesh;
	std::vector<Ref<Material>> override_materials;
};

} // namespace lucent::scene
