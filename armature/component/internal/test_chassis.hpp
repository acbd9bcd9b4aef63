// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests: a component with a state machine in which nothing is missing.

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"
#include "armature/testing/test_thread.hpp"

namespace armature::component {

using namespace std::chrono_literals;

/// A chassis that moves in three phases; notes each action.
class Chassis : public Component {
 public:
  using Component::Component;

  OperationTrigger drive{this, "drive", "starts to move"};
  OperationTrigger halt{this, "halt", "brakes"};
  Event<> bumped{this, "bumped", "it touched something"};
  Trigger repair{"repair"};
  Trigger restart{"restart"};
  Trigger ping{"ping"};
  Trigger resume{"resume"};
  StateMachine mode{
      this,
      "mode",
      "what the chassis is doing",
      in_state("Idle", "brakes applied", entering<&Chassis::enter_idle>,
               leaving<&Chassis::leave_idle>,
               on(drive, guarded_by<&Chassis::is_free>, doing<&Chassis::release>, to("Moving")),
               on(drive, doing<&Chassis::complain>),  //
               on(resume, back_to("Moving")), on(ping, doing<&Chassis::pong>)),
      in_state("Moving", entering<&Chassis::enter_moving>, during<&Chassis::while_moving>,
               leaving<&Chassis::leave_moving>, on(halt, to("Idle")), on(bumped, to("Broken")),
               on(restart, to("Moving")), after(10ms, to("Idle")), when_done(to("Idle")),
               on(ping, doing<&Chassis::outer_pong>),
               in_state("Accelerating", entering<&Chassis::enter_accelerating>,
                        during<&Chassis::while_accelerating>, leaving<&Chassis::leave_accelerating>,
                        when<&Chassis::at_speed>(to("Cruising")), on(ping, doing<&Chassis::pong>)),
               in_state("Cruising", entering<&Chassis::enter_cruising>,
                        leaving<&Chassis::leave_cruising>,
                        when<&Chassis::near_goal>(to("Decelerating")), on(restart, to("Cruising"))),
               in_state("Decelerating", when<&Chassis::at_rest>(to("Arrived"))),
               in_state("Arrived", final_state)),
      in_state("Broken", on(repair, to("Moving/Cruising")))};

  std::vector<std::string> log;
  bool free = true;
  bool fast = false;
  bool near = false;
  bool rest = false;
  std::function<void(const std::string&)> then;

  std::vector<std::string> take_log() { return std::exchange(log, {}); }

 private:
  void note(const std::string& what) {
    log.push_back(what);
    if (then) then(what);
  }
  bool is_free() const { return free; }
  bool at_speed() { return fast; }
  bool near_goal() noexcept { return near; }
  bool at_rest() const noexcept { return rest; }
  void release() { note("release"); }
  void complain() { note("complain"); }
  void pong() { note("pong"); }
  void outer_pong() { note("outer pong"); }
  void enter_idle() { note("+Idle"); }
  void leave_idle() { note("-Idle"); }
  void enter_moving() { note("+Moving"); }
  void while_moving() { note("Moving"); }
  void leave_moving() { note("-Moving"); }
  void enter_accelerating() { note("+Accelerating"); }
  void while_accelerating() { note("Accelerating"); }
  void leave_accelerating() { note("-Accelerating"); }
  void enter_cruising() { note("+Cruising"); }
  void leave_cruising() { note("-Cruising"); }
  void on_update() override { note("update"); }
};

class Machine : public testing::Test {
 protected:
  Machine() : thread_(chassis_) {
    thread_.context.supervisor = &supervisor_;
    start(chassis_);
    chassis_.log.clear();
  }
  /// One cycle; what was done in it.
  std::vector<std::string> step(base::Duration duration = 1ms) {
    thread_.cycle(duration);
    Host::update(chassis_);
    return chassis_.take_log();
  }
  std::string_view path() { return chassis_.mode.path(); }

  Chassis chassis_{"chassis"};
  TestSupervisor supervisor_;
  TestThread thread_;
};

}  // namespace armature::component
