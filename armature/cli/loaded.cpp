// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/loaded.hpp"

#include "armature/platform/clock.hpp"
#include "armature/platform/shared_object.hpp"

namespace armature::cli {

void* load_function(const std::string& library, const char* function, const std::string& needs,
                    base::Diagnostics& diagnostics) {
  const auto loaded = platform::SharedObject::load(
      platform::file_beside(reinterpret_cast<const void*>(&platform::monotonic_now), library));
  void* const found = loaded ? loaded.value().symbol(function) : nullptr;
  if (found == nullptr) {
    diagnostics.error({}, needs + " " + library + " beside the other libraries: " +
                              (loaded ? std::string("it is another version") : loaded.error()));
  }
  return found;
}

}  // namespace armature::cli
