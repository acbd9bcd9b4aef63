// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "armature/component/ports/input_port.hpp"
#include "armature/component/ports/output_port.hpp"
#include "armature/component/properties/property.hpp"

namespace armature::component {

/// What tools know of a family of ports `Name1..NameN`.
class PortArrayBase : public PropertyFollower {
 public:
  PortArrayBase(const PortArrayBase&) = delete;
  PortArrayBase& operator=(const PortArrayBase&) = delete;
  virtual ~PortArrayBase();

  std::string_view name() const { return name_; }
  std::string_view unit() const { return unit_; }
  const Property<int>& count() const { return count_; }
  /// True if a port of that name would be one of them.
  bool has_name(std::string_view port) const;

 protected:
  PortArrayBase(Component& owner, std::string_view name, Property<int>& count,
                std::string_view unit) noexcept;

  std::size_t wanted() const;
  std::string port_name(std::size_t index) const;
  /// Options of the ports are plain data, kept as bytes.
  void keep_options(const void* options, std::size_t size);
  const void* options() const { return options_.get(); }

  static bool connected(const InputPortBase& port) { return port.connected(); }
  static bool connected(const OutputPortBase& port) {
    return !port.readers().empty() || port.is_tapped();
  }
  static void forget(InputPortBase& port);
  static void forget(OutputPortBase& port);

 private:
  std::string_view name_;
  std::string_view unit_;
  const Property<int>& count_;
  std::unique_ptr<std::byte[]> options_;
};

/// As many ports of one kind as an integer property says, named `Name1` to `NameN`; they follow the
/// property until one of them is connected.
template <typename Port>
class PortArray final : public PortArrayBase {
 public:
  /// The options are those of a single port and hold for each.
  template <typename... Options>
  PortArray(Component* owner, std::string_view name, Property<int>& count, std::string_view doc,
            std::string_view unit = {}, Options... options) noexcept
      : PortArray(*owner, name, count, doc, unit) {
    const auto apply = [options...](Port& port) { (port.apply(options), ...); };
    using Apply = decltype(apply);
    static_assert(std::is_trivially_copyable_v<Apply>);
    keep_options(&apply, sizeof apply);
    apply_ = [](const void* kept, Port& port) { (*static_cast<Apply*>(kept))(port); };
    PortArray::follow();
  }
  ~PortArray() override;

  std::size_t size() const { return ports_.size(); }
  /// @param index  from 0
  Port& operator[](std::size_t index) { return *ports_[index]; }

  void follow() override;
  std::string objection() const override;

 private:
  PortArray(Component& owner, std::string_view name, Property<int>& count, std::string_view doc,
            std::string_view unit) noexcept;

  Component& owner_;
  std::string_view doc_;
  void (*apply_)(const void* options, Port& port) = nullptr;
  std::vector<std::unique_ptr<Port>> ports_;
};

template <typename Port>
PortArray<Port>::PortArray(Component& owner, std::string_view name, Property<int>& count,
                           std::string_view doc, std::string_view unit) noexcept
    : PortArrayBase(owner, name, count, unit), owner_(owner), doc_(doc) {}

template <typename Port>
PortArray<Port>::~PortArray() = default;

template <typename Port>
void PortArray<Port>::follow() {
  if (!objection().empty()) return;
  while (ports_.size() > wanted()) {
    forget(*ports_.back());
    ports_.pop_back();
  }
  ports_.reserve(wanted());
  while (ports_.size() < wanted()) {
    const std::size_t index = ports_.size();
    ports_.emplace_back(new Port(owner_, port_name(index), doc_, unit()));
    apply_(options(), *ports_.back());
    if constexpr (requires(Port & port) { port.set_index(0); }) ports_.back()->set_index(index);
  }
}

template <typename Port>
std::string PortArray<Port>::objection() const {
  for (const auto& port : ports_) {
    if (connected(*port)) return "port '" + port->name() + "' is connected";
  }
  return {};
}

// Compiled once, in the library.
extern template class PortArray<InputPort<double>>;
extern template class PortArray<OutputPort<double>>;

template <typename T>
using InputPorts = PortArray<InputPort<T>>;
template <typename T>
using OutputPorts = PortArray<OutputPort<T>>;

}  // namespace armature::component
