// SPDX-License-Identifier: MIT
// Turns between threads, errors on their way out, messages on their way to logging.
#include "modules/python/py_object.h"
#include "servers/core/caller_error.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>

namespace lucent::python {

PyObject *error_type, *load_error, *device_error, *freed_error, *node_not_found_error;

namespace {

// Under the GIL.
unsigned long owner = 0;
int depth = 0;
std::optional<ScriptCallScope> scope; // of the outermost call
PyObject *kept_type, *kept_value, *kept_traceback;
bool forked = false;
std::vector<PyObject *> releases;

// Messages come from threads without the GIL too.
std::mutex mutex;
std::condition_variable turn_ended;
std::string caller_error;
std::vector<std::pair<LogLevel, std::string>> messages;

void wait_for_turn(unsigned long p_self) {
	while (depth > 0 && owner != p_self) {
		Py_BEGIN_ALLOW_THREADS std::unique_lock<std::mutex> lock(mutex);
		// By time too: depth is the GIL's, so an end between the check and the wait goes unheard.
		turn_ended.wait_for(lock, std::chrono::milliseconds(1));
		Py_END_ALLOW_THREADS
	}
}

void send_messages() {
	std::vector<std::pair<LogLevel, std::string>> pending;
	{
		const std::lock_guard<std::mutex> lock(mutex);
		if (messages.empty()) {
			return;
		}
		pending.swap(messages);
	}
	PyObject *type, *value, *traceback;
	PyErr_Fetch(&type, &value, &traceback);
	PyObject *logging = PyImport_ImportModule("logging");
	PyObject *logger = logging ? PyObject_CallMethod(logging, "getLogger", "s", "lucent") : nullptr;
	for (const auto &[level, text] : pending) {
		PyObject *result = logger ? PyObject_CallMethod(logger,
											level == LogLevel::ERROR             ? "error"
													: level == LogLevel::WARNING ? "warning"
																				 : "info",
											"s#", text.data(), Py_ssize_t(text.size()))
								  : nullptr;
		Py_XDECREF(result);
	}
	Py_XDECREF(logger);
	Py_XDECREF(logging);
	if (PyErr_Occurred()) {
		PyErr_WriteUnraisable(nullptr);
	}
	PyErr_Restore(type, value, traceback);
}

} // namespace

Entry::Entry() {
	if (forked) {
		PyErr_SetString(
				device_error, "lucent can't go on in a forked process: use multiprocessing.get_context('spawn')");
		return;
	}
	const unsigned long self = PyThread_get_thread_ident();
	if (depth > 0 && owner != self) {
		wait_for_turn(self);
	}
	owner = self;
	outermost = depth++ == 0;
	if (outermost) {
		scope.emplace();
	}
	entered = true;
}

Entry::~Entry() {
	if (!entered) {
		return;
	}
	if (outermost) {
		PyObject *type, *value, *traceback;
		PyErr_Fetch(&type, &value, &traceback);
		while (!releases.empty()) {
			PyObject *object = releases.back();
			releases.pop_back();
			Py_DECREF(object);
		}
		scope.reset();
		if (kept_type) { // of a callback that nobody waited for: an object's end
			PyErr_Restore(std::exchange(kept_type, nullptr), std::exchange(kept_value, nullptr),
					std::exchange(kept_traceback, nullptr));
			PyErr_WriteUnraisable(nullptr);
		}
		PyErr_Restore(type, value, traceback);
		send_messages();
	}
	if (--depth == 0) {
		turn_ended.notify_one();
	}
}

bool Entry::finish() {
	if (outermost && kept_type) {
		PyErr_Restore(std::exchange(kept_type, nullptr), std::exchange(kept_value, nullptr),
				std::exchange(kept_traceback, nullptr));
		return false;
	}
	const std::lock_guard<std::mutex> lock(mutex);
	if (!caller_error.empty()) {
		PyErr_SetString(error_type, std::exchange(caller_error, "").c_str());
		return false;
	}
	return true;
}

void release_later(PyObject *p_object) {
	releases.push_back(p_object);
}

void note_fork() {
	forked = true;
}

void keep_exception() {
	if (kept_type) {
		PyErr_Clear();
	} else {
		PyErr_Fetch(&kept_type, &kept_value, &kept_traceback);
	}
}

bool has_kept_exception() {
	return kept_type != nullptr;
}

void take_messages() {
	set_caller_error_handler([](const std::string &p_message) {
		const std::lock_guard<std::mutex> lock(mutex);
		if (depth == 0) {
			return false;
		}
		caller_error = caller_error.empty() ? p_message : caller_error;
		return true;
	});
	set_log_handler([](LogLevel p_level, std::string_view p_message) {
		const std::lock_guard<std::mutex> lock(mutex);
		messages.emplace_back(p_level, std::string(p_message));
	});
}

} // namespace lucent::python
