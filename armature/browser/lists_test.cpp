// SPDX-License-Identifier: Apache-2.0
// What the task browser lists and explains, to the letter.
#include "armature/browser/internal/help.hpp"
#include "armature/browser/internal/test_screen.hpp"

namespace armature::browser::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Listing, HasEveryComponent) {
  Desk desk;
  EXPECT_EQ(desk.type("ls"),
            "component         model     state    thread\n"
            "Axis              Axis      Running  Axis\n"
            "Settings          Settings  Running  Settings\n"
            "left.hand.Finger  Settings  Running  service\n"
            "aic-1             Settings  Running  service");
  EXPECT_EQ(desk.type("list"), desk.type("ls"));
}

TEST(Listing, HasEveryStateMachine) {
  Desk desk;
  desk.type(
      "m = machine {name = 'Work', initial = 'Idle', Idle = {on = {go = 'Moving'}}, "
      "Moving = {after = {0.5, 'Idle'}}}");
  EXPECT_THAT(desk.type("ls"), HasSubstr("\nmachine  state\nWork     not running"));
  desk.type("m:start()");
  EXPECT_EQ(desk.type("m:send('go')"), "true");
  EXPECT_THAT(desk.type("ls"), HasSubstr("\nWork     Moving"));
  desk.type("run 0.6");
  EXPECT_EQ(desk.type("m"), "machine 'Work' (Idle)");
}

TEST(Listing, OfAComponentHasItsValues) {
  Desk desk;
  desk.type("run 0.01");
  EXPECT_EQ(desk.type("ls Settings"),
            "Settings: Settings, Running, in thread Settings (every 10 ms)\n"
            "property   Loud     false\n"
            "property   Count    3\n"
            "property   Byte     0\n"
            "property   Gain     2.5 V/rad\n"
            "property   Fixed    1\n"
            "property   Label    \"left\"\n"
            "property   Offsets  [0.5, -1] rad\n"
            "property   Limits   [1, 2, 3]\n"
            "property   Stance   free\n"
            "property   Gains    {kp: 0 V/rad, steps: 1}\n"
            "attribute  Calls    0\n"
            "operations  sum, twice, fail");
  EXPECT_EQ(desk.type("ls Axis"),
            "Axis: Axis, Running, in thread Axis (every 10 ms)\n"
            "output  Position  0 m\n"
            "output  Both      [0, -0] m\n"
            "commands    moveTo, arm");
  EXPECT_EQ(desk.type("Axis"), desk.type("ls Axis"));
  EXPECT_EQ(desk.type("ls aic-1"), desk.type("ls \"aic-1\""));
}

TEST(Listing, OfPortsThatNobodyWroteSaysSo) {
  Desk desk;
  EXPECT_EQ(desk.type("stop Axis\nls Axis"),
            "Axis: Stopped\n"
            "Axis: Axis, Stopped, in thread Axis (every 10 ms)\n"
            "output  Position  not yet written\n"
            "output  Both      not yet written\n"
            "commands    moveTo, arm");
}

TEST(Listing, OfFaultsSaysWhoAndWhy) {
  Desk desk;
  desk.bench.application().run_in_thread_of(desk.bench.axis(),
                                            [&] { desk.bench.axis().fault("it is on fire"); });
  EXPECT_EQ(desk.type("faults"),
            "Axis  Exception  it is on fire\n"
            "1 fault and 0 declared reactions since the start");
  EXPECT_THAT(desk.type("ls Axis"), HasSubstr("it is on fire"));
  EXPECT_EQ(desk.type("reset\nstart Axis"), "Axis: Stopped\nAxis: Running");
}

TEST(Listing, OfThreadsCountsTheirCycles) {
  Desk desk;
  desk.type("run 1");
  EXPECT_THAT(desk.type("threads"), HasSubstr("Axis, every 10 ms, 1 component\n"
                                              "  100 cycles, 0 skipped; a cycle takes "));
}

