// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/inspect/model_catalogue.hpp"

namespace armature::deploy {

using namespace inspect;

using namespace document;
namespace {

using component::Component;
using ::testing::HasSubstr;
using ::testing::Not;

struct Wheel {
  double speed = 0.0;
  double torque = 0.0;
};
ARMATURE_STRUCT(Wheel, (speed, "rad/sec"), (torque, "N m"));

struct Axle {
  std::array<Wheel, 2> wheels;
};
ARMATURE_STRUCT(Axle, wheels);

/// Has a wrong unit wherever there may be one.
class Wrong final : public Component {
 public:
  using Component::Component;

 private:
  component::Property<int> wheels_{this, "wheels", 0, "how many"};
  component::Property<double> good_{this, "Good", 1.0, "a right one", "V/(rad s)"};
  component::Property<double> rate_{this, "Rate", 1.0, "how fast", "rad/sec"};
  component::Attribute<double> seen_{this, "Seen", 1.0, "how long", "second"};
  component::InputPort<Axle> axle_{this, "Axle", "what it does"};
  component::OutputPort<double> out_{this, "Out", "a voltage", "Volt"};
  component::InputPorts<double> each_{this, "Each", wheels_, "of each", "degrees"};
};

struct Note {
  double urgency = 0.0;
  std::string text;
};
ARMATURE_STRUCT(Note, urgency, text);
struct Notes {
  std::vector<Note> all;
};
ARMATURE_STRUCT(Notes, all);

/// Its ports carry text that grows.
class Talker final : public Component {
 public:
  using Component::Component;

 private:
  component::Property<Note> first_{this, "First", {}, "properties may"};
  component::OutputPort<Notes> said_{this, "Said", "what it said"};
};

/// The ports of its array exist.
class Mux final : public Component {
 public:
  using Component::Component;

 private:
  component::Property<int> joints_{this, "joints", 3, "how many"};
  component::InputPorts<double> each_{this,      "Each",    joints_,
                                      "of each", "degrees", component::may_stay_open};
};

class Right final : public Component {
 public:
  using Component::Component;
};

void add_models(component::Registry& registry) {
  registry.begin_library("drives");
  registry.add<Wrong>("Wrong", "has wrong units");
  EXPECT_EQ(registry.end_library(), "");
  registry.add<Mux>("Mux", "has wrong units in a port array");
  registry.add<Talker>("Talker", "has ports with text");
  registry.add<Right>("Right", "has no wrong unit");
}

std::string answer_to(const std::string& yaml) {
  DeploymentOptions options;
  options.models = &add_models;
  options.cpus = 2;
  return parse_deployment(yaml, "app.yaml", options).diagnostics.to_text();
}

const std::string kWrong = "model 'Wrong' of library 'drives': ";
const std::string kMux =
    "model 'Mux' of the program: ports 'Each1..N': unknown unit 'degrees' (did you mean 'deg'?)";

TEST(ModelMistakes, EachUnknownUnitIsAMistakeThatNamesLibraryModelMemberAndUnit) {
  const std::string answer = answer_to("components: {A: {model: Wrong}}");
  const std::string begin = "app.yaml:1:25: error: " + kWrong;
  EXPECT_THAT(answer,
              HasSubstr(begin + "property 'Rate': unknown unit 'sec' in 'rad/sec' (did you mean "
                                "'s'?)\n"));
  EXPECT_THAT(answer,
              HasSubstr(begin + "attribute 'Seen': unknown unit 'second' (did you mean 's'?)\n"));
  EXPECT_THAT(answer, HasSubstr(begin + "input 'Axle', field 'wheels.speed': unknown unit 'sec' in "
                                        "'rad/sec' (did you mean 's'?)\n"));
  EXPECT_THAT(answer, HasSubstr(begin + "output 'Out': unknown unit 'Volt'"));
  EXPECT_THAT(answer, HasSubstr(begin + "ports 'Each1..N': unknown unit 'degrees' (did you mean "
                                        "'deg'?)\n"));
  EXPECT_THAT(answer, Not(HasSubstr("'Good'")));
  EXPECT_THAT(answer, Not(HasSubstr("torque")));
}

TEST(ModelMistakes, TextThatGrowsInsideThePortsDataIsOne) {
  EXPECT_EQ(answer_to("components: {A: {model: Talker, activity: {periodic: 1 ms}}}"),
            "app.yaml:1:25: error: model 'Talker' of the program: output 'Said': Notes has a text "
            "inside, the field 'all.text', which grows; ports carry base::FixedText\n");
}

TEST(ModelMistakes, AMistakeIsToldOnceHoweverManyComponentsAndPortsHaveIt) {
  EXPECT_EQ(answer_to("components:\n  A{1..5}: {model: Mux, activity: {periodic: 1 ms}}\n"),
            "app.yaml:2:20: error: " + kMux + "\n");
}

TEST(ModelMistakes, AModelThatNoComponentHasIsNoMistakeOfTheDeployment) {
  EXPECT_EQ(answer_to("components: {A: {model: Right}}"), "");
}

TEST(ModelMistakes, AModelWithAMistakeCannotBeDescribed) {
  component::Registry registry;
  add_models(registry);
  EXPECT_EQ(describe_model(registry, "Mux").error(), kMux);
  EXPECT_EQ(models_as_json(registry, {"Mux"}).error(), kMux);
  EXPECT_THAT(describe_model(registry, "Wrong").error(),
              HasSubstr("'s'?); " + kWrong + "attribute 'Seen'"));
  EXPECT_TRUE(describe_model(registry, "Right"));
}

}  // namespace
}  // namespace armature::deploy
