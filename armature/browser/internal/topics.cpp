// SPDX-License-Identifier: Apache-2.0
// The commands of the task browser and the functions of its Lua, as help and completion know
// them.
#include <algorithm>

#include "armature/browser/internal/vocabulary.hpp"

namespace armature::browser::internal {
namespace {

std::vector<Topic> lua_examples() {
  return {{"", "Joint1.Position", "shows a property, attribute or port with its unit", ""},
          {"", "Joint1.GearRatio = 0.02", "sets a property", ""},
          {"", "Generator:moveTo(array(1.0, 1.0), 10)",
           "calls an operation or begins a command; `wait` waits for its end", ""},
          {"", "for i = 1, 3 do print(i) end", "runs any Lua; Ctrl-C interrupts it", ""}};
}

std::vector<Topic> lua_commands() {
  return {
      {"ls", "ls [COMPONENT ...]",
       "lists the components and state machines, or one component with its values",
       "ls\nls Joint1\n`list` is the same."},
      {"help", "help [WHAT]", "explains a command, a function, a component or a member of one",
       "help watch\nhelp moveTo\nhelp Joint1\nhelp Joint1.Position\nhelp Generator:moveTo"},
      {"watch", "watch ITEM ... [every SECONDS] [for SECONDS]",
       "shows values as they change, until a key",
       "In simulated time, and without a terminal, it lets time pass and writes a line for each "
       "step: ten unless `for` sets a time.\n"
       "watch Joint1.Position Joint2.Position every 0.2\n"
       "watch Sensor.sensor[1] every 0.01 for 1"},
      {"threads", "threads",
       "lists how often each thread ran, how long its cycles take, and its load", ""},
      {"faults", "faults", "lists the components that do not run, and why", ""},
      {"log", "log [COUNT]", "shows the newest lines of the log, 20 unless told otherwise",
       "log 100\nThe newest 200 lines are kept, also of an application that another process runs."},
      {"start", "start [COMPONENT ...]", "starts a component, configuring it first if necessary",
       "start Joint1\nWithout a name: every component that does not run, writers before readers, "
       "except those that the deployment does not start."},
      {"stop", "stop COMPONENT ...", "stops a component; `quit` stops the application",
       "stop Joint1"},
      {"reset", "reset [COMPONENT ...]", "takes a component out of its exception, to stopped",
       "reset Joint1\nstart Joint1\nWithout a name: every component that is in an exception."},
      {"recover", "recover [COMPONENT ...]",
       "takes a component out of its run-time error, to running",
       "recover Joint1\nWithout a name: every component that is in an error."},
      {"cleanup", "cleanup COMPONENT ...",
       "clears the configuration of a stopped component; `start` configures it again",
       "reset WAM\ncleanup WAM\nstart WAM"},
      {"run", "run SECONDS", "lets simulated time pass; in real time the same as wait",
       "run 5\nCtrl-C ends it early."},
      {"wait", "wait [SECONDS]", "waits that long, or until the commands begun here have ended",
       "Generator:moveTo(array(1.0, 1.0), 10)\nwait\n"
       "Ctrl-C cancels the commands; a second one ends the waiting. As a function it takes a "
       "command, an event or a machine: wait(motion) is true, or false and why."},
      {"pace", "pace [RATE | most | pause | step | go]", "how simulated time passes",
       "pace 0.1: a tenth of real time\npace most: as fast as possible\npace pause\n"
       "pace step: to the next cycle of a paused run\npace go: on, as before the pause"},
      {"cancel", "cancel", "cancels the commands that are under way",
       "Those that were begun here. One alone: motion:cancel()."},
      {"quit", "quit", "stops the application in order; also Ctrl-D, exit, stop()", ""}};
}

std::vector<Topic> lua_functions() {
  return {
      {"at", "at(seconds, function)", "calls a function at a time, counted from the start",
       "at(now() + 5, function() Generator:moveTo(array(1, 1), 10) end)"},
      {"on", "on(event, function)", "calls a function each time that an event is raised",
       "watching = on(Arming.Stop, function() print(now()) end)\nwatching:cancel()"},
      {"machine", "machine {...}", "defines a state machine",
       "m = machine {initial = \"Idle\", Idle = {on = {go = \"Moving\"}}, Moving = {after = {5, "
       "\"Idle\"}}}\nm:start()\nm:send(\"go\")\nm.state\nm:stop()"},
      {"now", "now()", "seconds since the start", ""},
      {"stop", "stop()", "stops the application in order", ""},
      {"print", "print(...)", "writes a line", "print(Joint1.Position, Joint2.Position)"},
      {"array", "array(...)", "a list: array(1, 2) is {1, 2}", ""},
      {"require", "require(\"name\")", "runs name.lua in the working directory, once", ""},
      {"done", "motion:done()", "whether a command has ended in any way",
       "motion = Generator:moveTo(array(1, 1), 10)\nmotion:done()"},
      {"progress", "motion:progress()", "how far a command has come, 0 to 1", ""},
      {"reason", "motion:reason()", "why a command failed or was cancelled, else \"\"", ""}};
}

std::vector<Topic> plain_examples() {
  return {{"", "Joint1.Position", "shows a property, attribute or port with its unit", ""},
          {"", "PID1.Kp = 300", "sets a property; also in another unit, PID1.UMax = 6000 mV", ""},
          {"", "Generator:moveTo({1.0, 1.0}, 10)",
           "calls an operation or begins a command; `wait` waits for its end", ""}};
}

/// What needs no Lua is the same as in the application's own process.
std::vector<Topic> plain_commands() {
  std::vector<Topic> all;
  for (const Topic& topic : lua_commands()) {
    const bool other = topic.name == "watch" || topic.name == "stop" || topic.name == "run" ||
                       topic.name == "wait" || topic.name == "quit";
    if (!other) all.push_back(topic);
  }
  all.push_back({"watch", "watch ITEM ... [every SECONDS] [for SECONDS]",
                 "shows values as they change, until a key",
                 "Without a terminal it writes a line for each step: ten unless `for` sets a "
                 "time.\nwatch Joint1.Position Joint2.Position every 0.2"});
  all.push_back({"stop", "stop COMPONENT ...", "stops a component", "stop Joint1"});
  all.push_back({"wait", "wait [SECONDS]",
                 "waits that long, or until the commands begun here have ended",
                 "Generator:moveTo({1.0, 1.0}, 10)\nwait\n"
                 "Ctrl-C cancels the commands; a second one ends the waiting."});
  all.push_back({"quit", "quit", "leaves; the application goes on; also Ctrl-D, exit", ""});
  return all;
}

}  // namespace

bool Vocabulary::has_command(std::string_view name) const {
  return std::ranges::find(commands, name, &Topic::name) != commands.end();
}

const Vocabulary& plain_vocabulary() {
  static const Vocabulary vocabulary{
      .heading = "Values and calls",
      .examples = plain_examples(),
      .commands = plain_commands(),
      .functions = {},
      .methods = {},
      .quitting = "leaves",
      .in_names = "_.:-",
  };
  return vocabulary;
}

const Vocabulary& lua_vocabulary() {
  static const Vocabulary vocabulary{
      .heading = "Values and calls (Lua 5.4)",
      .examples = lua_examples(),
      .commands = lua_commands(),
      .functions = lua_functions(),
      .methods = {"cancel()", "done()", "is_in(", "progress()", "reason()", "send(", "start()",
                  "stop()"},
      .quitting = "stops the application",
      .in_names = "_.:",
  };
  return vocabulary;
}

}  // namespace armature::browser::internal
