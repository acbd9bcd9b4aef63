// SPDX-License-Identifier: Apache-2.0
// What is wrong with the definition of a state machine, all at once, with its line.
#include "armature/lua/internal/test_bench.hpp"

namespace armature::lua::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Mistake {
  const char* states;
  const char* text;
};

class DefinitionWith : public ::testing::TestWithParam<Mistake> {};

TEST_P(DefinitionWith, AMistakeIsRefusedWithItsLine) {
  Bench bench;
  EXPECT_EQ(bench.run(std::string("local other = 1\nlocal m = machine {\n  name = 'Work',\n") +
                      GetParam().states + "\n}\n"),
            std::string("robot.lua:2: error: machine 'Work'") + GetParam().text + "\n");
  EXPECT_EQ(bench.ended(), exec::RunEnd::kStopRequested);
}

INSTANTIATE_TEST_SUITE_P(
    Each, DefinitionWith,
    ::testing::Values(
        Mistake{"", ": it has no states"},
        Mistake{"Idle = true", ": state 'Idle' must be a table, found true"},
        Mistake{"Idle = {}, 5", ": 1 of its values have no name"},
        Mistake{"idle = {}, Moving = {}",
                ": 'idle' is not a key here (known: doc, initial, name, period); names of states "
                "begin with a capital letter"},
        Mistake{"A = {}, B = {on = {go = 'A'}}",
                ": initial is missing: which of its states comes first, A, B?"},
        Mistake{"initial = 'Movin', Idle = {on = {go = 'Moving'}}, Moving = {}",
                ": initial: unknown state 'Movin' (did you mean 'Moving'?)"},
        Mistake{"initial = 'Idle', Idle = {on = {go = 'Moveing'}}, Moving = {}",
                ": state 'Idle': on 'go': unknown state 'Moveing' to go to from here (did you "
                "mean 'Moving'?)"},
        Mistake{"initial = 'Idle', Idle = {}, Moving = {}", ": state 'Moving' is never entered"},
        Mistake{"Idle = {enrty = print}",
                ": state 'Idle': 'enrty' is not a key here (did you mean 'entry'?); names of "
                "states begin with a capital letter"},
        Mistake{"Idle = {entry = 5}", ": state 'Idle': entry must be a function, found 5"},
        Mistake{"Idle = {final = 'yes'}", ": state 'Idle': final must be true, found 'yes'"},
        Mistake{"Idle = {on = 'go'}",
                ": state 'Idle': on must be a table, on = {go = \"Moving\"}, found 'go'"},
        Mistake{"Idle = {on = {[5] = 'Idle'}}",
                ": state 'Idle': on takes events and texts: {[Arming.Stop] = \"Idle\", go = "
                "\"On\"}"},
        Mistake{"Idle = {on = {done = 'Idle'}}",
                ": state 'Idle': 'done' stands beside on, not in it"},
        Mistake{"Idle = {on = {go = 5}}",
                ": state 'Idle': on 'go': must be \"Idle\", a function, or {\"Idle\", guard = ..., "
                "action = ...}, found 5"},
        Mistake{"Idle = {on = {go = {'Idle', gaurd = print}}}",
                ": state 'Idle': on 'go': 'gaurd' is not a key here (did you mean 'guard'?)"},
        Mistake{"Idle = {on = {go = {'Idle', guard = 5}}}",
                ": state 'Idle': on 'go': guard must be a function, found 5"},
        Mistake{"Idle = {on = {go = {{'Idle'}, {'Idle', guard = print}}}}",
                ": state 'Idle': on 'go'[2]: it is never taken: the one before it always is"},
        Mistake{"Idle = {after = 'Idle'}",
                ": state 'Idle': after: must be {5.0, \"Idle\"}, found 'Idle'"},
        Mistake{"Idle = {after = {'soon', 'Idle'}}",
                ": state 'Idle': after: must begin with a number of seconds above 0, {5.0, "
                "\"Idle\"}, found 'soon'"},
        Mistake{"Idle = {after = {0, 'Idle'}}",
                ": state 'Idle': after: must begin with a number of seconds above 0, {5.0, "
                "\"Idle\"}, found 0"},
        Mistake{"Idle = {after = {{1, 'Idle'}, {2, 'Idle'}}}",
                ": state 'Idle': after[2]: it is never taken: the one before it always is"},
        Mistake{"Idle = {after = {5}}",
                ": transition 'Idle after 5000 ms': it needs a target state; put what happens all "
                "the time into `during`"},
        Mistake{"Idle = {when = 'Idle'}",
                ": state 'Idle': when: must be {function() return ... end, \"Idle\"}, found "
                "'Idle'"},
        Mistake{"Idle = {when = {5, 'Idle'}}",
                ": state 'Idle': when: must begin with a function, {function() return ... end, "
                "\"Idle\"}, found 5"},
        Mistake{"Idle = {done = 'Idle'}",
                ": transition 'Idle -> Idle when done': state 'Idle' has no final substate, so it "
                "is never done"},
        Mistake{"Idle = {run = print, Inner = {}}",
                ": state 'Idle': only a state without substates may have run"},
        Mistake{"Idle = {run = print, final = true}", ": state 'Idle': a final state has no run"},
        Mistake{"Idle = {final = true, on = {go = 'Idle'}}",
                ": transition 'Idle -> Idle on go': a final state is never left"},
        Mistake{"Idle = {on = {go = {back_to = 'Idle'}}}",
                ": transition 'Idle -> back to Idle on go': state 'Idle' has no substates to go "
                "back to"},
        Mistake{"period = 0, Idle = {}",
                ": period must be a number of seconds from 0.001 on, found 0"},
        Mistake{"period = 'often', Idle = {}",
                ": period must be a number of seconds from 0.001 on, found 'often'"}));

