// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "armature/base/time.hpp"
#include "armature/testing/model/execution.hpp"

namespace armature::testing::model {

/// Stands in for std::atomic<T>: each operation is a step of the execution.
template <typename T>
class Atomic {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= sizeof(std::uint64_t));

 public:
  Atomic() : Atomic(T{}) {}
  explicit Atomic(T initial) : location_(Execution::current().add_location(bits_of(initial))) {}
  Atomic(const Atomic&) = delete;
  Atomic& operator=(const Atomic&) = delete;

  T load(Order order) const { return perform({.kind = Kind::kLoad, .order = order}); }
  void store(T value, Order order) {
    perform({.kind = Kind::kStore, .order = order, .operand = bits_of(value)});
  }
  T exchange(T value, Order order) {
    return perform({.kind = Kind::kExchange, .order = order, .operand = bits_of(value)});
  }
  T fetch_add(T value, Order order) {
    return perform({.kind = Kind::kAdd, .order = order, .operand = bits_of(value)});
  }
  bool compare_exchange_strong(T& expected, T desired, Order success, Order failure) {
    const T old = perform({.kind = Kind::kCompareExchange,
                           .order = success,
                           .operand = bits_of(desired),
                           .expected = bits_of(expected),
                           .failure_order = failure});
    if (bits_of(old) == bits_of(expected)) return true;
    expected = old;
    return false;
  }

 private:
  friend struct Parker;

  static std::uint64_t bits_of(T value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof value);
    return bits;
  }
  T perform(Operation operation) const {
    operation.location = location_;
    const std::uint64_t bits = Execution::current().perform(operation);
    T value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

  std::size_t location_;
};

/// Who read and wrote a plain variable; ends the exploration at a data race.
class AccessHistory {
 public:
  AccessHistory() { note_write(); }

  void note_read() const {
    const std::size_t self = Execution::current().running();
    check(writer_, written_, "reads what");
    reads_[self] = Execution::current().view().past[self];
  }
  void note_write() {
    const std::size_t self = Execution::current().running();
    check(writer_, written_, "writes what");
    for (std::size_t i = 0; i < kMaxThreads; ++i) check(i, reads_[i], "overwrites what");
    writer_ = self;
    written_ = Execution::current().view().past[self];
  }

 private:
  void check(std::size_t other, std::uint16_t when, const char* verb) const {
    Execution& execution = Execution::current();
    const std::size_t self = execution.running();
    if (other == self || execution.view().past[other] >= when) return;
    execution.fail("data race: " + execution.name_of(self) + " " + verb + " " +
                   execution.name_of(other) + " touches at the same time");
  }

  std::size_t writer_ = 0;
  std::uint16_t written_ = 0;
  mutable std::array<std::uint16_t, kMaxThreads> reads_{};
};

/// Stands in for a plain variable that threads share by the rules of the structure around it.
template <typename T>
class Data {
 public:
  Data() = default;
  Data(T value) : value_(value) {}  // NOLINT: a value is data
  Data(const Data& other) : value_(other.get()) {}
  Data& operator=(const Data& other) {
    set(other.get());
    return *this;
  }
  operator T() const { return get(); }  // NOLINT: and data is a value

 private:
  T get() const {
    history_.note_read();
    return value_;
  }
  void set(T value) {
    history_.note_write();
    value_ = value;
  }

  T value_{};
  AccessHistory history_;
};

/// The policy to instantiate a structure of armature/rt with.
struct Atomics {
  template <typename T>
  using Atomic = model::Atomic<T>;
  template <typename T>
  using Plain = Data<T>;
};

/// Sleeping and waking for armature/rt's wake-up.
struct Parker {
  using Atomics = model::Atomics;

  static void wait(Atomic<std::uint32_t>& word, std::uint32_t expected) {
    word.perform({.kind = Kind::kWait, .expected = expected});
  }
  /// Runs out of time at any moment.
  static bool wait_until(Atomic<std::uint32_t>& word, std::uint32_t expected, base::Time) {
    Operation wait{.kind = Kind::kWait, .location = word.location_, .expected = expected};
    wait.may_time_out = true;
    return Execution::current().perform(wait) != kTimedOut;
  }
  static void wake_one(Atomic<std::uint32_t>& word) { word.perform({.kind = Kind::kWake}); }
};

}  // namespace armature::testing::model
