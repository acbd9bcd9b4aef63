// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/result.hpp"

namespace armature::platform {

/// A shared object that stays loaded until the process ends: code and descriptions that came from
/// it may be referred to by anyone.
class SharedObject {
 public:
  /// Loads `path` with all its symbols resolved; the error is the loader's own text.
  static base::Result<SharedObject> load(const std::string& path);

  /// The address of an exported function, nullptr if there is none of that name.
  void* symbol(const char* name) const;

 private:
  explicit SharedObject(void* handle) : handle_(handle) {}
  void* handle_;
};

/// The file that the code at `address` was loaded from, empty if it is nobody's.
std::string file_of(const void* address);

}  // namespace armature::platform