TEST(Definition, TellsAllItsMistakesAtOnce) {
  Bench bench;
  EXPECT_EQ(bench.run("machine {\n"
                      "  Idle = {on = {go = 'Movin'}, entry = 5},\n"
                      "  Moving = {after = {-1, 'Idle'}, Out = {run = 'x'}},\n"
                      "}"),
            "robot.lua:1: error: machine 'machine' has 5 mistakes:\n"
            "  initial is missing: which of its states comes first, Idle, Moving?\n"
            "  state 'Idle': entry must be a function, found 5\n"
            "  state 'Moving': after: must begin with a number of seconds above 0, {5.0, "
            "\"Idle\"}, found -1\n"
            "  state 'Moving/Out': run must be a function, found 'x'\n"
            "  state 'Idle': on 'go': unknown state 'Movin' to go to from here (did you mean "
            "'Moving'?)\n");
}

TEST(Definition, ThatContainsItselfIsRefused) {
  Bench bench;
  EXPECT_THAT(bench.run("local a = {} a.A = a\nmachine {A = a}"),
              HasSubstr("is one too many: a machine has at most 1000, nested at most 32 deep"));
}

TEST(Definition, OfTooManyStatesIsRefused) {
  Bench bench;
  EXPECT_THAT(bench.run("local all = {initial = 'S1'}\n"
                        "for i = 1, 1001 do all['S' .. i] = {} end\nmachine(all)"),
              HasSubstr("'S999' is one too many"));
}

TEST(Definition, OfTooManyTransitionsIsRefused) {
  Bench bench;
  EXPECT_THAT(
      bench.run("local all = {}\n"
                "for i = 1, 100000 do all[i] = {'A', guard = function() end} end\n"
                "machine {A = {on = {go = all}}}"),
      HasSubstr("on 'go'[5001]: it is one too many: a machine has at most 5000 transitions"));
}

TEST(Definition, WithMoreMistakesThanAnybodyReadsTellsTheFirst) {
  Bench bench;
  EXPECT_THAT(bench.run("local all = {}\n"
                        "for i = 1, 100000 do all[i] = 'Nowhere' end\n"
                        "machine {A = {on = {go = all}}}"),
              HasSubstr("has 30 mistakes"));
}

TEST(Definition, OfTooManyMachinesIsRefused) {
  Bench bench;
  EXPECT_EQ(bench.run("for i = 1, 101 do machine {A = {}} end"),
            "robot.lua:1: error: a script has at most 100 machines: start one of them again "
            "instead of defining another\n");
}

class Using : public ::testing::TestWithParam<Mistake> {};

TEST_P(Using, AMachineWronglyIsRefusedWithItsLine) {
  Bench bench;
  EXPECT_EQ(bench.run(std::string("local m = machine {name = 'Work', Idle = {on = {go = 'Idle'}}} "
                                  "m:start()\n") +
                      GetParam().states),
            std::string("robot.lua:2: error: ") + GetParam().text + "\n");
}

INSTANTIATE_TEST_SUITE_P(
    Each, Using,
    ::testing::Values(
        Mistake{"machine()",
                "machine takes a table of states: machine {initial = \"Idle\", Idle = {...}}"},
        Mistake{"machine('Work')",
                "machine takes a table of states: machine {initial = \"Idle\", Idle = {...}}"},
        Mistake{"m:start()", "machine 'Work' runs already"},
        Mistake{"m:send('got')",
                "machine 'Work': no state has on = {got = ...} (did you mean 'go'?)"},
        Mistake{"m:send()", "send takes a text, machine:send(\"go\"), found nothing"},
        Mistake{"m:send(5)", "send takes a text, machine:send(\"go\"), found 5"},
        Mistake{"m:is_in('Idel')", "machine 'Work' has no state 'Idel' (did you mean 'Idle'?)"},
        Mistake{"m:stat()", "a machine has no 'stat' (did you mean 'start'?)"},
        Mistake{"m.state = 'Idle'",
                "a machine has nothing to set: send it a text with machine:send(\"go\")"}));

}  // namespace
}  // namespace armature::lua::test
