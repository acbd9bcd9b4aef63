// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/fitting.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"

namespace armature::inspect {
namespace {

using component::Component;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// An angle and a list of two.
class Source final : public Component {
 public:
  using Component::Component;

 private:
  component::OutputPort<double> angle_{this, "Angle", "where it is", "rad"};
  component::Event<double> passed_{this, "Passed", "went by", {"position [rad]"}};
};

class Sink final : public Component {
 public:
  using Component::Component;

 private:
  void take(double) {}
  component::Outcome move(double) { return component::accepted(); }

  component::InputPort<double> degrees_{this, "Degrees", "in degrees", "deg"};
  component::InputPort<double> angle_{this, "Angle", "in radians", "rad"};
  component::InputPort<double> length_{this, "Length", "in metres", "m"};
  component::InputPort<int> count_{this, "Count", "how many"};
  component::InputPort<double> all_{this, "All", "of several", "rad", component::fan_in};
  component::Command<double> move_{this, "moveTo", component::serve<&Sink::move>, "goes there",
                                   component::args("position [rad]")};
  component::Command<double> home_{this,
                                   "home",
                                   component::serve<&Sink::move>,
                                   "finds its zero",
                                   component::args("position [rad]"),
                                   component::by_operator};
};

class Broken final : public Component {
 public:
  explicit Broken(std::string name) : Component(std::move(name)) {
    throw std::runtime_error("no card");
  }
};

class Fitting : public testing::Test {
 protected:
  Fitting() {
    blueprint_.add<Source>("Source");
    blueprint_.add<Source>("Other");
    blueprint_.add<Sink>("Sink");
  }

  /// The members that fit, as paths.
  std::vector<std::string> fit(std::string_view component, std::string_view member) {
    std::vector<std::string> paths;
    const auto ends = fitting(blueprint_, component, member);
    for (const End& end : ends.value()) {
      if (end.fits()) paths.push_back(end.component + "." + end.member);
    }
    return paths;
  }

  std::string why_not(std::string_view component, std::string_view member,
                      std::string_view target) {
    const auto ends = fitting(blueprint_, component, member);
    for (const End& end : ends.value()) {
      if (end.member == target) return end.why_not;
    }
    return "no such end";
  }

  exec::Blueprint blueprint_;
};

TEST_F(Fitting, AnOutputFitsInputsOfItsTypeAndUnit) {
  EXPECT_THAT(fit("Source", "Angle"), ElementsAre("Sink.Angle", "Sink.All"));
}

TEST_F(Fitting, TellsWhyAnInputDoesNotFit) {
  EXPECT_EQ(why_not("Source", "Angle", "Length"),
            "'Source.Angle' is in 'rad', but 'Sink.Length' expects 'm'");
  EXPECT_EQ(why_not("Source", "Angle", "Count"),
            "'Source.Angle' writes double, but 'Sink.Count' reads int32");
}

TEST_F(Fitting, AnInputFitsTheOutputsThatItCouldRead) {
  EXPECT_THAT(fit("Sink", "Angle"), ElementsAre("Source.Angle", "Other.Angle"));
  EXPECT_THAT(fit("Sink", "Length"), IsEmpty());
}

TEST_F(Fitting, AnInputThatIsWrittenTakesNoSecondWriter) {
  blueprint_.connect("Source.Angle", "Sink.Angle");
  blueprint_.connect("Source.Angle", "Sink.All");
  EXPECT_THAT(fit("Other", "Angle"), ElementsAre("Sink.All"));
  EXPECT_EQ(why_not("Other", "Angle", "Angle"), "'Sink.Angle' is written by 'Source.Angle'");
}

TEST_F(Fitting, WithModesTheCheckDecidesWhoWrites) {
  blueprint_.connect("Source.Angle", "Sink.Angle");
  blueprint_.add_mode("first", {{"Source", {}}});
  blueprint_.add_mode("second", {{"Other", {}}});
  EXPECT_THAT(fit("Other", "Angle"), ElementsAre("Sink.Angle", "Sink.All"));
}

TEST_F(Fitting, AnEventGivesCommandsButThoseOfTheOperator) {
  EXPECT_THAT(fit("Source", "Passed"), ElementsAre("Sink.moveTo"));
  EXPECT_EQ(why_not("Source", "Passed", "home"), "only the operator gives this command");
  EXPECT_THAT(fit("Sink", "moveTo"), ElementsAre("Source.Passed", "Other.Passed"));
  EXPECT_THAT(fit("Sink", "home"), IsEmpty());
}

TEST_F(Fitting, NamesWhatIsUnknown) {
  EXPECT_EQ(fitting(blueprint_, "Sonk", "Angle").error(), "unknown component 'Sonk'");
  EXPECT_EQ(fitting(blueprint_, "Sink", "Agle").error(),
            "'Sink' has no port, event or command 'Agle'");
}

/// Shows numbers in any unit.
class AnyUnit final : public Component {
 public:
  using Component::Component;

 private:
  component::Property<std::string> unit_{this, "Unit", "", "of both"};
  component::InputPort<double> in_{this, "In", "what", "", component::unit_of(unit_)};
  component::OutputPort<double> out_{this, "Out", "it", "", component::unit_of(unit_)};
};

TEST_F(Fitting, APortOfAnyUnitFitsOnceItsComponentIsToldTheUnit) {
  blueprint_.add<AnyUnit>("Any");
  const auto end_of_any = [this] {
    const auto ends = fitting(blueprint_, "Source", "Angle");
    for (const End& end : ends.value()) {
      if (end.component == "Any") return end;
    }
    return End{};
  };
  EXPECT_TRUE(end_of_any().fits());
  EXPECT_EQ(end_of_any().names.property, "Unit");
  EXPECT_EQ(end_of_any().names.unit, "rad");
  blueprint_.connect("Any.Out", "Sink.Length");
  EXPECT_EQ(end_of_any().why_not, "'Source.Angle' is in 'rad', but 'Any.In' expects plain numbers");
}

TEST_F(Fitting, AModelOfAnyUnitFits) {
  component::Registry registry;
  registry.add<AnyUnit>("AnyUnit", "shows");
  const ModelPorts ports(registry);
  const std::vector<End> ends = ports.fitting(blueprint_, "Source", "Angle");
  ASSERT_EQ(ends.size(), 1u);
  EXPECT_EQ(ends[0].member, "In");
  EXPECT_EQ(ends[0].names.unit, "rad");
}

TEST_F(Fitting, ModelsThatFitAreFound) {
  component::Registry registry;
  registry.add<Sink>("Sink", "reads");
  registry.add<Source>("Source", "writes");
  registry.add<Broken>("Broken", "throws");
  const ModelPorts ports(registry);
  std::vector<std::string> found;
  for (const End& end : ports.fitting(blueprint_, "Source", "Angle")) {
    found.push_back(end.component + "." + end.member);
  }
  EXPECT_THAT(found, ElementsAre("Sink.Angle", "Sink.All"));
  EXPECT_THAT(ports.fitting(blueprint_, "Source", "Passed"), IsEmpty());
}

}  // namespace
}  // namespace armature::inspect
