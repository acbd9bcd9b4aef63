// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests: the rover's processes, each an application in simulated time, and between them a
// network whose delays are simulated too. What stands for components elsewhere is not RIDE's
// placeholder, whose threads live in real time; commands that are under way, and all that the
// deployments say, are the same.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/component/interface.hpp"
#include "armature/component/operations/commands_under_way.hpp"
#include "armature/component/stand_in.hpp"
#include "armature/exec/application.hpp"
#include "armature/remote/feed.hpp"
#include "armature/rt/guard.hpp"

namespace armature::rover {

/// How long messages of a direction take. Each waits for those before it, as on a stream.
struct Delays {
  base::Duration least{};
  base::Duration most{};
  double stalls = 0.0;  ///< share of the messages that take `stall` longer
  base::Duration stall{};
};

/// One direction of a connection.
class Direction {
 public:
  Direction(const Delays& delays, std::uint32_t seed) : delays_(delays), random_(seed) {}

  void send(std::function<void()> message) {
    const std::uniform_real_distribution<double> share(0.0, 1.0);
    auto draw = share;
    const auto spread = static_cast<double>((delays_.most - delays_.least).count());
    base::Duration delay =
        delays_.least + base::Duration(static_cast<std::int64_t>(draw(random_) * spread));
    if (draw(random_) < delays_.stalls) delay += delays_.stall;
    last_due_ = std::max(last_due_, now_ + delay);
    waiting_.push_back({last_due_, std::move(message)});
    most_waiting_ = std::max(most_waiting_, waiting_.size());
  }
  void pass_time(base::Duration step) {
    now_ += step;
    while (!waiting_.empty() && waiting_.front().due <= now_) {
      const std::function<void()> message = std::move(waiting_.front().message);
      waiting_.pop_front();
      message();
    }
  }
  std::size_t most_waiting() const { return most_waiting_; }

 private:
  struct Message {
    base::Duration due;
    std::function<void()> message;
  };
  Delays delays_;
  std::mt19937 random_;
  base::Duration now_{};
  base::Duration last_due_{};
  std::deque<Message> waiting_;
  std::size_t most_waiting_ = 0;
};

/// Stands for a component of another application. Its commands may all be under way several at a
/// time; operations are answered without delay, since simulated time cannot wait for them.
class Elsewhere final : public component::StandIn {
 public:
  Elsewhere(std::string name, std::unique_ptr<component::Component> prototype,
            std::string original_name)
      : StandIn(std::move(name)),
        prototype_(std::move(prototype)),
        original_name_(std::move(original_name)) {
    const component::Interface& original = component::interface_of(*prototype_);
    for (const auto* const event : original.events) events_.push_back({event->twin(*this), {}});
    for (const auto* const output : original.outputs) outputs_.push_back({output->twin(*this), {}});
    for (const auto* const operation : original.operations) {
      Operation& added = operations_.emplace_back();
      added.twin = operation->twin(*this);
      if (!operation->is_command()) continue;
      added.under_way = std::make_unique<component::CommandsUnderWay>(
          static_cast<const component::CommandBase&>(*added.twin));
    }
  }

  /// Both applications run.
  void connect(exec::Application& here, exec::Application& there, const Delays& delays,
               std::uint32_t seed) {
    here_ = &here;
    there_ = &there;
    to_there_ = std::make_unique<Direction>(delays, seed);
    to_here_ = std::make_unique<Direction>(delays, seed + 1);
    const component::Interface& original = component::interface_of(*there.find(original_name_));
    const remote::RunInThread run = [&there](component::Component& owner,
                                             std::function<void()> work) {
      return there.run_in_thread_of(owner, std::move(work));
    };
    open_events(original, run);
    open_outputs(original, run);
  }

  /// Before one of the applications goes.
  void disconnect() {
    for (Event& event : events_) event.feed.reset();
    for (Output& output : outputs_) output.feed.reset();
  }

  /// @param step  by which both applications have gone on
  void pass_time(base::Duration step) {
    look_at_events();
    look_at_outputs();
    look_at_commands();
    to_there_->pass_time(step);
    to_here_->pass_time(step);
  }
  std::size_t most_under_way() const { return most_under_way_; }
  std::size_t given() const { return given_; }

