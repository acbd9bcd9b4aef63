// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "idl/cpp_names.hpp"
#include "idl/internal/cpp_lines.hpp"
#include "idl/model.hpp"

namespace armature::idl::internal {

/// Pieces of C++ that several of the generated files need.
class CppText {
 public:
  CppText(const Program& program, const CppNames& names);

  const Program& program() const { return program_; }
  const CppNames& names() const { return names_; }
  const Module& main() const { return program_.main(); }

  /// `std::vector<double>`; `geometry::Pose` of a struct in another namespace.
  std::string type(const Type& type) const;
  /// On its own and not in a struct: there an Array<bool> has a class with its wire form.
  std::string variable_type(const Type& type) const;
  std::string result_type(const Operation& operation) const {
    return variable_type(operation.result);
  }
  /// As a parameter: `double`, `const std::vector<double>&`.
  std::string parameter_type(const Type& type) const;
  /// Types and names, and the names alone.
  Items parameters(const Operation& operation) const;
  Items parameter_names(const Operation& operation) const;

  std::string event_type(const std::string& event) const;
  /// An operation's, and that of its parameters.
  std::string documentation(const Operation& operation) const;

  /// True if a value of it may be outside of a range that is declared in it.
  bool has_range(const Structure& structure) const { return with_range_.contains(&structure); }
  bool has_range(const Type& type) const;

  /// The arguments of `within` after the value: `-1.0, 1.0`.
  Items bounds(const Range& range, Basic type) const;
  /// The integer as which an enum is stored: `std::uint8_t`.
  static std::string underlying(const Enumeration& enumeration);
  /// The value of an enumerator, as a literal.
  static std::string value(const Enumerator& enumerator);

  /// What stands behind a variable's name so that it has a value: ` = 0`, or nothing.
  std::string initial(const Type& type) const;
  /// `0 to 255`
  static std::string range_text(const Range& range);
  /// Documentation of a member or parameter, with unit and range behind it.
  static std::vector<std::string> described(const Field& field);

  /// What client and service need for an Array<bool> that is a parameter or result.
  std::string include_flags() const;
  /// Of `// Generated ...`, up to and with the include guard of a header.
  std::string head(bool header) const;
  std::string begin_name_space() const;
  std::string end_name_space() const;

 private:
  std::string single(const Type& type) const;
  /// A struct, event or enum of a module.
  std::string qualified(const std::string& name, const std::string& module) const;
  std::string bound(const std::string& text, Basic type) const;

  const Program& program_;
  const CppNames& names_;
  std::set<const Structure*> with_range_;
};

bool is_flags(const Type& type);  ///< Array<bool>, which C++ has as bytes

std::string write_types(const CppText& text);
std::string write_client_header(const CppText& text);
std::string write_client_source(const CppText& text);
std::string write_service_header(const CppText& text);
std::string write_service_source(const CppText& text);

}  // namespace armature::idl::internal
