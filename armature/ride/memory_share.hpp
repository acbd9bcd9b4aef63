// SPDX-License-Identifier: Apache-2.0
#pragma once

// What peers may make a node keep: one bound for all together, and for each connection a share.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace armature::ride {

/// Bytes that peers together may make a node keep: reserves, and what all share.
/// @thread any
class MemoryBound {
 public:
  /// @param reserves  for those of all connections; at most half of it is
  MemoryBound(std::size_t bytes, std::size_t reserves);
  MemoryBound(const MemoryBound&) = delete;
  MemoryBound& operator=(const MemoryBound&) = delete;

  ~MemoryBound();

  std::size_t used() const { return reserved_ + taken_ + scrapped_; }
  /// True if somebody has more than its reserve.
  bool is_in_use() const { return taken_ != 0; }

  /// To give the system back many pages at once takes milliseconds, in which a node serves nobody.
  /// So what its thread lets go of is scrap first, which counts as used, and is given back piece by
  /// piece: by that thread between other things, and whenever somebody needs it.
  /// @param keeper  that thread; none: nothing becomes scrap any more
  void set_keeper(std::thread::id keeper) { keeper_ = keeper; }
  bool has_scrap() const { return scrapped_ != 0; }
  /// @return false if there was none
  bool release_scrap() noexcept;

 private:
  friend class MemoryShare;
  static constexpr std::size_t kPages = 64 * 1024;  ///< [byte], whole pages on every machine
  static constexpr std::size_t kPiece = 2 * kPages;
  struct Pages {
    std::byte* begin;
    std::size_t size;
  };

  bool keeps(std::byte* pages, std::size_t size) noexcept;

  std::mutex mutex_;  ///< to change what follows, and of the shares
  std::vector<Pages> scrap_;
  std::atomic<std::size_t> scrapped_{0};
  std::atomic<std::thread::id> keeper_{};
  const std::size_t reserves_;
  const std::size_t common_;
  std::atomic<std::size_t> reserved_{0};
  std::atomic<std::size_t> taken_{0};  ///< of `common_`
};

/// The part of one connection: a reserve that nobody else gets, and beyond it of what is left so
/// much that others find some as well.
/// @thread any
class MemoryShare {
 public:
  /// @param reserve  its own [byte]
  MemoryShare(std::shared_ptr<MemoryBound> all, std::size_t reserve)
      : all_(std::move(all)), reserve_(reserve) {}
  ~MemoryShare();
  MemoryShare(const MemoryShare&) = delete;
  MemoryShare& operator=(const MemoryShare&) = delete;

  /// Takes the reserve; false if none is left. `always`: whatever is left.
  [[nodiscard]] bool open(bool always);
  /// Its connection has ended: the reserve is for others, what it still has is of what all share.
  void end();
  /// False if there is not so much left for it.
  [[nodiscard]] bool take(std::size_t bytes) noexcept;
  void give(std::size_t bytes) noexcept;
  /// Gives what lies in pages of its own (platform::resize_pages), and the pages.
  void give_pages(std::byte* pages, std::size_t bytes) noexcept;
  /// True if it has taken more than its reserve.
  bool exceeds_reserve() const;

 private:
  /// It may have so many times of what it leaves.
  static constexpr std::size_t kFair = 8;

  bool try_take(std::size_t bytes, bool& would_with_scrap) noexcept;
  std::size_t scrap_of(std::byte* pages, std::size_t bytes) noexcept;
  std::size_t beyond(std::size_t used) const { return used > reserve_ ? used - reserve_ : 0; }

  const std::shared_ptr<MemoryBound> all_;
  std::size_t reserve_;
  bool opened_ = false;
  std::size_t used_ = 0;
};

/// What the values of one message take of a share, until it goes.
/// @thread one at a time
class Holding {
 public:
  Holding() = default;
  /// @param share  there until the holding was moved, or goes
  explicit Holding(const std::shared_ptr<MemoryShare>& share) : offered_(&share) {}
  Holding(Holding&& other) noexcept;
  Holding& operator=(Holding&& other) noexcept;
  ~Holding() { release(); }

  /// A few small values are not counted.
  /// @throws std::bad_alloc  there is not so much left for it
  void take(std::size_t bytes);

 private:
  static constexpr std::size_t kSmall = 4096;
  void release();

  const std::shared_ptr<MemoryShare>* offered_ = nullptr;
  std::shared_ptr<MemoryShare> share_;  ///< once it is counted
  std::size_t bytes_ = 0;
};

}  // namespace armature::ride
