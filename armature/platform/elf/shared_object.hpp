// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

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

/// The libraries that `file` was linked with, such as `libm.so.6`; empty if it is no library. Loads
/// nothing.
std::vector<std::string> needed_libraries(const std::string& file);

/// The file that the code at `address` was loaded from, empty if it is nobody's.
std::string file_of(const void* address);

/// The path of `name` in the folder of that file.
std::string file_beside(const void* address, std::string_view name);

}  // namespace armature::platform
