// SPDX-License-Identifier: Apache-2.0
#include "armature/component/properties/property.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/component/interface.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::component {
namespace {

using testing::ElementsAre;
using types::Value;

struct Gains {
  double p = 0.0;
  double i = 0.0;
};
ARMATURE_STRUCT(Gains, p, i);

class Controller : public Component {
 public:
  using Component::Component;
  Property<double> kp{
      this, "Kp", 0.5, "proportional gain", "V/rad", range(0.0, 10.0), changeable_while_running};
  Property<std::string> peer{this, "PeerName", "card", "name of the card", "", mandatory};
  Property<std::vector<double>> limits{this,  "limits",        {1.0, 2.0}, "one per joint",
                                       "rad", range(-3.0, 3.0)};
  Property<Gains> gains{this, "gains", {1.0, 2.0}, "both", "", range(0.0, 5.0)};
  Property<std::uint8_t> retries{this, "retries", 3, "how often", "", range(1, 5)};
  Attribute<int> cycles{this, "cycles", 0, "since the start"};
};

class Properties : public testing::Test {
 protected:
  Properties() : thread_(controller_) {}
  Controller controller_{"joint1.pid"};
  TestThread thread_;
};

TEST_F(Properties, ReadLikeTheValueTheyAre) {
  EXPECT_EQ(controller_.kp.get(), 0.5);
  EXPECT_EQ(controller_.kp(), 0.5);
  const double gain = controller_.kp * 2.0;
  EXPECT_EQ(gain, 1.0);
  EXPECT_EQ(controller_.gains().i, 2.0);
}

/// Serves any unit.
class Goal : public Component {
 public:
  using Component::Component;
  Property<std::string> unit{this, "Unit", "", "of the goal"};
  Property<double> goal{this, "Goal", 0.0, "where to", "", unit_of(unit), range(0.0, 2.0)};
};

TEST(Property, HasTheUnitThatAnotherOneNames) {
  Goal component("C");
  EXPECT_EQ(component.goal.unit(), "");
  EXPECT_EQ(component.goal.unit_property(), &component.unit);
  EXPECT_EQ(component.unit.unit_property(), nullptr);
  ASSERT_TRUE(component.unit.set(types::Value::of(std::string("rad"))));
  EXPECT_EQ(component.goal.unit(), "rad");
  EXPECT_EQ(component.goal.set(types::Value::of(3.0)).error(),
            "property 'Goal' of 'C' is 3, outside 0 .. 2 rad");
}

TEST_F(Properties, KnowTheirNameDocumentationUnitTypeAndFlags) {
  EXPECT_EQ(controller_.kp.name(), "Kp");
  EXPECT_EQ(controller_.kp.doc(), "proportional gain");
  EXPECT_EQ(controller_.kp.unit(), "V/rad");
  EXPECT_EQ(controller_.kp.type().name, "double");
  EXPECT_TRUE(controller_.kp.changeable());
  EXPECT_TRUE(controller_.kp.persistent());
  EXPECT_FALSE(controller_.kp.is_mandatory());
  EXPECT_FALSE(controller_.cycles.persistent());
  EXPECT_FALSE(controller_.peer.changeable());
  EXPECT_TRUE(controller_.peer.is_mandatory());
  EXPECT_FALSE(controller_.peer.was_set());
  EXPECT_TRUE(controller_.peer.set(Value::of(std::string("card1"))));
  EXPECT_TRUE(controller_.peer.was_set());
}

TEST_F(Properties, AreListedInTheOrderOfDeclaration) {
  std::vector<std::string_view> names;
  for (const PropertyBase* property : interface_of(controller_).properties) {
    names.push_back(property->name());
  }
  EXPECT_THAT(names, ElementsAre("Kp", "PeerName", "limits", "gains", "retries", "cycles"));
}

TEST_F(Properties, AValueOfAnotherTypeIsRefused) {
  const auto refusal = controller_.kp.set(Value::of(1));
  ASSERT_FALSE(refusal);
  EXPECT_EQ(refusal.error(), "property 'Kp' of 'joint1.pid' is a double, not a int32");
  EXPECT_EQ(controller_.kp(), 0.5);
}

TEST_F(Properties, BothEndsOfTheRangeAreInsideEverythingElseIsRefused) {
  EXPECT_TRUE(controller_.kp.set(Value::of(0.0)));
  EXPECT_TRUE(controller_.kp.set(Value::of(10.0)));
  const auto refusal = controller_.kp.set(Value::of(10.5));
  ASSERT_FALSE(refusal);
  EXPECT_EQ(refusal.error(), "property 'Kp' of 'joint1.pid' is 10.5, outside 0 .. 10 V/rad");
  EXPECT_FALSE(controller_.kp.set(Value::of(-0.1)));
  EXPECT_FALSE(controller_.kp.set(Value::of(std::nan(""))));
  EXPECT_FALSE(controller_.kp.set(Value::of(std::numeric_limits<double>::infinity())));
  EXPECT_EQ(controller_.kp(), 10.0);
}

TEST_F(Properties, TheRangeHoldsForEachNumberOfAListOrStruct) {
  EXPECT_FALSE(controller_.limits.set(Value::of(std::vector<double>{1.0, 4.0})));
  EXPECT_TRUE(controller_.limits.set(Value::of(std::vector<double>{1.0, -3.0, 3.0})));
  EXPECT_FALSE(controller_.gains.set(Value::of(Gains{1.0, 6.0})));
  EXPECT_TRUE(controller_.gains.set(Value::of(Gains{1.0, 5.0})));
  EXPECT_FALSE(controller_.retries.set(Value::of(std::uint8_t{0})));
  EXPECT_TRUE(controller_.retries.set(Value::of(std::uint8_t{5})));
}

TEST_F(Properties, WhileTheComponentRunsOnlyAChangeableOneChanges) {
  start(controller_);
  EXPECT_TRUE(controller_.kp.set(Value::of(1.0)));
  const auto refusal = controller_.peer.set(Value::of(std::string("card2")));
  ASSERT_FALSE(refusal);
  EXPECT_EQ(refusal.error(),
            "property 'PeerName' of 'joint1.pid' cannot change while the component runs; stop it "
            "first");
  Host::stop(controller_);
  EXPECT_TRUE(controller_.peer.set(Value::of(std::string("card2"))));
}

TEST_F(Properties, AComponentChangesItsOwnWheneverItLikes) {
  start(controller_);
  controller_.cycles.assign(7);
  EXPECT_EQ(controller_.cycles(), 7);
}

TEST_F(Properties, ACheckHasNoEffect) {
  EXPECT_EQ(controller_.kp.check(Value::of(2.0)), "");
  EXPECT_EQ(controller_.kp(), 0.5);
  EXPECT_FALSE(controller_.kp.was_set());
}

TEST_F(Properties, SwappingTradesTheValues) {
  Value value = Value::of(std::vector<double>{9.0});
  controller_.limits.swap(value);
  EXPECT_THAT(controller_.limits(), ElementsAre(9.0));
  EXPECT_THAT(*value.get_if<std::vector<double>>(), ElementsAre(1.0, 2.0));
}

// --- ports that follow a property ----------------------------------------------------------------

class Mux : public Component {
 public:
  using Component::Component;
  Property<int> joints{this, "joints", 2, "number of joints", "", range(0, 100)};
  InputPorts<double> positions{this,  "Position",         joints, "of each joint",
                               "rad", on_data<&Mux::take>};
  OutputPorts<double> voltages{this, "Voltage", joints, "for each joint", "V"};
  std::vector<std::size_t> arrived;

