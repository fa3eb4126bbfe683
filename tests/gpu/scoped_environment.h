// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <string>

namespace lucent::test {

// Sets an environment variable for as long as it lives.
class ScopedEnvironment {
public:
	ScopedEnvironment(const char *p_name, const std::string &p_value) :
			name(p_name) {
		const char *old = std::getenv(p_name);
		had_value = old != nullptr;
		old_value = had_value ? old : "";
		setenv(p_name, p_value.c_str(), 1);
	}
	~ScopedEnvironment() { had_value ? setenv(name, old_value.c_str(), 1) : unsetenv(name); }
	ScopedEnvironment(const ScopedEnvironment &) = delete;
	ScopedEnvironment &operator=(const ScopedEnvironment &) = delete;

private:
	const char *name;
	bool had_value = false;
	std::string old_value;
};

} // namespace lucent::test
