// SPDX-License-Identifier: Apache-2.0
#pragma once

// What input and output ports have in common: samples, connections, options.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/component/component.hpp"
#include "armature/component/properties/property.hpp"
#include "armature/rt/when_full.hpp"
#include "armature/types/enum.hpp"
#include "armature/types/type.hpp"

namespace armature::rt {
ARMATURE_ENUM(WhenFull, kDropNewest, kDropOldest);
}  // namespace armature::rt

namespace armature::component {

using types::name_of;

/// What a read found. Ordered: everything from kOld on comes with a value.
enum class ReadStatus : std::uint8_t { kNotConnected, kNone, kOld, kNew };

std::string_view name_of(ReadStatus status);

/// What became of a value that was written.
enum class WriteStatus : std::uint8_t {
  kWritten,
  kNotConnected,  ///< nobody reads it; the value is kept for tools
  kFull,          ///< a FIFO refused the value
  kDropped,       ///< a FIFO dropped its oldest value
  kWrongSize,     ///< a vector has not the size it was configured with; nothing was written
};

/// What an input does when its data is older than declared, or its writer faulted.
enum class Reaction : std::uint8_t {
  kHold,   ///< goes on with the last value, counts
  kZero,   ///< reads zero
  kStop,   ///< its component stops
  kFault,  ///< its component faults
};

ARMATURE_ENUM(Reaction, kHold, kZero, kStop, kFault);

/// How a connection carries values; what a deployment calls its policy.
struct ConnectionPolicy {
  /// What is kept for the reader: the latest value, or a queue of values.
  enum class Kind : std::uint8_t { kLatest, kFifo };
  Kind kind = Kind::kLatest;
  std::size_t capacity = 1;  ///< of a FIFO
  rt::WhenFull when_full = rt::WhenFull::kDropNewest;
  bool one_cycle_delay = false;  ///< read one cycle after it was written: how a loop is closed
};

/// A value with the cycle time at which it was written and its number, counted from 1.
template <typename T>
struct Sample {
  T value{};
  base::Time time{};
  std::uint64_t sequence = 0;
};

/// The size of a vector port: `factor` times an integer property, e.g. `size_of(joints_, 3)`.
struct PortSize {
  const Property<int>* property = nullptr;
  std::size_t factor = 0;

  bool declared() const { return factor != 0; }
  std::size_t value() const {
    if (property == nullptr) return factor;
    const int count = property->get();
    return count > 0 ? factor * static_cast<std::size_t>(count) : 0;
  }
};
inline PortSize size_of(const Property<int>& property, std::size_t factor = 1) {
  return {&property, factor};
}
inline PortSize fixed_size(std::size_t count) { return {nullptr, count}; }

/// Options of an input port, given behind its unit.
struct MaxAge {
  base::Duration age;
  Reaction reaction;
};
/// Data older than `age` is stale, and then `reaction` happens.
inline MaxAge max_age(base::Duration age, Reaction reaction = Reaction::kStop) {
  return {age, reaction};
}
/// Option of an input port.
struct OnLost {
  Reaction reaction;
};
/// What happens when the component that writes this input faults; kStop unless declared.
inline OnLost on_lost(Reaction reaction) { return {reaction}; }
/// Option of an input port.
struct MayStayOpen {};
/// It is no mistake to leave the port unconnected.
inline constexpr MayStayOpen may_stay_open{};
/// Option of an input port.
struct FanIn {};
/// Several writers may be connected; every value counts, in the order of arrival per writer.
inline constexpr FanIn fan_in{};

/// Option of an input port or event handler: the outputs, output arrays and events that its handler
/// may write or raise. Undeclared means all of its component's; the check for endless cycles of
/// handlers needs to know.
struct LeadsTo {
  std::array<std::string_view, 6> names{};
  bool declared = false;

  bool includes(std::string_view name) const;
  bool operator==(const LeadsTo&) const = default;
};
template <typename... Names>
LeadsTo leads_to(Names... names) {
  return {{std::string_view(names)...}, true};
}
inline LeadsTo leads_to_nothing() { return {{}, true}; }

/// What a port is made of.
struct PortDeclaration {
  std::string_view name;
  std::string_view doc;
  std::string_view unit;
  const types::Type& type;
  bool is_small;  ///< see internal::is_small
};

/// What input and output ports have in common.
class PortBase : public Entrance {
 public:
  virtual ~PortBase();

  static void* operator new(std::size_t size) { return internal::allocate_side_by_side(size); }
  static void operator delete(void* at, std::size_t size) { internal::free_side_by_side(at, size); }

  const std::string& name() const;
  std::string_view doc() const;
  /// Good as long as the property that names it, if one does, is not set anew.
  std::string_view unit() const;
  /// The property that names the unit; nullptr: the model says it.
  const Property<std::string>* unit_property() const;
  const types::Type& type() const;
  Component& owner() const { return owner_; }
  Component& component() const final { return owner_; }
  const PortSize& declared_size() const;
  bool stays_open() const;

  /// The value that a tool shows.
  /// @thread the component's own
  virtual const void* current() const = 0;
  virtual base::Time current_time() const = 0;
  virtual std::uint64_t current_sequence() const = 0;

 protected:
  /// What is seldom needed. It lies apart, so that what every write and read touches lies close
  /// together: a cycle of many components is as fast as their data is small.
  struct About;

  PortBase(Component& owner, std::unique_ptr<About> about) noexcept;

  void apply(PortSize size) noexcept;
  void apply(UnitOf unit) noexcept;
  /// Is in the unit of another, which lives as long.
  void follow_unit_of(const PortBase& other) noexcept;
  void apply(MayStayOpen) noexcept;

  About& about() const { return *about_; }

 private:
  Component& owner_;
  std::unique_ptr<About> about_;
};

/// Data on ports never grows: no text inside; vectors keep the size they were configured with.
template <typename T>
concept PortData = !std::is_same_v<T, std::string> && std::is_default_constructible_v<T>;

#define ARMATURE_INTERNAL_PORT_DATA_TEXT                                                         \
  "data on ports never grows: use numbers, base::FixedText, arrays, structs, or vectors, which " \
  "keep the size they were configured with"

namespace internal {

/// It can be copied as bytes, and is small.
template <typename T>
inline constexpr bool is_small = std::is_trivially_copyable_v<T> && sizeof(T) <= 256 &&
                                 alignof(T) <= sizeof(void*);

}  // namespace internal
}  // namespace armature::component
