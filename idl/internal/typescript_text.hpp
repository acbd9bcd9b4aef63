// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "idl/internal/cpp_lines.hpp"
#include "idl/model.hpp"
#include "idl/typescript_names.hpp"

namespace armature::idl::internal {

/// Pieces of TypeScript that types and placeholders need.
class TypescriptText {
 public:
  /// @param elsewhere  of a file beside that of the types, which imports them
  explicit TypescriptText(const Program& program, bool elsewhere = false)
      : program_(program), names_(program), elsewhere_(elsewhere) {}

  const Program& program() const { return program_; }
  const TypescriptNames& names() const { return names_; }

  /// As a value has it: `number[]`, `geometry.Pose`.
  std::string type(const Type& type) const;
  /// How such values go to the wire: `ride.array(ride.within(ride.int, 0, 9))`.
  std::string description(const Type& type) const { return description(type, nullptr); }
  std::string description(const Field& field) const;
  /// `ride.byte`, as the number of an enum is sent.
  std::string underlying(const Enumeration& enumeration) const;
  /// `7`, or `7n` of a type with 64 bits.
  static std::string number(const Whole& value, Basic type);
  /// A struct, event or enum, of another module behind the module's name.
  std::string qualified(const std::string& name, const std::string& module) const;

  /// `/** ... */`, if there is something to say.
  static std::string documentation(std::size_t indent, const std::vector<std::string>& lines);

 private:
  std::string single(const Type& type) const;
  std::string module_of(const Type& type) const;
  std::string description(const Type& type, const Range* range) const;
  std::string bounds(const Range& range, Basic type) const;

  const Program& program_;
  const TypescriptNames names_;
  const bool elsewhere_;
};

/// What there is to say of an operation and its parameters.
std::vector<std::string> documentation_of(const Operation& operation,
                                          const std::vector<std::string>& names);

/// The interfaces' classes.
std::string write_typescript_placeholders(const TypescriptText& text);
/// The interfaces' frames for those who implement them.
std::string write_typescript_services(const TypescriptText& text);

}  // namespace armature::idl::internal
