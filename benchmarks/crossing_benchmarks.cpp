// SPDX-License-Identifier: Apache-2.0
// From one thread to another and back.
#include <atomic>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>

#include "armature/component/author.hpp"
#include "armature/exec/application.hpp"
#include "benchmarks/baton.hpp"
#include "benchmarks/errand.hpp"
#include "benchmarks/suite.hpp"

namespace armature::benchmarks {
namespace {

using namespace armature::component;

constexpr std::int64_t kRounds = 101;
constexpr std::chrono::milliseconds kBatch(10);

/// Asks, and waits for the answer.
class Asker final : public Component {
 public:
  using Component::Component;
  OutputPort<double> question{this, "question", "a number"};
  InputPort<double> answer{this, "answer", "the same number"};
  OperationCaller<double(double)> add{this, "add", "adds up"};

  /// Sends so many numbers through the ports, each after the one before came back.
  void ask(std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i) {
      question.write(static_cast<double>(i));
      while (!answer.read().is_new()) {
      }
    }
  }
  void send(std::int64_t count) {
    for (std::int64_t i = 0; i < count; ++i) {
      static_cast<void>(add.send(static_cast<double>(i)).wait(std::chrono::seconds(10)));
    }
  }
};

class Answerer final : public Component {
 public:
  using Component::Component;
  InputPort<double> question{this, "question", "a number"};
  OutputPort<double> answer{this, "answer", "the same number"};
  double sum = 0.0;

  void reply(std::int64_t count) {
    while (count > 0) {
      const auto asked = question.read();
      if (!asked.is_new()) continue;
      sum += asked.value;
      answer.write(asked.value);
      --count;
    }
  }

 private:
  double add_up(double value) { return sum += value; }

 public:
  Operation<double(double)> add{this, "add", serve<&Answerer::add_up>, "adds up", in_own_thread};
};

/// An asker and an answerer, each in its own thread.
class TwoThreads {
 public:
  TwoThreads() : application_(make()) {
    const base::Diagnostics started = application_.start();
    if (!started.ok()) throw std::runtime_error(started.to_text());
  }

  void ask(std::int64_t count) {
    count_ = count;
    reply_.send();
    ask_.send();
    finish_.wait();
  }
  void send(std::int64_t count) {
    count_ = count;
    send_.send();
    finish_.wait();
  }
  /// Once all is over.
  double sum() {
    application_.stop();
    return answerer_.sum;
  }

 private:
  static exec::Blueprint make() {
    exec::Blueprint blueprint;
    blueprint.add<Asker>("Asker", exec::Activity::triggered());
    blueprint.add<Answerer>("Answerer", exec::Activity::triggered());
    blueprint.add_peer("Asker", "Answerer");
    blueprint.connect("Asker.question", "Answerer.question");
    blueprint.connect("Answerer.answer", "Asker.answer");
    return blueprint;
  }

  exec::Application application_;
  Asker& asker_ = *static_cast<Asker*>(application_.find("Asker"));
  Answerer& answerer_ = *static_cast<Answerer*>(application_.find("Answerer"));
  std::int64_t count_ = 0;
  Finish finish_;
  Errand reply_{answerer_, [this] { answerer_.reply(count_); }};
  Errand ask_{asker_, [this] {
                asker_.ask(count_);
                finish_.tell();
              }};
  Errand send_{asker_, [this] {
                 asker_.send(count_);
                 finish_.tell();
               }};
};

/// Two plain threads that each do their part `count` times whenever both are told to.
class TwoPlainThreads {
 public:
  using Part = std::function<void(std::int64_t count)>;
  TwoPlainThreads(Part first, Part second)
      : first_([this, part = std::move(first)] { serve(go_first_, part); }),
        second_([this, part = std::move(second)] { serve(go_second_, part); }) {}
  TwoPlainThreads(const TwoPlainThreads&) = delete;
  TwoPlainThreads& operator=(const TwoPlainThreads&) = delete;
  ~TwoPlainThreads() {
    ending_ = true;
    go_first_.pass();
    go_second_.pass();
    first_.join();
    second_.join();
  }

  void run(std::int64_t count) {
    count_ = count;
    working_ = 2;
    go_second_.pass();
    go_first_.pass();
    finish_.wait();
  }

 private:
  void serve(Baton& go, const Part& part) {
    while (true) {
      go.wait();
      if (ending_) return;
      part(count_);
      if (working_.fetch_sub(1) == 1) finish_.pass();
    }
  }

  std::int64_t count_ = 0;
  std::atomic<int> working_{0};
  std::atomic<bool> ending_{false};
  Baton go_first_;
  Baton go_second_;
  Baton finish_;
  std::thread first_;
  std::thread second_;
};

/// The sum that the answerer is to have when it was asked as often as the plain threads.
void check_sum(benchmark::State& state, double ours, double plain) {
  if (ours == plain) return;
  const std::string text =
      "computed " + std::to_string(ours) + ", the reference " + std::to_string(plain);
  state.SkipWithError(text.c_str());
}

/// Half a round: from a write to the read that finds it, with both threads awake.
void run_ports(benchmark::State& state) {
  TwoThreads ours;
  alignas(64) std::atomic<double> question{-1.0};
  alignas(64) std::atomic<double> answer{-1.0};
  double sum = 0.0;
  TwoPlainThreads plain(
      [&](std::int64_t count) {
        for (std::int64_t i = 0; i < count; ++i) {
          question.store(static_cast<double>(i), std::memory_order_release);
          while (answer.load(std::memory_order_acquire) != static_cast<double>(i)) {
          }
        }
        question = -1.0;
      },
      [&](std::int64_t count) {
        for (std::int64_t i = 0; i < count; ++i) {
          while (question.load(std::memory_order_acquire) != static_cast<double>(i)) {
          }
          sum += static_cast<double>(i);
          answer.store(static_cast<double>(i), std::memory_order_release);
        }
      });
  Result result = measure_in_turn(
      state, [&](std::int64_t count) { ours.ask(count); },
      [&](std::int64_t count) {
        answer = -1.0;
        plain.run(count);
      },
      kBatch);
  result.value /= 2.0;
  *result.reference /= 2.0;
  publish(state, result);
  check_sum(state, ours.sum(), sum);
}

void run_send(benchmark::State& state) {
  TwoThreads ours;
  Baton there;
  Baton back;
  double number = 0.0;
  double sum = 0.0;
  TwoPlainThreads plain(
      [&](std::int64_t count) {
        for (std::int64_t i = 0; i < count; ++i) {
          number = static_cast<double>(i);
          there.pass();
          back.wait();
        }
      },
      [&](std::int64_t count) {
        for (std::int64_t i = 0; i < count; ++i) {
          there.wait();
          sum += number;
          back.pass();
        }
      });
  publish(state, measure_in_turn(
                     state, [&](std::int64_t count) { ours.send(count); },
                     [&](std::int64_t count) { plain.run(count); }, kBatch));
  check_sum(state, ours.sum(), sum);
}

}  // namespace

void add_crossings(const Suite& suite) {
  suite.add("port_write_read_across_threads", kRounds, run_ports);
  suite.add("operation_send_collect", kRounds, run_send);
}

}  // namespace armature::benchmarks
