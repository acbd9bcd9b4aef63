// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "armature/testing/model/fiber.hpp"
#include "armature/testing/model/memory.hpp"

namespace armature::testing::model {

/// Thrown through the program's code to end an execution.
struct Aborted {};

/// Runs a program's threads one step at a time in a chosen order, and goes through all choices one
/// execution after another. A step is one atomic operation with the code up to the next one.
class Execution {
 public:
  Execution();

  /// The one whose program is running.
  static Execution& current();

  /// Runs `program` once, by the choices that are to be tried next.
  void run(const std::function<void()>& program);
  /// Goes on to the next choices; false if all were tried.
  bool advance();

  void add_thread(std::string name, std::function<void()> body);
  void join_threads();
  [[noreturn]] void fail(const std::string& what);

  std::size_t add_location(std::uint64_t initial);
  /// Does one operation of the running thread, when its turn has come; returns what it read.
  std::uint64_t perform(const Operation& operation);

  std::size_t running() const { return running_; }
  const std::string& name_of(std::size_t thread) const { return threads_[thread].name; }
  const View& view() { return memory_.view(running_); }

  const std::string& failure() const { return failure_; }
  bool pruned() const { return pruned_; }

 private:
  enum class State { kReady, kAsleep, kDone };
  struct Thread {
    Thread(std::string its_name, std::function<void()> its_body)
        : name(std::move(its_name)), body(std::move(its_body)) {}

    std::string name;
    std::function<void()> body;
    State state = State::kDone;
    Operation next;
    bool may_wake_for_no_reason = true;
  };
  struct Choice {
    std::size_t taken;
    std::size_t count;
  };
  struct Step {
    std::size_t thread;
    Operation operation;
    std::uint64_t result;
  };
  using ThreadSet = std::uint32_t;  // one bit each

  std::size_t choose(std::size_t count);
  void start_threads();
  void run_thread(std::size_t thread);
  void run_until_next_step(std::size_t thread);
  std::vector<std::size_t> ready_threads() const;
  void check_nobody_sleeps();
  void unwind_threads();
  void wait_for_turn(const Operation& operation);
  std::uint64_t carry_out(const Operation& operation);
  std::uint64_t sleep_on(const Operation& operation);
  void wake_one(std::size_t location);
  std::string trace() const;

  std::vector<Choice> choices_;
  std::size_t next_choice_ = 0;
  Memory memory_;
  std::vector<Fiber> fibers_;
  std::vector<Thread> threads_;
  std::size_t running_ = 0;
  std::vector<Step> steps_;
  std::string failure_;
  bool unwinding_ = false;
  bool pruned_ = false;
};

}  // namespace armature::testing::model