TEST(Help, ExplainsAComponent) {
  Desk desk;
  desk.type("run 0.01");
  EXPECT_EQ(desk.type("help Axis"),
            "Axis: Axis, Running, in thread Axis\n"
            "Outputs\n"
            "  Position = 0 m\n"
            "      where it is; double; not connected\n"
            "  Both = [0, -0] m\n"
            "      there and back; array<double,2>; not connected\n"
            "Commands\n"
            "  Axis:moveTo(target [m])\n"
            "      goes there; takes double; a command: it goes on after it was accepted\n"
            "  Axis:arm()\n"
            "      lets it move; a command: it goes on after it was accepted; an act of the\n"
            "      operator");
}

TEST(Help, ExplainsAMember) {
  Desk desk;
  desk.type("run 0.01");
  EXPECT_EQ(desk.type("help Axis.Position"),
            "Axis.Position = 0 m, 0 ms old\n"
            "      where it is; double; not connected\n"
            "  type:\n"
            "      Axis.Position\n"
            "      watch Axis.Position every 0.2");
  EXPECT_EQ(desk.type("help Settings.Count"),
            "Settings.Count = 3\n"
            "      how many; int32; 0 to 10; may change while it runs\n"
            "  type:\n"
            "      Settings.Count\n"
            "      Settings.Count = ...");
  EXPECT_EQ(desk.type("help Axis:arm"),
            "Axis:arm()\n"
            "      lets it move; a command: it goes on after it was accepted; an act of the\n"
            "      operator");
  EXPECT_EQ(desk.type("Axis:arm"), desk.type("help Axis:arm"));
  EXPECT_EQ(desk.type("help aic-1:sum"),
            "_G[\"aic-1\"]:sum(values [rad], factor)\n"
            "      adds them up; takes vector<double>, double; gives double");
}

TEST(Help, ExplainsCommandsFunctionsAndOperationsByTheirName) {
  Desk desk;
  EXPECT_EQ(desk.type("help run"),
            "run SECONDS\n"
            "      lets simulated time pass; in real time the same as wait\n"
            "      run 5\n"
            "      Ctrl-C ends it early.");
  EXPECT_THAT(desk.type("help at"), HasSubstr("at(seconds, function)"));
  EXPECT_THAT(desk.type("help moveTo"), HasSubstr("Axis:moveTo(target [m])"));
}

TEST(Help, KnowsEveryCommand) {
  Desk desk;
  const std::string overview = desk.type("help");
  for (const internal::Topic& topic : internal::lua_vocabulary().commands) {
    EXPECT_THAT(overview, HasSubstr(std::string(topic.usage)));
    EXPECT_THAT(desk.type("help " + std::string(topic.name)), Not(HasSubstr("error: ")));
    EXPECT_THAT(desk.type(std::string(topic.name) + " ]"), Not(HasSubstr("syntax")))
        << "it is a command";
  }
}

TEST(Help, FitsIntoNarrowTerminals) {
  Desk desk;
  for (const std::size_t width : {60u, 80u}) {
    desk.screen.width = width;
    for (const char* line :
         {"help", "help Axis", "help Settings", "ls Settings", "threads", "help watch", "ls"}) {
      std::string text = desk.type(line);
      for (std::size_t end = 0; !text.empty(); text.erase(0, end + 1)) {
        end = std::min(text.find('\n'), text.size());
        EXPECT_LE(end, width) << line << ": " << text.substr(0, end);
      }
    }
  }
}

TEST(Listing, IsColouredOnlyWhereThatIsWanted) {
  Desk desk;
  EXPECT_THAT(desk.type("ls"), Not(HasSubstr("\x1b")));
  desk.screen.colour = true;
  EXPECT_THAT(desk.type("ls"), HasSubstr("\x1b[32mRunning\x1b[0m"));
}

}  // namespace
}  // namespace armature::browser::test
