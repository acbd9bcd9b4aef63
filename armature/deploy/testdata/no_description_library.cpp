// SPDX-License-Identifier: Apache-2.0
extern "C" __attribute__((visibility("default"))) const void* armature_component_library() {
  return nullptr;
}
