// SPDX-License-Identifier: Apache-2.0
// What components do with each other within one thread, beside what plain C++ does for it.
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/exec/application.hpp"
#include "benchmarks/plain.hpp"
#include "benchmarks/simulated.hpp"
#include "benchmarks/suite.hpp"

namespace armature::benchmarks {
namespace {

using namespace armature::component;

constexpr std::int64_t kRounds = 301;
constexpr std::size_t kVector = 7;

/// Uses all that a `Service` offers.
class User final : public Component {
 public:
  using Component::Component;
  OutputPort<double> number{this, "number", "one value"};
  OutputPort<std::vector<double>> vector{this, "vector", "seven values", "", fixed_size(kVector)};
  OutputPort<double> trigger{this, "trigger", "runs a handler"};
  Event<double> event{this, "event", "something happened"};
  OperationCaller<double(double)> add{this, "add", "adds up"};
};

class Service final : public Component {
 public:
  using Component::Component;
  double sum = 0.0;

 private:
  double add_up(double value) { return sum += value; }

 public:
  InputPort<double> number{this, "number", "one value"};
  InputPort<std::vector<double>> vector{this, "vector", "seven values", "", fixed_size(kVector)};
  InputPort<double> trigger{this, "trigger", "runs a handler", "", on_data<&Service::add_up>};
  Operation<double(double)> add{this, "add", serve<&Service::add_up>, "adds up"};
};

class Subscriber final : public Component {
 public:
  using Component::Component;
  double sum = 0.0;

 private:
  void add_up(double value) { sum += value; }
  EventHandler<double> handler_{this, "event", serve<&Subscriber::add_up>, "adds up"};
};

/// A user, a service and so many subscribers, all in one thread, which is the measuring one.
class Neighbours {
 public:
  explicit Neighbours(int subscribers = 0) : application_(make(subscribers), simulated()) {
    const base::Diagnostics started = application_.start();
    if (!started.ok()) throw std::runtime_error(started.to_text());
  }

  User& user() { return *static_cast<User*>(application_.find("User")); }
  Service& service() { return *static_cast<Service*>(application_.find("Service")); }
  const Subscriber& last_subscriber() {
    return *static_cast<Subscriber*>(application_.blueprint().components.back().component.get());
  }

 private:
  static exec::Blueprint make(int subscribers) {
    exec::Activity one_thread = exec::Activity::periodic(std::chrono::milliseconds(1));
    one_thread.thread = "one";
    exec::Blueprint blueprint;
    blueprint.add<User>("User", one_thread);
    blueprint.add<Service>("Service", one_thread);
    blueprint.add_peer("User", "Service");
    for (const std::string port : {".number", ".vector", ".trigger"}) {
      blueprint.connect("User" + port, "Service" + port);
    }
    for (int i = 0; i < subscribers; ++i) {
      const std::string name = "Subscriber" + std::to_string(i + 1);
      blueprint.add<Subscriber>(name, one_thread);
      blueprint.add_peer(name, "User");
    }
    return blueprint;
  }

  exec::Application application_;
};

/// Measures two functions of a number, and has it that both return the same in all.
template <typename Ours, typename Plain>
void compare(benchmark::State& state, const Ours& ours, const Plain& plain) {
  double sum = 0.0;
  double plain_sum = 0.0;
  publish(state, measure_in_turn(
                     state,
                     [&](std::int64_t count) {
                       for (std::int64_t i = 0; i < count; ++i) sum += ours(static_cast<double>(i));
                     },
                     [&](std::int64_t count) {
                       for (std::int64_t i = 0; i < count; ++i) {
                         plain_sum += plain(static_cast<double>(i));
                       }
                     }));
  if (sum == plain_sum) return;
  const std::string text =
      "computed " + std::to_string(sum) + ", the reference " + std::to_string(plain_sum);
  state.SkipWithError(text.c_str());
}

void run_number(benchmark::State& state) {
  Neighbours all;
  User& user = all.user();
  Service& service = all.service();
  compare(
      state,
      [&](double value) {
        user.number.write(value);
        return service.number.read().value;
      },
      [&](double value) {
        plain_store(value);
        return plain_load();
      });
}

void run_vector(benchmark::State& state) {
  Neighbours all;
  User& user = all.user();
  Service& service = all.service();
  std::vector<double> values(kVector, 1.0);
  compare(
      state,
      [&](double value) {
        values[kVector - 1] = value;
        user.vector.write(values);
        return service.vector.read().value[kVector - 1];
      },
      [&](double value) {
        values[kVector - 1] = value;
        plain_store(values);
        return plain_load_vector()[kVector - 1];
      });
}

void run_trigger(benchmark::State& state) {
  Neighbours all;
  User& user = all.user();
  Service& service = all.service();
  const std::unique_ptr<Adder> adder = make_adder();
  compare(
      state,
      [&](double value) {
        user.trigger.write(value);
        return service.sum;
      },
      [&](double value) { return adder->add(value); });
}

void run_operation(benchmark::State& state) {
  Neighbours all;
  User& user = all.user();
  const std::unique_ptr<Adder> adder = make_adder();
  compare(
      state, [&](double value) { return user.add(value).value; },
      [&](double value) { return adder->add(value); });
}

void run_event(benchmark::State& state, int subscribers) {
  Neighbours all(subscribers);
  User& user = all.user();
  const Subscriber& last = all.last_subscriber();
  std::vector<std::unique_ptr<Adder>> adders;
  for (int i = 0; i < subscribers; ++i) adders.push_back(make_adder());
  compare(
      state,
      [&](double value) {
        static_cast<void>(user.event.raise(value));
        return last.sum;
      },
      [&](double value) {
        double sum = 0.0;
        for (const std::unique_ptr<Adder>& adder : adders) sum = adder->add(value);
        return sum;
      });
}

}  // namespace

void add_calls(const Suite& suite) {
  suite.add("port_write_read", kRounds, run_number);
  suite.add("port_write_read/vector", kRounds, run_vector);
  suite.add("trigger", kRounds, run_trigger);
  suite.add("operation_call", kRounds, run_operation);
  for (const int subscribers : {1, 8}) {
    suite.add("event/" + std::to_string(subscribers), kRounds,
              [subscribers](benchmark::State& state) { run_event(state, subscribers); });
  }
}

}  // namespace armature::benchmarks
