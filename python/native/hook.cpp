// SPDX-License-Identifier: Apache-2.0
#include "python/native/hook.hpp"

namespace armature::python {
namespace {

thread_local int hooks = 0;  ///< one within the other

}  // namespace

bool in_hook() { return hooks > 0; }

HookScope::HookScope() { ++hooks; }
HookScope::~HookScope() { --hooks; }

}  // namespace armature::python
