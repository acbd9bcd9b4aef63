// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "armature/component/input_port.hpp"
#include "armature/component/output_port.hpp"
#include "armature/component/property.hpp"

namespace armature::component {

/// What tools know of a family of ports `Name1..NameN`.
class PortArrayBase {
 public:
  PortArrayBase(const PortArrayBase&) = delete;
  PortArrayBase& operator=(const PortArrayBase&) = delete;
  virtual ~PortArrayBase() = default;

  std::string_view name() const { return name_; }
  const Property<int>& count() const { return count_; }

 protected:
  PortArrayBase(Component& owner, std::string_view name, Property<int>& count)
      : name_(name), count_(count) {
    owner.declare().port_arrays.push_back(this);
  }

 private:
  std::string_view name_;
  const Property<int>& count_;
};

/// As many ports of one kind as an integer property says, named `Name1` to `NameN`; they follow the
/// property until they are connected.
template <typename Port>
class PortArray final : public PortArrayBase {
 public:
  /// The options are those of a single port and hold for each.
  template <typename... Options>
  PortArray(Component* owner, std::string_view name, Property<int>& count, std::string_view doc,
            std::string_view unit = {}, Options... options)
      : PortArrayBase(*owner, name, count) {
    const auto follow = [=, this, &count] {
      resize(count.get() > 0 ? static_cast<std::size_t>(count.get()) : 0, [&](std::string each) {
        return std::make_unique<Port>(owner, std::move(each), doc, unit, options...);
      });
    };
    count.on_set(follow);
    follow();
  }

  std::size_t size() const { return ports_.size(); }
  /// @param index  from 0
  Port& operator[](std::size_t index) { return *ports_[index]; }

 private:
  template <typename Make>
  void resize(std::size_t wanted, const Make& make) {
    while (ports_.size() > wanted) {
      forget(*ports_.back());
      ports_.pop_back();
    }
    ports_.reserve(wanted);
    while (ports_.size() < wanted) {
      ports_.push_back(make(std::string(name()) + std::to_string(ports_.size() + 1)));
      if constexpr (requires { ports_.back()->set_index(0); }) {
        ports_.back()->set_index(ports_.size() - 1);
      }
    }
  }

  static void forget(InputPortBase& port) { std::erase(port.owner().declare().inputs, &port); }
  static void forget(OutputPortBase& port) { std::erase(port.owner().declare().outputs, &port); }

  std::vector<std::unique_ptr<Port>> ports_;
};

template <typename T>
using InputPorts = PortArray<InputPort<T>>;
template <typename T>
using OutputPorts = PortArray<OutputPort<T>>;

}  // namespace armature::component
