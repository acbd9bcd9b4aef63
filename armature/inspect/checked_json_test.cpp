// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/checked_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "armature/component/author.hpp"

namespace armature::inspect {
namespace {

using component::Component;
using nlohmann::json;

class Source final : public Component {
 public:
  using Component::Component;

 private:
  component::Property<double> gain_{this, "Gain", 0.5, "of the loop", "V/rad"};
  component::OutputPort<double> out_{this, "Out", "where it is", "rad"};
  component::Event<double> passed_{this, "Passed", "went by", {"position [rad]"}};
};

class Sink final : public Component {
 public:
  using Component::Component;

 private:
  void take(double) {}
  component::InputPort<double> in_{this, "In", "an angle", "rad", component::on_data<&Sink::take>};
};

class CheckedJson : public testing::Test {
 protected:
  CheckedJson() {
    blueprint_.name = "wave";
    blueprint_.add<Source>("Source", exec::Activity::periodic(std::chrono::milliseconds(10)));
    blueprint_.add<Sink>("Sink");
    blueprint_.connect("Source.Out", "Sink.In");
  }

  json written(bool members = true) {
    if (diagnostics_.ok()) plan_ = exec::make_plan(blueprint_, diagnostics_);
    CheckedForm form;
    form.members = members;
    form.read = [this](const std::string& file) -> base::Result<std::string> {
      if (file != "wave.yaml") return base::Error{"no such file"};
      return text_;
    };
    return json::parse(checked_as_json({"wave.yaml", diagnostics_, blueprint_, plan_}, form));
  }

  json fix(base::Location where, base::Hint hint) {
    diagnostics_.error(std::move(where), "unknown component", std::move(hint));
    const json found = written()["diagnostics"][0];
    return found.contains("fix") ? found["fix"] : json();
  }

  exec::Blueprint blueprint_;
  exec::Plan plan_;
  base::Diagnostics diagnostics_;
  std::string text_ = "components:\n  Sorce: Wave\nconnections: [Sorce.Out -> Sink.In]\n";
};

TEST_F(CheckedJson, HasTheComponentsAsTheyWereBuilt) {
  const json all = written();
  EXPECT_EQ(all["application"], "wave");
  EXPECT_EQ(all["ok"], true);
  const json source = all["components"][0];
  EXPECT_EQ(source["name"], "Source");
  EXPECT_EQ(source["activity"]["kind"], "periodic");
  EXPECT_EQ(source["activity"]["period_ns"], 10'000'000);
  EXPECT_EQ(source["properties"][0]["value"], "0.5");
  EXPECT_EQ(source["outputs"][0]["unit"], "rad");
  EXPECT_EQ(source["events"][0]["arguments"][0]["name"], "position [rad]");
}

TEST_F(CheckedJson, LeavesMembersOutIfNobodyAsks) {
  EXPECT_FALSE(written(false)["components"][0].contains("properties"));
}

TEST_F(CheckedJson, HasConnectionsAndTheOrderOfThreads) {
  const json all = written();
  ASSERT_EQ(all["connections"].size(), 1u);
  EXPECT_EQ(all["connections"][0]["from"], "Source.Out");
  EXPECT_EQ(all["connections"][0]["to"], "Sink.In");
  EXPECT_EQ(all["connections"][0]["triggers"], true);
  EXPECT_EQ(all["connections"][0]["crosses_threads"], false);
  EXPECT_EQ(all["threads"][0]["order"], (json{"Source", "Sink"}));
  EXPECT_EQ(all["components"][1]["thread"], all["threads"][0]["name"]);
}

TEST_F(CheckedJson, HasTheModesAndInWhichItStarts) {
  blueprint_.modes = {{"hold", {}, {}}, {"move", {}, {}}};
  EXPECT_EQ(written()["modes"],
            (json{{{"name", "hold"}, {"initial", true}}, {{"name", "move"}, {"initial", false}}}));
  blueprint_.initial_mode.component = "move";
  EXPECT_EQ(written()["modes"][0]["initial"], false);
  EXPECT_EQ(written()["modes"][1]["initial"], true);
}

TEST_F(CheckedJson, WithErrorsSaysWhatWasWritten) {
  diagnostics_.error({"wave.yaml", 3, 15}, "unknown unit", "leave it out");
  const json all = written();
  EXPECT_EQ(all["ok"], false);
  EXPECT_EQ(all["errors"], 1);
  EXPECT_EQ(all["connections"][0]["from"], "Source.Out");
  EXPECT_EQ(all["threads"].size(), 0u);
  const json found = all["diagnostics"][0];
  EXPECT_EQ(found["severity"], "error");
  EXPECT_EQ(found["message"], "unknown unit");
  EXPECT_EQ(found["hint"], "leave it out");
  EXPECT_EQ(found["line"], 3);
  EXPECT_EQ(found["column"], 15);
  EXPECT_FALSE(found.contains("fix"));
}

TEST_F(CheckedJson, AFixSaysWhichBytesItReplaces) {
  const json found = fix({"wave.yaml", 3, 15}, {"did you mean 'Source'?", {"Sorce", "Source"}});
  EXPECT_EQ(found["line"], 3);
  EXPECT_EQ(found["column"], 15);
  EXPECT_EQ(found["found"], "Sorce");
  EXPECT_EQ(found["by"], "Source");
}

TEST_F(CheckedJson, AFixIsSoughtBehindThePlaceOfTheFinding) {
  EXPECT_EQ(fix({"wave.yaml", 3, 15}, {"", {"In", "Inlet"}})["column"], 33);
}

TEST_F(CheckedJson, NoFixIsGivenForWhatTheFileDoesNotSay) {
  EXPECT_TRUE(fix({"wave.yaml", 3, 15}, {"", {"Sorce1", "Source1"}}).is_null());
  EXPECT_TRUE(fix({"wave.yaml", 3, 15}, {"", {"Sor", "Source"}}).is_null()) << "part of a name";
  EXPECT_TRUE(fix({"other.yaml", 3, 15}, {"", {"Sorce", "Source"}}).is_null());
  EXPECT_TRUE(fix({"wave.yaml", 30, 1}, {"", {"Sorce", "Source"}}).is_null());
  EXPECT_TRUE(fix({"<command line>", 0, 0}, {"", {"Sorce", "Source"}}).is_null());
}

}  // namespace
}  // namespace armature::inspect
