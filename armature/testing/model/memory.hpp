// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace armature::testing::model {

inline constexpr std::size_t kMaxThreads = 5;  // the first one is the program itself
inline constexpr std::size_t kMaxLocations = 16;

using Order = std::memory_order;

/// What a kWait that ran out of time returns.
inline constexpr std::uint64_t kTimedOut = ~std::uint64_t{0};

enum class Kind { kLoad, kStore, kExchange, kCompareExchange, kAdd, kWait, kWake, kReturn };

/// What a thread is about to do.
struct Operation {
  Kind kind = Kind::kReturn;
  std::size_t location = 0;
  Order order = Order::relaxed;
  std::uint64_t operand = 0;
  std::uint64_t expected = 0;
  Order failure_order = Order::relaxed;
  bool may_time_out = false;

  /// True if it makes no difference which of the two comes first.
  bool commutes_with(const Operation& other) const;
};

/// What a thread knows: the newest store to each location that it cannot go behind any more, and
/// how far it knows every thread's past.
struct View {
  std::array<std::uint16_t, kMaxLocations> newest{};
  std::array<std::uint16_t, kMaxThreads> past{};
};

/// Atomic locations under C++'s memory model, as an abstract machine: a location keeps all its
/// stores in their modification order; a load may see any of them that its thread's view does not
/// rule out; a release store carries its thread's view, an acquire load takes it over; read-modify-
/// write operations follow directly on the store they read and hand on the view that it carried.
class Memory {
 public:
  /// Answers which of `count` possibilities happens.
  using Choose = std::function<std::size_t(std::size_t count)>;

  explicit Memory(Choose choose) : choose_(std::move(choose)) {}

  void reset();
  std::size_t add_location(std::size_t thread, std::uint64_t initial);
  /// Carries out a load, store or read-modify-write; returns what it read.
  std::uint64_t perform(std::size_t thread, const Operation& operation);
  /// What the kernel sees when it compares a word before it puts the thread to sleep.
  std::uint64_t read_newest(std::size_t thread, std::size_t location);

  View& view(std::size_t thread) { return views_[thread]; }
  /// `into` knows from now on what `from` knows.
  void join(View& into, const View& from) const;

 private:
  struct Store {
    std::uint64_t value;
    std::size_t rank;       ///< place in the modification order
    bool follows_directly;  ///< on the store before it, which it read
    View carried;
  };
  struct Location {
    std::vector<Store> stores;         ///< in the order of their execution
    std::vector<std::uint16_t> order;  ///< the modification order: indices of stores
    std::uint16_t newest_seq_cst = 0;  ///< no operation in memory_order_seq_cst goes behind it
  };

  std::size_t least_rank(std::size_t thread, const Operation& operation) const;
  std::uint64_t load(std::size_t thread, const Operation& operation);
  void store(std::size_t thread, const Operation& operation);
  std::uint64_t modify(std::size_t thread, const Operation& operation);
  /// The view moves on to the store of that rank.
  std::uint64_t read(std::size_t thread, std::size_t location, std::size_t rank, Order order);
  void insert(std::size_t thread, const Operation& operation, std::size_t rank, std::uint64_t value,
              const View* handed_on);

  Choose choose_;
  std::vector<Location> locations_;
  std::array<View, kMaxThreads> views_{};
};

}  // namespace armature::testing::model
