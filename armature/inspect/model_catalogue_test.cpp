// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/model_catalogue.hpp"

#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "armature/component/author.hpp"

namespace armature::inspect {
namespace {

using component::Component;
using nlohmann::json;
using ::testing::HasSubstr;

/// Has one of everything.
class Everything final : public Component {
 public:
  using Component::Component;

 private:
  void pass(double) {}
  void reset(double) {}
  component::Outcome move(double) { return component::accepted(); }

  component::Property<double> gain_{this,
                                    "Gain",
                                    0.5,
                                    "of the loop",
                                    "V/rad",
                                    component::range(0.0, 10.0),
                                    component::changeable_while_running};
  component::Property<double> open_{
      this, "Open",
      1.0,  "has no upper limit",
      "",   component::range(0.0, std::numeric_limits<double>::infinity())};
  component::Property<int> joints_{this, "joints", 2, "how many", "", component::mandatory};
  component::Property<std::string> label_{this, "Label", "", "for people"};
  component::Attribute<int> mode_{this, "Mode", 3, "not kept"};
  component::InputPort<double> in_{this,
                                   "In",
                                   "an angle",
                                   "rad",
                                   component::on_data<&Everything::pass>,
                                   component::max_age(std::chrono::milliseconds(20))};
  component::InputPorts<double> more_{this,     "More", joints_,
                                      "angles", "rad",  component::may_stay_open};
  component::OutputPort<std::vector<double>> out_{this, "Out", "angles", "rad",
                                                  component::size_of(joints_)};
  component::Operation<void(double)> reset_{this,
                                            "reset",
                                            component::serve<&Everything::reset>,
                                            "begins anew",
                                            component::in_own_thread,
                                            component::args("position [rad]")};
  component::Command<double> move_{this,
                                   "moveTo",
                                   component::serve<&Everything::move>,
                                   "goes there",
                                   component::args("position [rad]"),
                                   component::by_operator};
  component::Event<double> passed_{this, "passed", "went by", {"position [rad]"}};
  component::OperationCaller<double()> read_{this, "read", "reads the position",
                                             component::optional};
};

class Broken final : public Component {
 public:
  explicit Broken(std::string name) : Component(std::move(name)) {
    throw std::runtime_error("there is no card");
  }
};

component::Registry registry() {
  component::Registry models;
  models.begin_library("motion");
  models.add<Everything>("Everything", "has one of everything", component::Granularity::kAtomic,
                         component::drawn_as("gauge"));
  EXPECT_EQ(models.end_library(), "");
  models.add<Broken>("Broken", "cannot be made");
  return models;
}

TEST(ModelCatalogue, ListsModelsWithGranularityLibraryAndPurpose) {
  EXPECT_EQ(list_models(registry()),
            "Broken      algorithm  the program  cannot be made\n"
            "Everything  atomic     motion       has one of everything\n");
}

TEST(ModelCatalogue, DescribesAModelForPeople) {
  EXPECT_EQ(describe_model(registry(), "Everything").value(),
            R"(Everything: has one of everything (atomic, library motion)

properties
  Gain    double  V/rad  of the loop (default 0.5, 0 .. 10, changeable while running)
  Open    double         has no upper limit (default 1, 0 .. inf)
  joints  int32          how many (mandatory)
  Label   text           for people (default "")
  Mode    int32          not kept (default 3, attribute)

inputs
  In     double  rad  an angle (triggers, at most 20 ms old, else stop)
  More1  double  rad  angles (may stay open)
  More2  double  rad  angles (may stay open)

outputs
  Out  vector<double>  rad  angles (2 elements)

port arrays
  More1..N  N is the property joints

operations
  reset   void(double position [rad])  begins anew (in its own thread)
  moveTo  void(double position [rad])  goes there (command with completion, by the operator)

events
  passed  void(double position [rad])  went by

requires from its peers
  read  double()  reads the position (operation, optional)
)");
}

TEST(ModelCatalogue, DescribesModelsForMachines) {
  const json models = json::parse(models_as_json(registry(), {"Everything"}).value());
  ASSERT_EQ(models.size(), 1u);
  const json& model = models[0];
  EXPECT_EQ(model["name"], "Everything");
  EXPECT_EQ(model["library"], "motion");
  EXPECT_EQ(model["granularity"], "atomic");
  EXPECT_EQ(model["face"], "gauge");
  EXPECT_EQ(model["properties"][0], json({{"name", "Gain"},
                                          {"type", "double"},
                                          {"unit", "V/rad"},
                                          {"doc", "of the loop"},
                                          {"default", "0.5"},
                                          {"range", {0.0, 10.0}},
                                          {"persistent", true},
                                          {"mandatory", false},
                                          {"changeable_while_running", true}}));
  EXPECT_EQ(model["properties"][1]["range"], json({0.0, nullptr}));
  EXPECT_EQ(model["inputs"][0]["max_age_ns"], 20'000'000);
  EXPECT_EQ(model["inputs"][0]["on_old"], "stop");
  EXPECT_TRUE(model["inputs"][0]["triggers"]);
  EXPECT_EQ(model["outputs"][0]["size"], 2);
  EXPECT_EQ(model["operations"][1]["command"], true);
  EXPECT_EQ(model["operations"][0]["by_operator"], false);
  EXPECT_EQ(model["operations"][1]["by_operator"], true);
  EXPECT_EQ(model["events"][0]["signature"], "void(double position [rad])");
  EXPECT_EQ(model["requirements"][0]["kind"], "operation");
}

class AnyUnit final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Property<std::string> unit_{this, "Unit", "", "of all"};
  component::Property<double> goal_{this, "Goal", 0.0, "where to", "", component::unit_of(unit_)};
  component::OutputPort<double> out_{this, "Out", "it", "", component::unit_of(unit_)};
};

TEST(ModelCatalogue, NamesThePropertyThatNamesAUnit) {
  component::Registry registry;
  registry.add<AnyUnit>("AnyUnit", "serves any unit");
  const std::string text = describe_model(registry, "AnyUnit").value();
  EXPECT_THAT(text, HasSubstr("Goal  double  (Unit)  where to"));
  EXPECT_THAT(text, HasSubstr("Out  double  (Unit)  it"));
  const json model = json::parse(models_as_json(registry, {"AnyUnit"}).value())[0];
  EXPECT_EQ(model["properties"][1]["unit_property"], "Unit");
  EXPECT_EQ(model["outputs"][0]["unit_property"], "Unit");
  EXPECT_FALSE(model["properties"][0].contains("unit_property"));
}

TEST(ModelCatalogue, AnUnknownModelIsAnsweredWithANearOne) {
  EXPECT_EQ(describe_model(registry(), "Evrything").error(),
            "unknown model 'Evrything'; did you mean 'Everything'?");
  EXPECT_EQ(models_as_json(registry(), {"Evrything"}).error(),
            "unknown model 'Evrything'; did you mean 'Everything'?");
}

TEST(ModelCatalogue, AModelThatCannotBeMadeSaysWhy) {
  EXPECT_EQ(describe_model(registry(), "Broken").error(),
            "the constructor of model 'Broken' throws: there is no card");
}

}  // namespace
}  // namespace armature::inspect
