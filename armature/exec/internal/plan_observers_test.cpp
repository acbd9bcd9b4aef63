// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/interface.hpp"
#include "armature/component/observing/observer.hpp"
#include "armature/exec/internal/test_components.hpp"

namespace armature::exec {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Watcher final : public component::Component, private component::Observer {
 public:
  explicit Watcher(std::string name) : Component(std::move(name)), Observer(this) {}

  std::string wanted = "Writer";
  component::Surroundings seen;
  component::Tap* tap = nullptr;
  component::Tap* property = nullptr;

 private:
  std::vector<Objection> check_view(
      const std::vector<component::Component*>& components) const override {
    for (const auto* each : components) {
      if (each->name() == wanted) return {};
    }
    return {{"there is no '" + wanted + "'", "did you mean 'Writer'?"}};
  }
  void observe(const component::Surroundings& surroundings) override {
    seen = surroundings;
    for (auto* each : surroundings.components) {
      if (each->name() != wanted) continue;
      tap = &component::interface_of(*each).outputs.front()->tap(100);
      property = &component::interface_of(*each).properties.front()->tap(4);
    }
  }
};

class Writer final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome on_start() override {
    out_.write(1.0);
    return component::accepted();
  }
  void on_update() override { out_.write(2.0); }
  void on_stop() override {
    out_.write(3.0);
    count_.assign(5);
  }
  component::OutputPort<double> out_{this, "Out", ""};
  component::Attribute<int> count_{this, "Count", 0, ""};
};

struct Watched {
  Blueprint blueprint;
  Watcher* watcher;

  explicit Watched(Activity activity = Activity::periodic(50ms)) {
    blueprint.add<Writer>("Writer", Activity::periodic(10ms));
    watcher = &blueprint.add<Watcher>("Watcher", std::move(activity));
  }
};

TEST(PlanObservers, WhatAnObserverObjectsToIsAnErrorOfTheApplication) {
  Watched application;
  application.watcher->wanted = "Wrter";
  EXPECT_THAT(problems_of(application.blueprint), AllOf(HasSubstr("'Watcher': there is no 'Wrter'"),
                                                        HasSubstr("did you mean 'Writer'?")));
}

TEST(PlanObservers, NothingIsSaidWhileComponentsAreMissingForAnotherReason) {
  Watched application;
  application.watcher->wanted = "Wrter";
  application.blueprint.absent.insert("Wrter");
  EXPECT_THAT(problems_of(application.blueprint), IsEmpty());
}

TEST(PlanObservers, AnObserverNeedsAPeriod) {
  EXPECT_THAT(
      problems_of(Watched(Activity::sequential()).blueprint),
      AllOf(HasSubstr("'Watcher' watches others and needs a period of its own, but is sequential"),
            HasSubstr("activity: {periodic: 50 ms")));
}

TEST(PlanObservers, AnObserverStartsBeforeAllOthers) {
  Watched application;
  base::Diagnostics diagnostics;
  const Plan plan = make_plan(application.blueprint, diagnostics);
  EXPECT_THAT(plan.observers, ElementsAre(1u));
  EXPECT_THAT(plan.start_order, ElementsAre(1u, 0u));
}

TEST(Observers, SeeEveryComponentAndAllThatIsWrittenFromStartToStop) {
  Watched made;
  Watcher& watcher = *made.watcher;
  ApplicationOptions options;
  options.simulated = true;
  options.output_folder = "out";
  Application application(std::move(made.blueprint), std::move(options));
  ASSERT_TRUE(application.start().ok());
  EXPECT_EQ(watcher.seen.components.size(), 2u);
  EXPECT_EQ(watcher.seen.folder, "out");
  application.run_for(15ms);
  component::TappedSample sample;
  int samples = 0;
  while (watcher.tap->take(sample)) ++samples;
  EXPECT_EQ(samples, 2);  // at start and after 10 ms
  EXPECT_TRUE(watcher.property->take(sample));
  EXPECT_TRUE(application.stop().ok());
}

TEST(Observers, LookAgainWhenTheApplicationIsStartedAgain) {
  Watched made;
  Watcher& watcher = *made.watcher;
  ApplicationOptions options;
  options.simulated = true;
  Application application(std::move(made.blueprint), std::move(options));
  component::TappedSample sample;
  for (int run = 0; run < 2; ++run) {
    ASSERT_TRUE(application.start().ok());
    EXPECT_TRUE(watcher.property->take(sample));
    EXPECT_TRUE(watcher.tap->take(sample));
    EXPECT_FALSE(watcher.tap->take(sample));
    EXPECT_TRUE(application.stop().ok());
  }
  for (const auto& entry : application.blueprint().components) {
    for (const auto* output : component::interface_of(*entry.component).outputs) {
      EXPECT_FALSE(output->is_tapped());
    }
  }
}

}  // namespace
}  // namespace armature::exec
