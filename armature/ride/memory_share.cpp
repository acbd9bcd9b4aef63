// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/memory_share.hpp"

#include <algorithm>
#include <new>
#include <utility>

#include "armature/platform/pages.hpp"

namespace armature::ride {
namespace {

/// More of them at once are given back at once.
constexpr std::size_t kMostScraps = 256;

}  // namespace

MemoryBound::MemoryBound(std::size_t bytes, std::size_t reserves)
    : reserves_(std::min(reserves, bytes / 2)), common_(bytes - reserves_) {
  scrap_.reserve(kMostScraps);
}

MemoryBound::~MemoryBound() {
  while (release_scrap()) {
  }
}

/// With the lock held.
bool MemoryBound::keeps(std::byte* pages, std::size_t size) noexcept {
  if (size <= kPiece || keeper_.load(std::memory_order_relaxed) != std::this_thread::get_id()) {
    return false;
  }
  if (scrap_.size() == scrap_.capacity()) return false;
  scrap_.push_back({pages, size});
  scrapped_ += size;
  return true;
}

bool MemoryBound::release_scrap() noexcept {
  Pages piece{};
  {
    const std::lock_guard lock(mutex_);
    if (scrap_.empty()) return false;
    Pages& last = scrap_.back();
    piece.size = std::min(last.size, kPiece);
    last.size -= piece.size;
    piece.begin = last.begin + last.size;
    if (last.size == 0) scrap_.pop_back();
  }
  platform::resize_pages(piece.begin, piece.size, 0);
  scrapped_ -= piece.size;
  return true;
}

MemoryShare::~MemoryShare() {
  end();
  all_->taken_ -= used_;
}

void MemoryShare::end() {
  const std::lock_guard lock(all_->mutex_);
  all_->taken_ += used_ - beyond(used_);
  if (std::exchange(opened_, false)) all_->reserved_ -= reserve_;
  reserve_ = 0;
}

bool MemoryShare::open(bool always) {
  const std::lock_guard lock(all_->mutex_);
  if (opened_) return true;
  if (!always && all_->reserved_ + reserve_ > all_->reserves_) return false;
  all_->reserved_ += reserve_;
  opened_ = true;
  return true;
}

bool MemoryShare::take(std::size_t bytes) noexcept {
  bool would_with_scrap = false;
  while (!try_take(bytes, would_with_scrap)) {
    if (!would_with_scrap || !all_->release_scrap()) return false;
  }
  return true;
}

bool MemoryShare::try_take(std::size_t bytes, bool& would_with_scrap) noexcept {
  const std::lock_guard lock(all_->mutex_);
  const std::size_t after = beyond(used_ + bytes);
  const std::size_t more = after - beyond(used_);
  const auto fits = [&](std::size_t used) {
    const std::size_t left = all_->common_ - std::min(all_->common_, used);
    return more == 0 || (more <= left && after / kFair <= left - more);
  };
  would_with_scrap = fits(all_->taken_);
  if (!fits(all_->taken_ + all_->scrapped_)) return false;
  all_->taken_ += more;
  used_ += bytes;
  return true;
}

void MemoryShare::give_pages(std::byte* pages, std::size_t bytes) noexcept {
  const std::size_t rest = bytes - scrap_of(pages, bytes);
  if (rest == 0) return;
  platform::resize_pages(pages, rest, 0);
  give(rest);
}

/// Of what all share only: a reserve that was given is there again at once.
/// @return how much of it, from the end
std::size_t MemoryShare::scrap_of(std::byte* pages, std::size_t bytes) noexcept {
  const std::lock_guard lock(all_->mutex_);
  std::size_t common = beyond(used_) - beyond(used_ - bytes);
  common -= common % MemoryBound::kPages;
  if (!all_->keeps(pages + (bytes - common), common)) return 0;
  all_->taken_ -= common;
  used_ -= common;
  return common;
}

void MemoryShare::give(std::size_t bytes) noexcept {
  const std::lock_guard lock(all_->mutex_);
  all_->taken_ -= beyond(used_) - beyond(used_ - bytes);
  used_ -= bytes;
}

bool MemoryShare::exceeds_reserve() const {
  const std::lock_guard lock(all_->mutex_);
  return used_ > reserve_;
}

Holding::Holding(Holding&& other) noexcept
    : share_(std::move(other.share_)), bytes_(std::exchange(other.bytes_, 0)) {
  other.offered_ = nullptr;
}

Holding& Holding::operator=(Holding&& other) noexcept {
  if (this == &other) return *this;
  release();
  other.offered_ = nullptr;
  share_ = std::move(other.share_);
  bytes_ = std::exchange(other.bytes_, 0);
  return *this;
}

void Holding::take(std::size_t bytes) {
  if (offered_ == nullptr) return;
  const std::size_t counted = share_ != nullptr ? bytes : bytes_ + bytes;
  if (share_ != nullptr || counted > kSmall) {
    if (!(*offered_)->take(counted)) throw std::bad_alloc();
    share_ = *offered_;
  }
  bytes_ += bytes;
}

void Holding::release() {
  if (share_ != nullptr) share_->give(bytes_);
  share_ = nullptr;
  bytes_ = 0;
}

}  // namespace armature::ride
