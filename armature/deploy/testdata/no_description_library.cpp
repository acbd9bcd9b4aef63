// SPDX-License-Identifier: Apache-2.0
#include "armature/component/registry.hpp"

extern "C" __attribute__((visibility("default"))) const armature::component::LibraryDescription*
armature_component_library() {
  return nullptr;
}
