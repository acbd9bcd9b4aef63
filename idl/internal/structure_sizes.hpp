// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "idl/model.hpp"

namespace armature::idl::internal {

/// How large things are where structs are written out. None of it goes beyond twice its limit.
struct Size {
  std::size_t canonical = 0;  ///< characters of the canonical form
  std::size_t wire = 0;       ///< least bytes in a message
  std::size_t depth = 0;      ///< structs in structs
};

/// Measures structs, and finds those that contain themselves.
class StructureSizes {
 public:
  StructureSizes(const Program& program, base::Diagnostics& diagnostics)
      : program_(program), diagnostics_(diagnostics) {}

  /// Of a struct or event; reports once what is wrong with it or in it.
  Size of(const Structure& structure);
  Size of(const Type& type);
  Size of(const std::vector<Field>& fields);

 private:
  void report_circle(const Structure& structure);

  const Program& program_;
  base::Diagnostics& diagnostics_;
  std::map<const Structure*, Size> known_;
  std::vector<const Structure*> open_;
};

}  // namespace armature::idl::internal
