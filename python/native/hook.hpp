// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace armature::python {

/// Whether this thread is in the hook of a component that is written in Python.
bool in_hook();

/// Throws a Refusal if so: components do not command their application.
void expect_no_hook();

/// While it lives, this thread is.
class HookScope {
 public:
  HookScope();
  HookScope(const HookScope&) = delete;
  HookScope& operator=(const HookScope&) = delete;
  ~HookScope();
};

}  // namespace armature::python
