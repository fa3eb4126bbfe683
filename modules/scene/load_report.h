// SPDX-License-Identifier: MIT
#pragma once
// What is said about a scene while it loads. One line a kind, with the first place and a count, when the outermost Scope ends;
// without a Scope at once. One calling thread.

#include "modules/scene/left_out.h"
#include "servers/core/log.h"
#include "servers/core/object.h"

#include <string>

namespace lucent::scene {

class LoadReport {
public:
	struct Scope {
		Scope();
		~Scope();
		Scope(const Scope &) = delete;
		Scope &operator=(const Scope &) = delete;
	};

	// p_place: "level.tscn:12". A node or resource of a class that isn't here. Those without effect on a picture: said only when verbose.
	static void left_out_class(const std::string &p_place, const std::string &p_class);
	static void left_out_property(const std::string &p_place, const Object &p_object, const std::string &p_property);
	// A script was to be on p_object, so that properties which are not its class's are the script's: said only when verbose.
	static void left_out_script(const Object &p_object);
	// One line for each p_key, with a count from the second on. Answers whether this was the first.
	static bool warning(const std::string &p_key, const std::string &p_message);
	// As warning, but said only when verbose.
	static void note(const std::string &p_key, const std::string &p_message);
	// A part that can't be read: said at once, a line each, and counted for --strict.
	static void error(const std::string &p_message);
	static int error_count(); // since the start of the program
};

} // namespace lucent::scene
