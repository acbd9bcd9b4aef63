// SPDX-License-Identifier: Apache-2.0
#include "armature/testing/model/execution.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <utility>

#include "armature/testing/model/explore.hpp"

namespace armature::testing::model {
namespace {

constexpr std::size_t kMaxSteps = 2000;
Execution* current_execution = nullptr;

const char* text_of(Order order) {
  switch (order) {
    case Order::relaxed:
      return "relaxed";
    case Order::consume:
      return "consume";
    case Order::acquire:
      return "acquire";
    case Order::release:
      return "release";
    case Order::acq_rel:
      return "acq_rel";
    case Order::seq_cst:
      return "seq_cst";
  }
  return "?";
}

std::string text_of(std::uint64_t value) {
  char text[32];
  std::snprintf(text, sizeof text, value < 100000 ? "%llu" : "%#llx",
                static_cast<unsigned long long>(value));
  return text;
}

std::string text_of(const Operation& operation, std::uint64_t result) {
  const std::string operand = text_of(operation.operand);
  const std::string order = text_of(operation.order);
  switch (operation.kind) {
    case Kind::kLoad:
      return "load " + order + ": " + text_of(result);
    case Kind::kStore:
      return "store " + order + ": " + operand;
    case Kind::kExchange:
      return "exchange " + order + ": " + text_of(result) + " -> " + operand;
    case Kind::kAdd:
      return "add " + order + ": " + text_of(result) + " + " + operand;
    case Kind::kCompareExchange:
      if (result == operation.expected) {
        return "compare_exchange " + order + ": " + text_of(result) + " -> " + operand;
      }
      return "compare_exchange " + std::string(text_of(operation.failure_order)) + ": expected " +
             text_of(operation.expected) + ", found " + text_of(result);
    case Kind::kWait:
      if (result == kTimedOut) return "sleep while " + text_of(operation.expected) + ": timed out";
      return "sleep while " + text_of(operation.expected) + ": found " + text_of(result);
    case Kind::kWake:
      return "wake one";
    case Kind::kReturn:
      return "";
  }
  return "";
}

}  // namespace

Execution::Execution() : memory_([this](std::size_t count) { return choose(count); }) {
  fibers_ = std::vector<Fiber>(kMaxThreads);
}

Execution& Execution::current() {
  if (current_execution == nullptr) {
    throw std::logic_error("model::Atomic and model::Data live only inside model::explore");
  }
  return *current_execution;
}

void Execution::run(const std::function<void()>& program) {
  next_choice_ = 0;
  memory_.reset();
  threads_.assign(1, Thread("program", nullptr));
  running_ = 0;
  steps_.clear();
  unwinding_ = false;
  pruned_ = false;
  current_execution = this;
  try {
    program();
  } catch (const Aborted&) {
  }
  current_execution = nullptr;
}

bool Execution::advance() {
  while (!choices_.empty() && choices_.back().taken + 1 == choices_.back().count) {
    choices_.pop_back();
  }
  if (choices_.empty()) return false;
  ++choices_.back().taken;
  return true;
}

std::size_t Execution::choose(std::size_t count) {
  if (count == 1) return 0;
  if (next_choice_ == choices_.size()) choices_.push_back({0, count});
  return choices_[next_choice_++].taken;
}

void Execution::add_thread(std::string name, std::function<void()> body) {
  if (threads_.size() == kMaxThreads) throw std::length_error("more threads than kMaxThreads");
  threads_.emplace_back(std::move(name), std::move(body));
}

void Execution::join_threads() {
  start_threads();
  // Of two executions that differ only in the order of operations that commute, one is enough: a
  // thread in `sleeping` was run first at this point before, and nothing since touched what it is
  // about to do.
  ThreadSet sleeping = 0;
  while (true) {
    const std::vector<std::size_t> ready = ready_threads();
    if (ready.empty()) break;
    std::vector<std::size_t> candidates;
    for (const std::size_t thread : ready) {
      if ((sleeping >> thread & 1u) == 0) candidates.push_back(thread);
    }
    if (candidates.empty()) {
      pruned_ = true;
      unwind_threads();
      throw Aborted{};
    }
    const std::size_t chosen = choose(candidates.size());
    for (std::size_t i = 0; i < chosen; ++i) sleeping |= 1u << candidates[i];
    const Operation operation = threads_[candidates[chosen]].next;
    for (const std::size_t thread : ready) {
      if (!operation.commutes_with(threads_[thread].next)) sleeping &= ~(1u << thread);
    }
    run_until_next_step(candidates[chosen]);
  }
  check_nobody_sleeps();
  for (std::size_t i = 1; i < threads_.size(); ++i) memory_.join(memory_.view(0), memory_.view(i));
}

void Execution::start_threads() {
  for (std::size_t i = 1; i < threads_.size(); ++i) {
    memory_.view(i) = memory_.view(0);
    memory_.view(i).past[i] = 1;
    threads_[i].state = State::kReady;
    fibers_[i].set_task([this, i] { run_thread(i); });
    run_until_next_step(i);
  }
  ++memory_.view(0).past[0];
}

void Execution::run_thread(std::size_t thread) {
  try {
    threads_[thread].body();
  } catch (const Aborted&) {
  } catch (const std::exception& error) {
    failure_ = "exception in " + name_of(thread) + ": " + error.what() + "\n" + trace();
  }
  threads_[thread].state = State::kDone;
}

void Execution::run_until_next_step(std::size_t thread) {
  running_ = thread;
  fibers_[thread].resume();
  running_ = 0;
  if (failure_.empty()) return;
  unwind_threads();
  throw Aborted{};
}

std::vector<std::size_t> Execution::ready_threads() const {
  std::vector<std::size_t> ready;
  for (std::size_t i = 1; i < threads_.size(); ++i) {
    if (threads_[i].state == State::kReady) ready.push_back(i);
  }
  return ready;
}

void Execution::check_nobody_sleeps() {
  const auto sleeper = std::find_if(threads_.begin(), threads_.end(), [](const Thread& thread) {
    return thread.state == State::kAsleep;
  });
  if (sleeper == threads_.end()) return;
  // Whoever may time out does so in another execution.
  pruned_ = std::any_of(sleeper, threads_.end(), [](const Thread& thread) {
    return thread.state == State::kAsleep && thread.next.may_time_out;
  });
  if (!pruned_) failure_ = sleeper->name + " sleeps for ever\n" + trace();
  unwind_threads();
  throw Aborted{};
}

void Execution::unwind_threads() {
  unwinding_ = true;
  for (std::size_t i = 1; i < threads_.size(); ++i) {
    if (threads_[i].state != State::kDone) fibers_[i].resume();
  }
}

void Execution::fail(const std::string& what) {
  failure_ = what + "\n" + trace();
  throw Aborted{};
}

std::size_t Execution::add_location(std::uint64_t initial) {
  return memory_.add_location(running_, initial);
}

std::uint64_t Execution::perform(const Operation& operation) {
  if (running_ != 0) wait_for_turn(operation);
  if (steps_.size() == kMaxSteps) fail("does not come to an end");
  const std::size_t step = steps_.size();
  steps_.push_back({running_, operation, 0});
  const std::uint64_t result = carry_out(operation);
  steps_[step].result = result;
  ++memory_.view(running_).past[running_];
  return result;
}

void Execution::wait_for_turn(const Operation& operation) {
  threads_[running_].next = operation;
  fibers_[running_].suspend();
  if (unwinding_) throw Aborted{};
}

std::uint64_t Execution::carry_out(const Operation& operation) {
  switch (operation.kind) {
    case Kind::kWait:
      return sleep_on(operation);
    case Kind::kWake:
      wake_one(operation.location);
      return 0;
    default:
      return memory_.perform(running_, operation);
  }
}

/// The kernel compares and falls asleep in one step; it may return for no reason, here once for
/// each thread.
std::uint64_t Execution::sleep_on(const Operation& operation) {
  const std::uint64_t value = memory_.read_newest(running_, operation.location);
  if (value != operation.expected) return value;
  Thread& self = threads_[running_];
  if (self.may_wake_for_no_reason && choose(2) == 1) {
    self.may_wake_for_no_reason = false;
    return value;
  }
  if (operation.may_time_out && choose(2) == 1) return kTimedOut;
  self.state = State::kAsleep;
  Operation wake = operation;
  wake.kind = Kind::kReturn;
  wait_for_turn(wake);
  return value;
}

void Execution::wake_one(std::size_t location) {
  std::vector<Thread*> asleep;
  for (Thread& thread : threads_) {
    if (thread.state == State::kAsleep && thread.next.location == location) {
      asleep.push_back(&thread);
    }
  }
  if (!asleep.empty()) asleep[choose(asleep.size())]->state = State::kReady;
}

std::string Execution::trace() const {
  std::string text;
  for (const Step& step : steps_) {
    if (step.thread == 0) continue;
    text += "  " + name_of(step.thread) + ": atomic " + std::to_string(step.operation.location) +
            ", " + text_of(step.operation, step.result) + "\n";
  }
  return text;
}

void Program::thread(std::string name, std::function<void()> body) {
  execution_.add_thread(std::move(name), std::move(body));
}

void Program::join() { execution_.join_threads(); }

void Program::expect(bool condition, const std::string& what) {
  if (!condition) execution_.fail(what);
}

Result explore(const std::function<void(Program&)>& body) {
  Execution execution;
  Program program(execution);
  Result result;
  do {
    execution.run([&] { body(program); });
    if (!execution.pruned()) ++result.executions;
    result.failure = execution.failure();
  } while (result.ok() && execution.advance());
  return result;
}

}  // namespace armature::testing::model
