// SPDX-License-Identifier: Apache-2.0
// As if built against other headers of the same version; it must not be asked for its models.
#include "armature/component/registry.hpp"

extern "C" __attribute__((visibility("default"))) const armature::component::LibraryDescription*
armature_component_library() {
  static const armature::component::LibraryDescription description{
      ARMATURE_ABI_TAG, armature::component::layout_fingerprint() ^ 1u, "other_layout",
      [](armature::component::Registry&) { __builtin_trap(); }};
  return &description;
}
