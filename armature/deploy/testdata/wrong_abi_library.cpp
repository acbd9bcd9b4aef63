// SPDX-License-Identifier: Apache-2.0
// As if built against another version; its other fields must not be touched.
#include "armature/component/registry.hpp"

extern "C" __attribute__((visibility("default"))) const armature::component::LibraryDescription*
armature_component_library() {
  static const armature::component::LibraryDescription description{
      "armature-9.9/0/0/0", armature::component::layout_fingerprint(), "wrong_abi",
      [](armature::component::Registry&) { __builtin_trap(); }};
  return &description;
}
