// SPDX-License-Identifier: Apache-2.0
#pragma once

// For tests: components with one port each.

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "armature/component/author.hpp"

namespace armature::component {

template <typename T>
class Writer : public Component {
 public:
  using Component::Component;
  OutputPort<T> out{this, "Out", "what the test writes"};
};

template <typename T>
class Reader : public Component {
 public:
  template <typename... Options>
  explicit Reader(std::string name, Options... options)
      : Component(std::move(name)), in(this, "In", "what the test reads", "", options...) {}
  InputPort<T> in;
};

/// Its handler notes each value; handler and update do what the test says.
class TriggeredReader : public Component {
 public:
  template <typename... Options>
  explicit TriggeredReader(std::string name, Options... options)
      : Component(std::move(name)),
        in(this, "In", "triggers", "", on_data<&TriggeredReader::take>, options...) {}

  InputPort<int> in;
  std::vector<int> values;
  int updates = 0;
  std::function<void()> then;
  std::function<void()> in_update;

 private:
  void take(const int& value) {
    values.push_back(value);
    if (then) then();
  }
  void on_update() override {
    ++updates;
    if (in_update) in_update();
  }
};

inline ConnectionPolicy latest() { return {}; }
inline ConnectionPolicy fifo(std::size_t capacity,
                             rt::WhenFull when_full = rt::WhenFull::kDropNewest) {
  return {ConnectionPolicy::Kind::kFifo, capacity, when_full, false};
}
inline ConnectionPolicy delayed() {
  ConnectionPolicy policy;
  policy.one_cycle_delay = true;
  return policy;
}

}  // namespace armature::component
