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
class PortArrayBase : public PropertyFollower {
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
    count.add_follower(*this);
  }

  std::size_t wanted() const {
    const int count = count_.get();
    return count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  std::string port_name(std::size_t index) const {
    return std::string(name_) + std::to_string(index + 1);
  }

  static bool connected(const InputPortBase& port) { return port.connected(); }
  static bool connected(const OutputPortBase& port) { return !port.readers().empty(); }
  static void forget(InputPortBase& port) { std::erase(port.owner().declare().inputs, &port); }
  static void forget(OutputPortBase& port) { std::erase(port.owner().declare().outputs, &port); }

 private:
  std::string_view name_;
  const Property<int>& count_;
};

/// As many ports of one kind as an integer property says, named `Name1` to `NameN`; they follow the
/// property until one of them is connected.
template <typename Port>
class PortArray final : public PortArrayBase {
 public:
  /// The options are those of a single port and hold for each.
  template <typename... Options>
  PortArray(Component* owner, std::string_view name, Property<int>& count, std::string_view doc,
            std::string_view unit = {}, Options... options)
      : PortArrayBase(*owner, name, count) {
    maker_ = make_maker([=](std::string port_name) {
      return std::make_unique<Port>(owner, std::move(port_name), doc, unit, options...);
    });
    PortArray::follow();
  }

  std::size_t size() const { return ports_.size(); }
  /// @param index  from 0
  Port& operator[](std::size_t index) { return *ports_[index]; }

  void follow() override {
    if (!objection().empty()) return;
    while (ports_.size() > wanted()) {
      forget(*ports_.back());
      ports_.pop_back();
    }
    ports_.reserve(wanted());
    while (ports_.size() < wanted()) {
      ports_.push_back(maker_->make(port_name(ports_.size())));
      if constexpr (requires { ports_.back()->set_index(0); }) {
        ports_.back()->set_index(ports_.size() - 1);
      }
    }
  }
  std::string objection() const override {
    for (const auto& port : ports_) {
      if (connected(*port)) return "port '" + port->name() + "' is connected";
    }
    return {};
  }

 private:
  /// Makes one more port with the options of all.
  struct Maker {
    virtual ~Maker() = default;
    virtual std::unique_ptr<Port> make(std::string name) const = 0;
  };
  template <typename Make>
  static std::unique_ptr<Maker> make_maker(Make make) {
    struct Wrapped final : Maker {
      explicit Wrapped(Make function) : function_(std::move(function)) {}
      std::unique_ptr<Port> make(std::string name) const override {
        return function_(std::move(name));
      }
      Make function_;
    };
    return std::make_unique<Wrapped>(std::move(make));
  }

  std::unique_ptr<Maker> maker_;
  std::vector<std::unique_ptr<Port>> ports_;
};

template <typename T>
using InputPorts = PortArray<InputPort<T>>;
template <typename T>
using OutputPorts = PortArray<OutputPort<T>>;

}  // namespace armature::component