 private:
  void take(std::size_t index, double) { arrived.push_back(index); }
};

std::vector<std::string> names_of(const std::vector<InputPortBase*>& ports) {
  std::vector<std::string> names;
  for (const auto* port : ports) names.push_back(port->name());
  return names;
}

class PortArrays : public testing::Test {
 protected:
  PortArrays() : thread_(mux_, source_) {}
  Mux mux_{"mux"};
  class Source : public Component {
   public:
    using Component::Component;
    OutputPort<double> out{this, "Out", "a position", "rad"};
  } source_{"source"};
  TestThread thread_;
};

TEST_F(PortArrays, FollowTheirPropertyUpAndDown) {
  EXPECT_EQ(mux_.positions.size(), 2u);
  ASSERT_TRUE(mux_.joints.set(Value::of(4)));
  EXPECT_EQ(mux_.voltages.size(), 4u);
  EXPECT_THAT(names_of(interface_of(mux_).inputs),
              ElementsAre("Position1", "Position2", "Position3", "Position4"));
  ASSERT_TRUE(mux_.joints.set(Value::of(1)));
  EXPECT_THAT(names_of(interface_of(mux_).inputs), ElementsAre("Position1"));
  EXPECT_EQ(interface_of(mux_).outputs.size(), 1u);
  ASSERT_TRUE(mux_.joints.set(Value::of(0)));
  EXPECT_EQ(mux_.positions.size(), 0u);
}

TEST_F(PortArrays, HaveTheOptionsOfTheirDeclarationAndAnIndex) {
  ASSERT_TRUE(mux_.joints.set(Value::of(3)));
  start(mux_);
  face(source_.out).connect(face(mux_.positions[2]), {});
  source_.out.write(1.0);
  EXPECT_THAT(mux_.arrived, ElementsAre(2u));
  EXPECT_EQ(face(mux_.positions[2]).unit(), "rad");
}

TEST_F(PortArrays, KeepTheirSizeWhileOneOfThemIsConnected) {
  face(source_.out).connect(face(mux_.positions[1]), {});
  const auto refusal = mux_.joints.set(Value::of(1));
  ASSERT_FALSE(refusal);
  EXPECT_EQ(refusal.error(),
            "property 'joints' of 'mux' cannot change: port 'Position2' is connected");
  EXPECT_EQ(mux_.joints(), 2);
  EXPECT_EQ(mux_.positions.size(), 2u);
  EXPECT_TRUE(mux_.joints.set(Value::of(2))) << "no change at all";
  face(source_.out).disconnect_all();
  EXPECT_TRUE(mux_.joints.set(Value::of(1)));
  EXPECT_EQ(mux_.positions.size(), 1u);
}

TEST_F(PortArrays, ANegativeNumberIsNone) {
  mux_.joints.assign(-3);
  EXPECT_EQ(mux_.positions.size(), 0u);
}

/// As a controller judges its gains.
class NoEvenRetries final : public PropertyFollower {
 public:
  void follow() override {}
  std::string objection() const override { return {}; }
  std::string objection_to(const PropertyBase& property, const Value& value) const override {
    const int wanted = *static_cast<const std::uint8_t*>(value.data());
    return wanted % 2 == 0 ? std::string(property.name()) + " is even" : "";
  }
};

TEST_F(Properties, CannotHaveAValueThatAFollowerObjectsTo) {
  NoEvenRetries follower;
  controller_.retries.add_follower(follower);
  EXPECT_EQ(controller_.retries.set(Value::of<std::uint8_t>(4)).error(),
            "property 'retries' of 'joint1.pid' cannot be 4: retries is even");
  EXPECT_EQ(controller_.retries.get(), 3);
  EXPECT_TRUE(controller_.retries.set(Value::of<std::uint8_t>(5)));
}

}  // namespace
}  // namespace armature::component