  void pass_on(component::InputPortBase&, const void*) override {}
  component::CallStatus call(component::OperationBase& operation, const void* const* arguments,
                             void* result) override {
    const rt::PermitScope permit;
    const auto answer =
        there_->call(original_name_, operation.name(), values_of(operation.signature(), arguments),
                     exec::Caller::kRemote);
    if (!answer) return component::CallStatus::kFailed;
    if (result != nullptr) operation.signature().result->assign(result, answer.value()->data());
    return component::CallStatus::kDone;
  }
  component::CommandsUnderWay* several(const component::CommandBase& command) override {
    return operation_of(command).under_way.get();
  }
  component::Outcome begin(component::CommandBase& command, const void* const* arguments) override {
    const rt::PermitScope permit;
    Operation& operation = operation_of(command);
    ++given_;
    most_under_way_ = std::max(most_under_way_, operation.under_way->size());
    to_there_->send([this, &operation, run = operation.under_way->newest(),
                     values = values_of(command.signature(), arguments)] {
      auto begun =
          there_->begin(original_name_, operation.twin->name(), values, exec::Caller::kRemote);
      if (begun) return begun_.push_back({&operation, run, std::move(begun).value()});
      answer(operation, run, component::CommandStage::kFailed, begun.error());
    });
    return component::accepted();
  }
  void cancel(component::CommandBase&) override {}

 private:
  struct Event {
    std::unique_ptr<component::EventBase> twin;
    std::unique_ptr<remote::EventFeed> feed;
  };
  struct Output {
    std::unique_ptr<component::OutputPortBase> twin;
    std::unique_ptr<remote::PortFeed> feed;
  };
  struct Operation {
    std::unique_ptr<component::OperationBase> twin{};
    std::unique_ptr<component::CommandsUnderWay> under_way{};
  };
  struct Begun {
    Operation* operation;
    std::uint64_t run;
    component::CommandHandle handle;
  };

  static std::vector<types::Value> values_of(const component::Signature& signature,
                                             const void* const* arguments) {
    std::vector<types::Value> values;
    for (const auto& argument : signature.arguments) {
      values.emplace_back(*argument.type, *arguments++);
    }
    return values;
  }
  Operation& operation_of(const component::OperationBase& twin) {
    return *std::ranges::find_if(operations_,
                                 [&](const Operation& each) { return each.twin.get() == &twin; });
  }
  void open_events(const component::Interface& original, const remote::RunInThread& run) {
    for (Event& event : events_) {
      for (auto* const each : original.events) {
        if (each->name() != event.twin->name() || event.twin->subscribers().empty()) continue;
        event.feed = std::make_unique<remote::EventFeed>(*each, run);
        event.feed->open();
      }
    }
  }
  void open_outputs(const component::Interface& original, const remote::RunInThread& run) {
    for (Output& output : outputs_) {
      for (auto* const each : original.outputs) {
        if (each->name() != output.twin->name() || output.twin->readers().empty()) continue;
        output.feed = std::make_unique<remote::PortFeed>(*each, run);
        output.feed->open();
      }
    }
  }
  void look_at_events() {
    for (Event& event : events_) {
      if (event.feed == nullptr) continue;
      event.feed->take([&](const void* const* members) {
        to_here_->send([this, &event, values = values_of(event.twin->signature(), members)] {
          std::vector<const void*> places;
          for (const types::Value& value : values) places.push_back(value.data());
          here_->run_in_thread_of(
              *this, [&] { static_cast<void>(event.twin->raise_from(places.data())); });
        });
      });
    }
  }
  void look_at_outputs() {
    for (Output& output : outputs_) {
      if (output.feed == nullptr) continue;
      output.feed->take([&](const component::TappedSample&, const void* value) {
        to_here_->send([this, &output, copy = types::Value(output.twin->type(), value)] {
          here_->run_in_thread_of(*this,
                                  [&] { static_cast<void>(output.twin->write_from(copy.data())); });
        });
      });
    }
  }
  void look_at_commands() {
    std::erase_if(begun_, [this](const Begun& one) {
      if (!one.handle.ended()) return false;
      const bool done = one.handle.stage() == component::CommandStage::kDone;
      answer(*one.operation, one.run,
             done ? component::CommandStage::kDone : component::CommandStage::kFailed,
             std::string(one.handle.reason()));
      return true;
    });
  }
  void answer(Operation& operation, std::uint64_t run, component::CommandStage stage,
              const std::string& reason) {
    to_here_->send([this, &operation, run, stage, reason] {
      here_->run_in_thread_of(*this, [&] { operation.under_way->end(run, stage, reason); });
    });
  }

  const std::unique_ptr<component::Component> prototype_;
  const std::string original_name_;
  exec::Application* here_ = nullptr;
  exec::Application* there_ = nullptr;
  std::unique_ptr<Direction> to_there_;
  std::unique_ptr<Direction> to_here_;
  std::vector<Event> events_;
  std::vector<Output> outputs_;
  std::deque<Operation> operations_;
  std::vector<Begun> begun_;
  std::size_t most_under_way_ = 0;
  std::size_t given_ = 0;
  component::Event<> found_{this, "PeerFound", "the process where it lives was reached"};
  component::Event<> lost_{this, "PeerLost", "the process where it lives can no longer be reached"};
};

}  // namespace armature::rover
