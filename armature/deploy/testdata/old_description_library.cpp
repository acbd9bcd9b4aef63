// SPDX-License-Identifier: Apache-2.0
// As if built when a description had no layout yet: the same version, but another description.
#include "armature/component/registry.hpp"

namespace {

struct OldDescription {
  const char* abi;
  const char* name;
  void (*fill)(armature::component::Registry& registry);
};

}  // namespace

extern "C" __attribute__((visibility("default"))) const armature::component::LibraryDescription*
armature_component_library() {
  static const OldDescription description{ARMATURE_ABI_TAG, "old",
                                          [](armature::component::Registry&) { __builtin_trap(); }};
  // It had the same name then.
  return reinterpret_cast<const armature::component::LibraryDescription*>(&description);
}
