// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/connections.hpp"

#include <gtest/gtest.h>

#include "armature/component/host.hpp"
#include "armature/exec/internal/application/test_parts.hpp"

namespace armature::exec::internal {
namespace {

/// A counter whose counts go to a gain, and its ticks to a sink.
class ConnectionsTest : public ::testing::Test {
 protected:
  static Blueprint wired() {
    Blueprint blueprint;
    blueprint.add<Counter>("Counter", Activity::periodic(10ms));
    blueprint.add<Gain>("Gain");
    blueprint.add<Sink>("Sink");
    blueprint.connect("Counter.Count", "Gain.In");
    blueprint.connect("Gain.Out", "Sink.In");
    blueprint.add_peer("Sink", "Counter");
    return blueprint;
  }
  Counter& counter() { return static_cast<Counter&>(parts_.component(0)); }
  Gain& gain() { return static_cast<Gain&>(parts_.component(1)); }
  Sink& sink() { return static_cast<Sink&>(parts_.component(2)); }
  void run_all() {
    for (const Index each : parts_.plan.start_order) {
      component::Component& component = parts_.component(each);
      ASSERT_TRUE(component::Host::configure(component));
    }
  }
  void start_all() {
    for (const Index each : parts_.plan.start_order) {
      ASSERT_TRUE(component::Host::activate(parts_.component(each)));
      ASSERT_TRUE(component::Host::start(parts_.component(each)));
    }
    for (const auto& engine : parts_.engines) engine->begin({});
  }
  void cycle() { parts_.engine_of(0).step(parts_.engine_of(0).next_due()); }

  PlannedParts parts_{wired()};
  const std::string folder_;
  const Connections connections_{parts_.blueprint, parts_.plan, folder_};
};

TEST_F(ConnectionsTest, DataAndEventsFlowOnceTheyAreMadeAndNoMoreOnceTheyAreUndone) {
  ASSERT_EQ(parts_.problems, "");
  run_all();
  base::Diagnostics diagnostics;
  connections_.make(diagnostics);
  EXPECT_EQ(diagnostics.to_text(), "");
  start_all();
  cycle();
  EXPECT_EQ(gain().steps, 1);
  EXPECT_EQ(sink().ticks, 1);
  connections_.undo();
  cycle();
  EXPECT_EQ(gain().steps, 1);
  EXPECT_EQ(sink().ticks, 1);
}

}  // namespace
}  // namespace armature::exec::internal
