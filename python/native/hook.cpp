// SPDX-License-Identifier: Apache-2.0
#include "python/native/hook.hpp"

#include "armature/inspect/view.hpp"

namespace armature::python {
namespace {

thread_local int hooks = 0;  ///< one within the other

}  // namespace

bool in_hook() { return hooks > 0; }

void expect_no_hook() {
  if (!in_hook()) return;
  throw inspect::Refusal(
      "a component cannot command its application while it is updated: "
      "connect ports instead");
}

HookScope::HookScope() { ++hooks; }
HookScope::~HookScope() { --hooks; }

}  // namespace armature::python
