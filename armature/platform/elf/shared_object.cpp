// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/elf/shared_object.hpp"

#include <dlfcn.h>

#include "armature/platform/elf/linked_file.hpp"
#include "armature/platform/file.hpp"

namespace armature::platform {

base::Result<SharedObject> SharedObject::load(const std::string& path) {
  if (path.find('/') != std::string::npos) {
    // To open a pipe would wait for whoever writes it.
    if (auto file = expect_file(path); !file) return base::Error{file.error()};
  }
  void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (handle != nullptr) return SharedObject(handle);
  const char* reason = dlerror();
  return base::Error{reason != nullptr ? reason : "unknown loader error"};
}

void* SharedObject::symbol(const char* name) const { return dlsym(handle_, name); }

std::vector<std::string> needed_libraries(const std::string& file) {
  const base::Result<LinkedFile> linked = read_linked_file(file);
  return linked ? linked.value().needed : std::vector<std::string>{};
}

std::string file_of(const void* address) {
  Dl_info found{};
  if (dladdr(address, &found) == 0 || found.dli_fname == nullptr) return {};
  return found.dli_fname;
}

std::string file_beside(const void* address, std::string_view name) {
  const std::string here = file_of(address);
  return here.substr(0, here.rfind('/') + 1).append(name);
}

}  // namespace armature::platform
