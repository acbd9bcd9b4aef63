// SPDX-License-Identifier: Apache-2.0
namespace armature::component {
int function_of_tomorrow();
}
extern "C" int uses_newer_headers() { return armature::component::function_of_tomorrow(); }
