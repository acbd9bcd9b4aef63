// SPDX-License-Identifier: Apache-2.0
// An event that commands, beside a port that triggers: a cycle in which one component has another
// one do something.
#include <chrono>
#include <stdexcept>
#include <string>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/component/face.hpp"
#include "armature/exec/application.hpp"
#include "armature/exec/event_command.hpp"
#include "benchmarks/simulated.hpp"
#include "benchmarks/suite.hpp"

namespace armature::benchmarks {
namespace {

constexpr std::int64_t kRounds = 301;
constexpr std::chrono::milliseconds kBatch{3};

/// Says the same in each cycle, as an event and on a port.
class Speaker final : public component::Component {
 public:
  using Component::Component;
  component::Event<double> said{this, "Said", "a number", {"number"}};

 private:
  void on_update() override {
    said.raise(1.0);
    number_.write(1.0);
  }
  component::OutputPort<double> number_{this, "Number", "a number"};
};

class Listener final : public component::Component {
 public:
  using Component::Component;
  double sum = 0.0;

 private:
  void hear(double number) { sum += number; }
  component::Outcome add(double number) {
    sum += number;
    add_up.complete();
    return component::accepted();
  }
  component::InputPort<double> number_{this,
                                       "Number",
                                       "a number",
                                       "",
                                       component::on_data<&Listener::hear>,
                                       component::may_stay_open};

 public:
  component::Command<double> add_up{this, "addUp", component::serve<&Listener::add>, "adds up",
                                    component::args("number")};
};

enum class By { kPort, kEvent };

exec::Blueprint speech(By by) {
  exec::Activity one_thread = exec::Activity::periodic(std::chrono::milliseconds(1));
  one_thread.thread = "one";
  exec::Blueprint blueprint;
  Speaker& speaker = blueprint.add<Speaker>("Speaker", one_thread);
  Listener& listener = blueprint.add<Listener>("Listener", one_thread);
  if (by == By::kPort) {
    blueprint.connect("Speaker.Number", "Listener.Number");
    return blueprint;
  }
  exec::ComponentEntry wire;
  wire.component = std::make_unique<exec::EventCommand>(
      "Wire", face(speaker.said), face(listener.add_up), std::vector<component::CallParameter>(1),
      base::Duration::zero());
  wire.bindings = {{std::string(exec::EventCommand::kOn), "Speaker", "Said", {}},
                   {std::string(exec::EventCommand::kDo), "Listener", "addUp", {}}};
  wire.peers = {{"Speaker", {}}, {"Listener", {}}};
  blueprint.components.push_back(std::move(wire));
  return blueprint;
}

class Conversation {
 public:
  explicit Conversation(By by) : application_(speech(by), simulated()) {
    const base::Diagnostics started = application_.start();
    if (!started.ok()) throw std::runtime_error(started.to_text());
  }
  void run(std::int64_t cycles) { application_.run_for(std::chrono::milliseconds(cycles)); }
  double heard() { return static_cast<const Listener&>(*application_.find("Listener")).sum; }

 private:
  exec::Application application_;
};

void run_event_command(benchmark::State& state) {
  Conversation by_event(By::kEvent);
  Conversation by_port(By::kPort);
  publish(state, measure_in_turn(
                     state, [&](std::int64_t cycles) { by_event.run(cycles); },
                     [&](std::int64_t cycles) { by_port.run(cycles); }, kBatch));
  const double missing = by_port.heard() - by_event.heard();
  if (missing < 0.0 || missing > 1.0) state.SkipWithError("not every event gave its command");
}

}  // namespace

void add_event_commands(const Suite& suite) {
  suite.add("event_command", kRounds, run_event_command);
}

}  // namespace armature::benchmarks
