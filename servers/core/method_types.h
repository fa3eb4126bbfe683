// SPDX-License-Identifier: MIT
#pragma once
// How the C++ types of a method's signature travel through Variants. Part of class_builder.h.
//
// As arguments: what variant_cast reads, and std::unique_ptr<T> for an object that changes hands (only from ScriptOwned).
// As results: those; vectors of pointers, sets of strings; std::unique_ptr<T>, which ScriptOwned gets; Result<T> and Status, whose error
// the caller gets.

#include "servers/core/class_db.h"
#include "servers/core/script_instance.h"

#include <memory>
#include <set>
#include <tuple>

namespace lucent {

template <typename T>
struct UniqueTarget {
	using Type = void;
};
template <typename T>
struct UniqueTarget<std::unique_ptr<T>> {
	using Type = T;
};
template <typename T>
constexpr bool is_unique_v = !std::is_void_v<typename UniqueTarget<T>::Type>;

// The object of a std::vector<T *>.
template <typename T>
struct ObjectListTarget {
	using Type = void;
};
template <typename T>
struct ObjectListTarget<std::vector<T *>> {
	using Type = T;
};

template <typename T>
struct ResultTarget {
	using Type = void;
};
template <typename T>
struct ResultTarget<Result<T>> {
	using Type = T;
};

// Type and class of a value, argument or result.
template <typename Value>
ArgumentInfo type_info(const std::string &p_name) {
	if constexpr (!std::is_void_v<typename ResultTarget<Value>::Type>) {
		return type_info<typename ResultTarget<Value>::Type>(p_name);
	} else if constexpr (std::is_same_v<Value, Ok> || std::is_void_v<Value>) {
		return { p_name, Variant::Type::NIL, "" };
	} else if constexpr (std::is_same_v<Value, Variant>) {
		return { p_name, Variant::Type::NIL, "Variant" };
	} else if constexpr (std::is_same_v<Value, const char *>) {
		return { p_name, Variant::Type::STRING, "" };
	} else if constexpr (is_ref_v<Value>) {
		return { p_name, Variant::Type::OBJECT, RefTarget<Value>::Type::get_class_static() };
	} else if constexpr (is_unique_v<Value>) {
		return { p_name, Variant::Type::OBJECT, UniqueTarget<Value>::Type::get_class_static() };
	} else if constexpr (is_object_pointer_v<Value>) {
		return { p_name, Variant::Type::OBJECT, std::remove_cv_t<std::remove_pointer_t<Value>>::get_class_static() };
	} else if constexpr (!std::is_void_v<typename ObjectListTarget<Value>::Type>) {
		return { p_name, Variant::Type::ARRAY, std::string(ObjectListTarget<Value>::Type::get_class_static()) + "[]" };
	} else if constexpr (std::is_same_v<Value, std::set<std::string>>) {
		return { p_name, Variant::Type::ARRAY, "String[]" };
	} else {
		return { p_name, variant_type_of<Value>(), "" };
	}
}

// How an argument waits for its call: what changes hands is taken only once all others are good.
template <typename T>
struct ArgumentReader {
	using Stored = std::optional<T>;
	static Stored read(const Variant &p_value) { return variant_cast<T>(p_value); }
	static T &&pass(Stored &r_stored) { return std::move(*r_stored); }
};
template <typename T>
struct ArgumentReader<std::unique_ptr<T>> {
	using Stored = std::optional<T *>;
	static Stored read(const Variant &p_value) {
		Stored object = variant_cast<T *>(p_value);
		return object && *object && ScriptOwned::contains((*object)->get_instance_id()) ? object : std::nullopt;
	}
	static std::unique_ptr<T> pass(Stored &r_stored) {
		return std::unique_ptr<T>(static_cast<T *>(ScriptOwned::take((*r_stored)->get_instance_id()).release()));
	}
};

template <typename R>
Result<Variant> result_to_variant(R p_result) {
	if constexpr (std::is_same_v<R, Ok>) {
		return Variant();
	} else if constexpr (!std::is_void_v<typename ResultTarget<R>::Type>) {
		return p_result ? result_to_variant(p_result.take()) : Result<Variant>(p_result.error());
	} else if constexpr (is_unique_v<R>) {
		const Variant variant(static_cast<Object *>(p_result.get()));
		ScriptOwned::adopt(std::move(p_result));
		return variant;
	} else if constexpr (is_object_pointer_v<R> && !std::is_same_v<R, const char *>) {
		return Variant(const_cast<std::remove_cv_t<std::remove_pointer_t<R>> *>(p_result));
	} else if constexpr (!std::is_void_v<typename ObjectListTarget<R>::Type> || std::is_same_v<R, std::set<std::string>>) {
		Array array;
		for (const auto &entry : p_result) {
			array.emplace_back(entry);
		}
		return Variant(std::move(array));
	} else {
		return Variant(std::move(p_result));
	}
}

// "Node3D.look_at(): argument 1 (target): expected Vector3, got String"
Error argument_error(const std::string &p_method, size_t p_index, const ArgumentInfo &p_argument, const Variant &p_value);

// p_method(T &, Arguments...) with what p_arguments hold, which are as many.
template <typename T, typename R, typename... Arguments, typename Method>
Result<Variant> call_checked(const Method &p_method, const std::string &p_name, const std::vector<ArgumentInfo> &p_infos, Object *r_object, const Array &p_arguments) {
	return [&]<size_t... I>(std::index_sequence<I...>)->Result<Variant> {
		std::tuple<typename ArgumentReader<Arguments>::Stored...> values = { ArgumentReader<Arguments>::read(p_arguments[I])... };
		size_t wrong = sizeof...(Arguments);
		((wrong == sizeof...(Arguments) && !std::get<I>(values) ? wrong = I : 0), ...);
		if (wrong != sizeof...(Arguments)) {
			return argument_error(p_name, wrong, p_infos[wrong], p_arguments[wrong]);
		}
		T &self = static_cast<T &>(*r_object);
		if constexpr (std::is_void_v<R>) {
			p_method(self, ArgumentReader<Arguments>::pass(std::get<I>(values))...);
			return Variant();
		} else {
			return result_to_variant<std::decay_t<R>>(p_method(self, ArgumentReader<Arguments>::pass(std::get<I>(values))...));
		}
	}
	(std::index_sequence_for<Arguments...>());
}

} // namespace lucent
