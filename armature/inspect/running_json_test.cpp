// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/running_json.hpp"

#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "armature/component/author.hpp"
#include "armature/inspect/application_view.hpp"
#include "armature/inspect/checked_json.hpp"

namespace armature::inspect {
namespace {

using namespace std::chrono_literals;
using component::Component;
using nlohmann::json;

class Lamp final : public Component {
 public:
  using Component::Component;

 private:
  component::Property<double> power_{
      this, "Power", 40.0, "while it shines", "W", component::changeable_while_running};
  component::OutputPort<double> light_{this, "Light", "on the wall", "lm"};
};

class Eye final : public Component {
 public:
  using Component::Component;

 private:
  void look(double) {}
  component::InputPort<double> in_{this, "In", "what it sees", "lm",
                                   component::on_data<&Eye::look>};
  component::InputPort<double> other_{this, "Other", "which may stay open", "lm",
                                      component::may_stay_open};
};

exec::Blueprint room() {
  exec::Blueprint blueprint;
  blueprint.name = "room";
  blueprint.add<Lamp>("Lamp", exec::Activity::periodic(10ms));
  blueprint.add<Eye>("Eye");
  for (exec::ComponentEntry& entry : blueprint.components) entry.model = entry.component->name();
  blueprint.connect("Lamp.Light", "Eye.In");
  return blueprint;
}

json checked_room() {
  base::Diagnostics diagnostics;
  const exec::Blueprint blueprint = room();
  const exec::Plan plan = exec::make_plan(blueprint, diagnostics);
  return json::parse(checked_as_json({"room.yaml", diagnostics, blueprint, plan}, {}));
}

exec::ApplicationOptions simulated() {
  exec::ApplicationOptions options;
  options.simulated = true;
  return options;
}

class RunningJson : public testing::Test {
 protected:
  RunningJson() : application_(room(), simulated()) {
    EXPECT_EQ(application_.start().to_text(), "");
    application_.run_for(50ms);
  }

  json written() { return json::parse(running_as_json(view_, "tcp://hall:4242")); }

  exec::Application application_;
  ApplicationView view_{application_};
};

TEST_F(RunningJson, HasTheFormOfACheckWithoutPlacesInFiles) {
  const json running = written();
  const json checked = checked_room();
  for (const auto& [key, value] : checked.items()) EXPECT_TRUE(running.contains(key)) << key;
  EXPECT_EQ(running["file"], "tcp://hall:4242");
  EXPECT_EQ(running["application"], "room");
  EXPECT_EQ(running["connections"], checked["connections"]);
  ASSERT_EQ(running["components"].size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const json& component = running["components"][i];
    for (const auto& [key, value] : checked["components"][i].items()) {
      EXPECT_TRUE(component.contains(key)) << key;
    }
    EXPECT_FALSE(component.contains("file"));
  }
  EXPECT_EQ(running["threads"][0]["order"], json({"Lamp", "Eye"}));
  EXPECT_EQ(running["components"][0]["activity"]["kind"], "every 10 ms");
}

TEST_F(RunningJson, HasWhatPropertiesAreNow) {
  view_.write("Lamp.Power", "60 W");
  EXPECT_EQ(written()["components"][0]["properties"][0]["value"], "60");
}

TEST_F(RunningJson, OnlyConnectedInputsMustNotStayOpen) {
  const json running = written();
  const json& inputs = running["components"][1]["inputs"];
  EXPECT_EQ(inputs[0]["may_stay_open"], false);
  EXPECT_EQ(inputs[1]["may_stay_open"], true);
}

}  // namespace
}  // namespace armature::inspect
