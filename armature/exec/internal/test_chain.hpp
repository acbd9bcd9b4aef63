// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests of applications: a chain of components, in both kinds of time.

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {

/// Three probes A -> B -> C, each noting what happens to it.
struct Chain {
  Journal journal;
  Blueprint blueprint;
  Probe* a;
  Probe* b;
  Probe* c;

  Chain() {
    // Declared against the flow, which is what decides.
    c = &blueprint.add<Probe>("C", Activity::periodic(10ms));
    b = &blueprint.add<Probe>("B", Activity::periodic(10ms));
    a = &blueprint.add<Probe>("A", Activity::periodic(10ms));
    blueprint.connect("A.Out", "B.Look");
    blueprint.connect("B.Out", "C.Look");
    for (Probe* each : {a, b, c}) {
      each->journal = &journal;
      each->actions["update"] = [] {};
    }
  }

  /// What was noted but for the updates.
  std::vector<std::string> life() {
    std::vector<std::string> entries = journal.take();
    std::erase_if(entries, [](const std::string& entry) { return entry.ends_with("update"); });
    return entries;
  }
  std::vector<component::State> states() const { return {a->state(), b->state(), c->state()}; }
};

/// Its tests run in simulated time and in threads.
class ApplicationTime : public ::testing::TestWithParam<bool> {
 protected:
  static ApplicationOptions options() { return patient(GetParam()); }
};

}  // namespace armature::exec
