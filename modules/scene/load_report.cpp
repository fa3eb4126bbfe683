// SPDX-License-Identifier: MIT
#include "modules/scene/load_report.h"

#include <algorithm>
#include <map>
#include <unordered_set>
#include <vector>

namespace lucent::scene {

namespace {

struct Entry {
	std::string place;
	std::string subject; // a class or a message
	LeftOutEffect effect = LeftOutEffect::LOOK;
	const LeftOutKind *kind = nullptr;
	bool is_class = false;
	int count = 0;
	std::vector<std::string> properties;
};

struct State {
	int depth = 0;
	int errors = 0;
	std::vector<Entry> entries; // by first mention
	std::map<std::string, size_t> index;
	std::unordered_set<uint64_t> scripted; // objects that lose a script
};

State &state() {
	static State value;
	return value;
}

std::string describe(const Entry &p_entry) {
	if (p_entry.is_class) {
		const std::string reason = p_entry.kind != nullptr ? fmt::format(" ({})", p_entry.kind->what) : "";
		const char *what = p_entry.effect == LeftOutEffect::GEOMETRY ? "MISSING GEOMETRY: " : "";
		return fmt::format("{}: {}class {} is not supported{}: {} left out", p_entry.place, what, p_entry.subject, reason, p_entry.count);
	}
	if (!p_entry.properties.empty()) {
		std::string names;
		for (const std::string &property : p_entry.properties) {
			names += fmt::format("{}'{}'", names.empty() ? "" : ", ", property);
		}
		const std::string count = p_entry.count > int(p_entry.properties.size()) ? fmt::format(" ({} times)", p_entry.count) : "";
		return fmt::format("{}: {} has no property {}; skipped{}", p_entry.place, p_entry.subject, names, count);
	}
	return p_entry.subject + (p_entry.count > 1 ? fmt::format(" ({} times)", p_entry.count) : "");
}

// Lost geometry last, where it is seen.
void say_all() {
	State &now = state();
	std::vector<Entry> entries = std::move(now.entries);
	now.entries.clear();
	now.index.clear();
	now.scripted.clear();
	std::stable_sort(entries.begin(), entries.end(), [](const Entry &p_a, const Entry &p_b) { return p_a.effect < p_b.effect; });
	for (const Entry &entry : entries) {
		log_message(entry.effect == LeftOutEffect::NONE ? LogLevel::INFO : LogLevel::WARNING, describe(entry));
	}
}

Entry &mention(const std::string &p_key, Entry p_entry) {
	State &now = state();
	const auto [found, is_new] = now.index.emplace(p_key, now.entries.size());
	if (is_new) {
		now.entries.push_back(std::move(p_entry));
	}
	Entry &entry = now.entries[found->second];
	entry.count++;
	return entry;
}

void finish() {
	if (state().depth == 0) {
		say_all();
	}
}

} // namespace

LoadReport::Scope::Scope() {
	state().depth++;
}

LoadReport::Scope::~Scope() {
	state().depth--;
	finish();
}

void LoadReport::left_out_class(const std::string &p_place, const std::string &p_class) {
	const LeftOutKind *kind = find_left_out(p_class);
	mention("class " + p_class, { p_place, p_class, kind != nullptr ? kind->effect : LeftOutEffect::LOOK, kind, true, 0, {} });
	finish();
}

void LoadReport::left_out_script(const Object &p_object) {
	if (state().depth > 0) {
		state().scripted.insert(p_object.get_instance_id().value);
	}
}

void LoadReport::left_out_property(const std::string &p_place, const Object &p_object, const std::string &p_property) {
	const std::string name = p_object.get_class();
	const bool is_silent = state().scripted.contains(p_object.get_instance_id().value) || is_property_without_effect(name, p_property);
	const LeftOutEffect effect = is_silent ? LeftOutEffect::NONE : LeftOutEffect::LOOK;
	Entry &entry = mention(fmt::format("property {} {}", int(effect), name), { p_place, name, effect, nullptr, false, 0, {} });
	if (std::find(entry.properties.begin(), entry.properties.end(), p_property) == entry.properties.end()) {
		entry.properties.push_back(p_property);
	}
	finish();
}

bool LoadReport::warning(const std::string &p_key, const std::string &p_message) {
	const bool is_first = mention("warning " + p_key, { "", p_message, LeftOutEffect::LOOK, nullptr, false, 0, {} }).count == 1;
	finish();
	return is_first;
}

void LoadReport::note(const std::string &p_key, const std::string &p_message) {
	mention("note " + p_key, { "", p_message, LeftOutEffect::NONE, nullptr, false, 0, {} });
	finish();
}

void LoadReport::error(const std::string &p_message) {
	state().errors++;
	log_error("{}", p_message);
}

int LoadReport::error_count() {
	return state().errors;
}

} // namespace lucent::scene
