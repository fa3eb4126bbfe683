// SPDX-License-Identifier: MIT
#include "modules/scene/class_documentation.h"

#include "servers/core/class_db.h"
#include "servers/core/file_io.h"

#include <filesystem>

namespace lucent::scene {

namespace {

std::string escape(const std::string &p_text) {
	std::string escaped;
	for (const char c : p_text) {
		switch (c) {
			case '&':
				escaped += "&amp;";
				break;
			case '<':
				escaped += "&lt;";
				break;
			case '>':
				escaped += "&gt;";
				break;
			case '"':
				escaped += "&quot;";
				break;
			default:
				escaped += c;
		}
	}
	return escaped;
}

// type="int" enum="Environment.BGMode"
std::string type_attributes(Variant::Type p_type, const std::string &p_class, const char *p_nil) {
	if (p_type == Variant::Type::NIL) {
		return fmt::format("type=\"{}\"", p_class.empty() ? p_nil : p_class);
	}
	if (p_type == Variant::Type::OBJECT || (p_type == Variant::Type::ARRAY && !p_class.empty())) {
		return fmt::format("type=\"{}\"", p_class);
	}
	std::string text = fmt::format("type=\"{}\"", Variant::get_type_name(p_type));
	if (!p_class.empty()) {
		text += fmt::format(" enum=\"{}\"", p_class);
	}
	return text;
}

void write_description(std::string &r_xml, const char *p_indent, const std::string &p_text) {
	r_xml += fmt::format("{0}<description>\n{0}\t{1}\n{0}</description>\n", p_indent, escape(p_text));
}

// p_defaults: of the last ones.
void write_arguments(std::string &r_xml, const std::vector<ArgumentInfo> &p_arguments, const std::vector<Variant> &p_defaults = {}) {
	const size_t first_default = p_arguments.size() - p_defaults.size();
	for (size_t i = 0; i < p_arguments.size(); i++) {
		const std::string value = i < first_default ? "" : fmt::format(" default=\"{}\"", escape(p_defaults[i - first_default].to_string()));
		r_xml += fmt::format("\t\t\t<param index=\"{}\" name=\"{}\" {}{} />\n", i, p_arguments[i].name, type_attributes(p_arguments[i].type, p_arguments[i].class_name, "Variant"), value);
	}
}

void write_methods(std::string &r_xml, const ClassInfo &p_info) {
	std::string body;
	for (const MethodInfo &method : p_info.methods) {
		if (method.is_accessor) {
			continue; // named by the member
		}
		std::string qualifiers;
		for (const auto &[has, name] : { std::pair(method.is_virtual, "virtual"), std::pair(method.is_vararg, "vararg"), std::pair(method.is_static, "static"), std::pair(method.is_const, "const") }) {
			qualifiers += has ? (qualifiers.empty() ? name : std::string(" ") + name) : "";
		}
		body += fmt::format("\t\t<method name=\"{}\"{}>\n", method.name, qualifiers.empty() ? "" : fmt::format(" qualifiers=\"{}\"", qualifiers));
		body += fmt::format("\t\t\t<return {} />\n", type_attributes(method.result.type, method.result.class_name, "void"));
		write_arguments(body, method.arguments, method.default_arguments);
		write_description(body, "\t\t\t", method.documentation);
		body += "\t\t</method>\n";
	}
	if (!body.empty()) {
		r_xml += "\t<methods>\n" + body + "\t</methods>\n";
	}
}

// The class's own properties, and inherited ones that have another default here.
void write_members(std::string &r_xml, const ClassInfo &p_info) {
	std::string body;
	for (const PropertyInfo *property : ClassDB::get_property_list(p_info.name)) {
		const bool own = p_info.property_index.contains(property->name);
		const Variant value = ClassDB::get_property_default(p_info.name, property->name);
		if (!own && value == ClassDB::get_property_default(p_info.parent, property->name)) {
			continue;
		}
		body += fmt::format("\t\t<member name=\"{}\" {} setter=\"{}\" getter=\"{}\"", property->name, type_attributes(property->type, property->class_name, "Variant"), property->setter, property->getter);
		if (!own) {
			std::string owner = p_info.parent;
			while (!ClassDB::get_class_info(owner)->property_index.contains(property->name)) {
				owner = ClassDB::get_class_info(owner)->parent;
			}
			body += fmt::format(" overrides=\"{}\"", owner);
		}
		if ((property->usage & PROPERTY_USAGE_STORAGE) && !value.is_null()) {
			body += fmt::format(" default=\"{}\"", escape(value.to_string()));
		}
		body += own ? fmt::format(">\n\t\t\t{}\n\t\t</member>\n", escape(property->documentation)) : " />\n";
	}
	if (!body.empty()) {
		r_xml += "\t<members>\n" + body + "\t</members>\n";
	}
}

void write_signals(std::string &r_xml, const ClassInfo &p_info) {
	if (p_info.signals.empty()) {
		return;
	}
	r_xml += "\t<signals>\n";
	for (const SignalInfo &signal : p_info.signals) {
		r_xml += fmt::format("\t\t<signal name=\"{}\">\n", signal.name);
		write_arguments(r_xml, signal.arguments);
		write_description(r_xml, "\t\t\t", signal.documentation);
		r_xml += "\t\t</signal>\n";
	}
	r_xml += "\t</signals>\n";
}

void write_constants(std::string &r_xml, const ClassInfo &p_info) {
	if (p_info.constants.empty()) {
		return;
	}
	r_xml += "\t<constants>\n";
	for (const ConstantInfo &constant : p_info.constants) {
		const std::string enum_name = constant.enum_name.empty() ? "" : fmt::format(" enum=\"{}\"", constant.enum_name);
		r_xml += fmt::format("\t\t<constant name=\"{}\" value=\"{}\"{}>\n\t\t\t{}\n\t\t</constant>\n", constant.name, constant.value, enum_name, escape(constant.documentation));
	}
	r_xml += "\t</constants>\n";
}

} // namespace

std::string class_xml(const std::string &p_class) {
	const ClassInfo *info = ClassDB::get_class_info(p_class);
	if (!info) {
		return "";
	}
	std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n";
	xml += fmt::format("<class name=\"{}\"", info->name);
	xml += info->parent.empty() ? ">\n" : fmt::format(" inherits=\"{}\">\n", info->parent);
	xml += fmt::format("\t<brief_description>\n\t\t{}\n\t</brief_description>\n", escape(info->documentation));
	write_methods(xml, *info);
	write_members(xml, *info);
	write_signals(xml, *info);
	write_constants(xml, *info);
	return xml + "</class>\n";
}

Status write_class_xml(const std::string &p_directory) {
	std::error_code error;
	std::filesystem::create_directories(p_directory, error);
	if (error) {
		return make_error("{}: cannot make the folder: {}", p_directory, error.message());
	}
	for (const std::string &name : ClassDB::get_class_list()) {
		const std::string path = (std::filesystem::path(p_directory) / (name + ".xml")).string();
		const std::string xml = class_xml(name);
		if (const Status status = write_file(path, std::as_bytes(std::span(xml))); !status) {
			return status.error();
		}
	}
	return Ok();
}

} // namespace lucent::scene
