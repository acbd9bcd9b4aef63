// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/check_service.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "armature/component/author.hpp"

namespace armature::cli {
namespace {

using component::Component;
using nlohmann::json;
using ::testing::HasSubstr;

class Source final : public Component {
 public:
  using Component::Component;

 private:
  component::Property<double> gain_{this, "Gain", 0.5, "of the loop", "V/rad"};
  component::OutputPort<double> out_{this, "Out", "where it is", "rad"};
};

class Sink final : public Component {
 public:
  using Component::Component;

 private:
  void take(double) {}
  component::InputPort<double> in_{this, "In", "an angle", "rad", component::on_data<&Sink::take>};
};

constexpr const char* kWave =
    "application: wave\n"
    "components:\n"
    "  Source: {model: Source, activity: {periodic: 10 ms}, properties: {Gain: 0.25}}\n"
    "  Sink: {model: Sink}\n"
    "connections: [Source.Out -> Sink.In]\n";

class CheckServiceTest : public testing::Test {
 protected:
  json ask(const json& request) { return json::parse(service_.answer(request.dump())); }

  json check(const std::string& text) {
    return ask(
        {{"id", 7}, {"do", "check"}, {"file", "wave.yaml"}, {"texts", {{"wave.yaml", text}}}});
  }

  static deploy::Deployment load(const LoadArguments& arguments, deploy::FileReader read) {
    deploy::DeploymentOptions options;
    options.document.read = std::move(read);
    options.document.overrides = arguments.overrides;
    options.models = [](component::Registry& registry) {
      registry.add<Source>("Source", "writes");
      registry.add<Sink>("Sink", "reads");
    };
    return deploy::load_deployment(arguments.file, options);
  }

  CheckService service_{{}, load};
};

TEST_F(CheckServiceTest, ChecksATextThatIsNotSaved) {
  const json answer = check(kWave);
  EXPECT_EQ(answer["id"], 7);
  EXPECT_EQ(answer["result"]["ok"], true) << answer;
  EXPECT_EQ(answer["result"]["components"][0]["properties"][0]["value"], "0.25");
}

TEST_F(CheckServiceTest, FindsMistakesWithTheirFix) {
  std::string text = kWave;
  text.replace(text.find("-> Sink.In"), 10, "-> Sinc.In");
  const json answer = check(text);
  EXPECT_EQ(answer["result"]["ok"], false);
  const json found = answer["result"]["diagnostics"][0];
  EXPECT_THAT(found["message"].get<std::string>(), HasSubstr("unknown component 'Sinc'"));
  EXPECT_EQ(found["fix"]["found"], "Sinc");
  EXPECT_EQ(found["fix"]["by"], "Sink");
  EXPECT_EQ(found["fix"]["line"], 5);
}

TEST_F(CheckServiceTest, TakesOverridesAsTheCommandLineDoes) {
  const json answer = ask({{"id", 1},
                           {"do", "check"},
                           {"file", "wave.yaml"},
                           {"texts", {{"wave.yaml", kWave}}},
                           {"set", {"Source.Gain=2"}}});
  EXPECT_EQ(answer["result"]["components"][0]["properties"][0]["value"], "2");
}

TEST_F(CheckServiceTest, SaysWhatFitsInTheDeploymentCheckedLast) {
  std::string text = kWave;
  text.resize(text.find("connections:"));
  check(text);
  const json answer = ask(
      {{"id", 2}, {"do", "fitting"}, {"component", "Source"}, {"member", "Out"}, {"models", true}});
  EXPECT_EQ(answer["result"]["ends"],
            (json::array({{{"component", "Sink"}, {"member", "In"}, {"kind", "input"}}})));
  EXPECT_EQ(answer["result"]["models"][0]["component"], "Sink");
}

TEST_F(CheckServiceTest, RefusesWhatItDoesNotUnderstandAndGoesOn) {
  EXPECT_EQ(json::parse(service_.answer("{\"id\": 1"))["error"],
            "expected a JSON object on one line");
  EXPECT_EQ(ask({{"id", "x"}, {"do", "chek"}})["error"],
            "unknown act 'chek' (did you mean 'check'?)");
  EXPECT_EQ(ask({{"id", 3}, {"do", 5}})["id"], 3);
  EXPECT_THAT(ask({{"id", 1}, {"do", 5}})["error"].get<std::string>(),
              HasSubstr("has the wrong type"));
  EXPECT_THAT(ask({{"id", 1}, {"do", "fitting"}})["error"].get<std::string>(),
              HasSubstr("nothing was checked yet"));
  EXPECT_EQ(check(kWave)["result"]["ok"], true);
}

TEST_F(CheckServiceTest, AnswersOnOneLine) {
  const std::string answer = service_.answer(json{
      {"id", "a\nb"},
      {"do", "check"},
      {"file", "w.yaml"},
      {"texts", {{"w.yaml", "a:\n\tb"}}}}.dump());
  EXPECT_EQ(std::count(answer.begin(), answer.end(), '\n'), 1);
  EXPECT_EQ(json::parse(answer)["id"], "a\nb");
}

}  // namespace
}  // namespace armature::cli
