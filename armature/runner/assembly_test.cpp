// SPDX-License-Identifier: Apache-2.0
#include "armature/runner/assembly.hpp"

#include <chrono>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/interface.hpp"
#include "armature/exec/event_command.hpp"
#include "armature/runner/fingerprint.hpp"

namespace armature::runner {

enum class Side : std::uint8_t { kLeft, kRight };
ARMATURE_ENUM(Side, kLeft, kRight);

namespace {

using namespace component;
using namespace std::chrono_literals;
using ::testing::HasSubstr;

class Lift final : public Component {
 public:
  using Component::Component;

 private:
  Outcome go(double, Side) { return accepted(); }
  Outcome dance() { return accepted(); }
  void look() {}

  Property<double> gain_{this, "Gain", 1.0, "", "", range(0.0, 10.0)};
  Property<Side> side_{this, "Side", Side::kLeft, ""};
  Property<std::string> file_{this, "File", "", ""};
  InputPort<double> in_{this, "In", "", "", may_stay_open};
  OutputPort<double> out_{this, "Out", ""};
  Event<double> arrived_{this, "Arrived", "", occasional, {"place"}};
  Command<double, Side> go_{this, "go", serve<&Lift::go>, "", args("place", "side")};
  Command<> dance_{this, "dance", serve<&Lift::dance>, "", by_operator};
  Operation<void()> look_{this, "look", serve<&Lift::look>, ""};
};

class AssemblyTest : public ::testing::Test {
 protected:
  AssemblyTest() { models_.add<Lift>("Lift", "goes up"); }

  /// What is wrong; empty if nothing.
  std::string mistakes() const { return assembly_.mistakes().to_text(); }
  const exec::ComponentEntry& entry(std::size_t index) const {
    return assembly_.blueprint().components.at(index);
  }

  Registry models_;
  Assembly assembly_{models_};
};

TEST_F(AssemblyTest, MakesTheBlueprintThatItIsTold) {
  assembly_.name("tower");
  assembly_.component("A", "Lift")
      .activity(exec::Activity::periodic(10ms, 50))
      .set("Gain", 2.5)
      .set_text("Side", "right")
      .set("File", "out.csv")
      .peer("B")
      .bind("Needs", "B", "look")
      .autostart(false);
  assembly_.component("B", "Lift").autoconfigure(false);
  assembly_.connect("A.Out", "B.In", {.one_cycle_delay = true})
      .max_age(20ms, Reaction::kHold)
      .on_lost(Reaction::kZero);
  EXPECT_EQ(mistakes(), "");
  EXPECT_EQ(outline(assembly_.blueprint(), assembly_.options()),
            "application tower\n"
            "component A model Lift activity periodic 10 ms realtime 50 skip 5 0 s thread '' cpus"
            " no autostart\n"
            "  peer B\n"
            "  bind Needs to B.look\n"
            "  double Gain = 2.5\n"
            "  Side Side = right\n"
            "  text File = out.csv\n"
            "component B model Lift activity sequential 0 s other 0 skip 5 0 s thread '' cpus"
            " no autoconfigure\n"
            "  double Gain = 1\n"
            "  Side Side = left\n"
            "  text File = \n"
            "connect A.Out to B.In latest delayed max_age 20 ms hold on_lost zero\n"
            "begins in mode ''\n"
            "on fault stop_dependents\n"
            "hold at stop 60 s\n"
            "black box 2 s 65536\n");
}

TEST_F(AssemblyTest, MakesWhatGivesACommandForAnEvent) {
  assembly_.component("A", "Lift");
  assembly_.component("B", "Lift");
  assembly_.command({.name = "Follow", .on = "A.Arrived", .give = "B.go", .max_age = 1s},
                    {member(0), text_constant("right")});
  EXPECT_EQ(mistakes(), "");
  ASSERT_EQ(assembly_.blueprint().components.size(), 3u);
  EXPECT_THAT(outline(assembly_.blueprint(), assembly_.options()),
              HasSubstr("  bind On to A.Arrived\n  bind Do to B.go\n"));
  const auto& command = dynamic_cast<const exec::EventCommand&>(*entry(2).component);
  EXPECT_EQ(command.max_age(), 1s);
  EXPECT_EQ(command.parameters().at(1).constant->text(), "right");
  assembly_.command({.name = "Other", .on = "A.Arrived", .give = "B.go"},
                    {port("place", "A.Out"), text_constant("left")});
  EXPECT_EQ(mistakes(), "");
}

TEST_F(AssemblyTest, CollectsMistakesByName) {
  assembly_.component("A", "Lift")
      .set("Gain", 3)
      .set("Gain", 11.0)
      .set("Grain", 1.0)
      .set_text("Side", "middle");
  assembly_.component("B", "Loft").set("Gain", 1.0).peer("A");
  for (const char* text :
       {"'A.Gain' is of type double, found a int32", "'A.Gain': ", "unknown property 'A.Grain'",
        "'A.Side': ", "'B' has the unknown model 'Loft' (did you mean 'Lift'?)"}) {
    EXPECT_THAT(mistakes(), HasSubstr(text));
  }
  EXPECT_EQ(assembly_.blueprint().components.size(), 1u);
}

TEST_F(AssemblyTest, LetsNoEventDoWhatIsTheOperatorsOrNoCommand) {
  assembly_.component("A", "Lift");
  assembly_.command({.name = "X", .on = "A.Arrived", .give = "A.dance"});
  assembly_.command({.name = "Y", .on = "A.Arrived", .give = "A.look"});
  EXPECT_THAT(mistakes(), HasSubstr("'A.dance' is no command that an event may give"));
  EXPECT_THAT(mistakes(), HasSubstr("'A.look' is no command that an event may give"));
  assembly_.command({.name = "Z", .on = "A.Arrived", .give = "A.go"}, {member(0)});
  EXPECT_THAT(mistakes(), HasSubstr("'A.go' takes 2 parameters, found 1"));
  assembly_.command({.name = "Z", .on = "A.Arrived", .give = "A.go"}, {member(1), member(0)});
  EXPECT_THAT(mistakes(), HasSubstr("the event's member 1 is no double"));
  EXPECT_EQ(assembly_.blueprint().components.size(), 1u);
}

TEST_F(AssemblyTest, ItsFingerprintChangesWithEverythingButTheGrants) {
  assembly_.component("A", "Lift").set("Gain", 2.0);
  const auto print = [&] { return fingerprint(assembly_.blueprint(), assembly_.options()); };
  const std::uint64_t first = print();
  assembly_.options().grants.push_back({exec::Caller::kScript, "A", "dance"});
  EXPECT_EQ(print(), first);
  assembly_.options().before_stop.push_back({"A", "dance"});
  const std::uint64_t second = print();
  EXPECT_NE(second, first);
  assembly_.connect("A.Out", "A.In");
  EXPECT_NE(print(), second);
}

}  // namespace
}  // namespace armature::runner
