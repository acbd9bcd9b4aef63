// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <utility>

#include "armature/rt/atomics.hpp"
#include "armature/rt/entry_pool.hpp"
#include "armature/rt/inbox.hpp"

namespace armature::rt {

/// Somebody whom data is sent to in batches.
class Recipient {
 public:
  /// Takes what lies at `data`, and returns how long that is.
  /// @thread the inbox's owner only
  virtual std::size_t receive(const std::byte* data) = 0;

 protected:
  ~Recipient() = default;
};

/// Data for recipients in one thread, one behind the other: a single message, which is read as fast
/// as memory can be.
template <typename Atomics = StdAtomics>
class BasicBatch final : public BasicMessage<Atomics> {
 public:
  BasicBatch() : BasicMessage<Atomics>(&BasicBatch::deliver) {}

  /// @thread configuration only
  void make_room(std::size_t bytes) {
    data_ = std::make_unique<std::byte[]>(bytes);
    capacity_ = bytes;
  }
  void clear() { used_ = 0; }

  /// Where `size` bytes for `recipient` are to be written; nullptr if there is no room for them.
  /// @param size  a multiple of kAlignment
  std::byte* add(Recipient& recipient, std::size_t size) {
    const std::size_t begin = used_;
    if (begin + room_for(size) > capacity_) return nullptr;
    Recipient* const to = &recipient;
    std::memcpy(&data_[begin], &to, sizeof to);
    used_ = begin + room_for(size);
    return &data_[begin + sizeof to];
  }

  static constexpr std::size_t kAlignment = sizeof(Recipient*);
  static constexpr std::size_t room_for(std::size_t size) { return sizeof(Recipient*) + size; }

  BasicInUse<Atomics> in_use;

 private:
  static void deliver(BasicMessage<Atomics>& message) {
    auto& self = static_cast<BasicBatch&>(message);
    const std::byte* at = self.data_.get();
    for (const std::byte* const end = at + self.used_; at != end;) {
      Recipient* to;
      std::memcpy(&to, at, sizeof to);
      at += room_for(to->receive(at + sizeof to));
    }
    self.in_use.give_back();
  }

  std::unique_ptr<std::byte[]> data_;
  std::size_t capacity_ = 0;
  typename Atomics::template Plain<std::size_t> used_{0};
};

/// The way of data from one thread to another: what is added is gathered in a batch until that is
/// sent.
///
/// Specification: everything added is received once, in the order of adding, by a `take_all` of the
/// inbox that starts after `send`; among the messages that the same thread pushes, a batch has the
/// place of its `send`. While all batches are under way nothing can be added.
template <typename Atomics = StdAtomics>
class BasicLane {
 public:
  /// One is read while the other is gathered. More would be values that have had their time.
  static constexpr std::size_t kBatches = 2;
  using Batch = BasicBatch<Atomics>;

  explicit BasicLane(BasicInbox<Atomics>& inbox) : inbox_(inbox) {}

  /// A batch is to have room for another `size` bytes.
  /// @thread configuration only
  void reserve(std::size_t size) { room_ += Batch::room_for(size); }
  /// Makes the batches; nothing can be added before.
  /// @thread configuration only
  void prepare() {
    for (Batch& batch : batches_) batch.make_room(room_);
    prepared_ = true;
  }

  /// Where `size` bytes for `recipient` are to be written before the next call; nullptr if no batch
  /// is free. Sends a batch that has become full.
  /// @rt nonblocking, no allocation
  /// @thread the writer only
  std::byte* add(Recipient& recipient, std::size_t size) {
    if (gathered_ != nullptr) {
      if (std::byte* const place = gathered_->add(recipient, size)) return place;
      send();
    }
    Batch* const next = prepared_ ? batches_.claim() : nullptr;
    if (next == nullptr) return nullptr;
    next->clear();
    gathered_ = next;
    return gathered_->add(recipient, size);
  }

  /// @rt nonblocking, no allocation
  /// @thread the writer only
  void send() {
    if (gathered_ != nullptr) inbox_.push(*std::exchange(gathered_, nullptr));
  }

 private:
  BasicInbox<Atomics>& inbox_;
  Batch* gathered_ = nullptr;
  std::size_t room_ = 0;
  bool prepared_ = false;
  EntryPool<Batch> batches_{kBatches};
};

using Lane = BasicLane<>;

}  // namespace armature::rt
