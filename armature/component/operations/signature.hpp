// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "armature/types/type.hpp"

namespace armature::component {

/// What an operation or event takes and gives, for checks and tools.
struct Signature {
  /// One argument.
  struct Argument {
    std::string_view name;  ///< with the unit in brackets: `position [rad]`; may be empty
    const types::Type* type;
    /// `const T&`. Who calls and who serves take it alike: they are compiled apart.
    bool by_reference = false;
  };
  const types::Type* result = nullptr;  ///< nullptr: nothing
  std::vector<Argument> arguments;

  template <typename R, typename... Args>
  requires(!std::is_reference_v<R>) static Signature
      of(std::initializer_list<std::string_view> names) {
    Signature signature;
    if constexpr (!std::is_void_v<R>) signature.result = &types::type_of<std::decay_t<R>>();
    signature.arguments = {
        Argument{{}, &types::type_of<std::decay_t<Args>>(), std::is_reference_v<Args>}...};
    auto argument = signature.arguments.begin();
    for (const std::string_view name : names) {
      if (argument == signature.arguments.end()) break;
      (argument++)->name = name;
    }
    return signature;
  }

  /// Same result and arguments, taken in the same way; names do not count.
  bool same_as(const Signature& other) const;
  /// `double(double position [rad], const vector<double>&)`.
  std::string text() const;
};

/// Names the member function that serves an operation, a command or an event.
template <auto Function>
struct Serve {};
template <auto Function>
inline constexpr Serve<Function> serve{};

/// A function that is no member function, of any signature, and what it is given as `self`.
struct FreeFunction {
  void (*function)() = nullptr;
  void* self = nullptr;

  template <typename Function>
  static FreeFunction of(Function function, void* self) {
    return {reinterpret_cast<void (*)()>(function), self};
  }
  template <typename Function>
  Function as() const {
    return reinterpret_cast<Function>(function);
  }
};

namespace internal {

template <typename Member>
struct MemberOf {
  static_assert(!sizeof(Member), "name a member function of the component, as in &Pid::step");
};
template <typename Class, typename R, typename... Args>
struct MemberOf<R (Class::*)(Args...)> {
  using Owner = Class;
};
template <typename Class, typename R, typename... Args>
struct MemberOf<R (Class::*)(Args...) const> {
  using Owner = Class;
};
template <typename Class, typename R, typename... Args>
struct MemberOf<R (Class::*)(Args...) noexcept> {
  using Owner = Class;
};
template <typename Class, typename R, typename... Args>
struct MemberOf<R (Class::*)(Args...) const noexcept> {
  using Owner = Class;
};
template <auto Function>
using OwnerOf = typename MemberOf<decltype(Function)>::Owner;

}  // namespace internal
}  // namespace armature::component
