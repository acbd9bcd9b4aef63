// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "armature/base/result.hpp"
#include "armature/types/type.hpp"
#include "idl/model.hpp"

namespace armature::remote::internal {

/// The longest text in an event, a command or a struct: there it has a place of fixed size.
inline constexpr std::size_t kLongestText = 127;

/// What the types of an interface file are here (docs/remote.md, "By an interface file"). Errors
/// say why values of a type cannot be here.
class IdlTypes {
 public:
  /// @param program  loaded without mistakes; outlives this
  explicit IdlTypes(const idl::Program& program) : program_(program) {}

  /// Of what is copied between threads that must not allocate: members of an event, values of a
  /// port.
  base::Result<const types::Type*> of_fixed_size(const idl::Type& type) const;
  /// Of a command's parameter, which may be a list too.
  base::Result<const types::Type*> of_command(const idl::Type& type) const;
  /// Of a request's parameter or result, which may also be a text of any length.
  base::Result<const types::Type*> of_request(const idl::Type& type) const;

 private:
  base::Result<const types::Type*> single(const idl::Type& type) const;
  base::Result<const types::Type*> structure(const std::string& name) const;
  const types::Type& enumeration(const std::string& name) const;

  const idl::Program& program_;
};

/// Lines of documentation as one.
std::string to_text(const idl::Doc& doc);

}  // namespace armature::remote::internal
