// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/rt/atomics.hpp"

namespace armature::rt {

/// Something that a thread is to do, sent to it by another. The sender owns it and must leave it
/// alone until it was delivered; so an inbox needs no memory of its own and is never full.
template <typename Atomics = StdAtomics>
class BasicMessage {
 public:
  using Deliver = void (*)(BasicMessage&);

  explicit BasicMessage(Deliver action) : deliver_(action) {}
  BasicMessage(const BasicMessage&) = delete;
  BasicMessage& operator=(const BasicMessage&) = delete;

  /// Does what the message is for; afterwards its sender may use it again.
  /// @thread the inbox's owner only
  void deliver() { deliver_(*this); }

 protected:
  ~BasicMessage() = default;

 private:
  template <typename>
  friend class BasicInbox;

  Deliver deliver_;
  typename Atomics::template Plain<BasicMessage*> next_{nullptr};
};

/// Messages from any number of threads to one.
///
/// Specification: every message pushed is taken exactly once, those of one sender in their order,
/// all in the order of their pushes. `take_all` finishes in a bounded number of steps, whatever
/// senders do: one that was interrupted in the middle of a push holds up nobody.
template <typename Atomics = StdAtomics>
class BasicInbox {
 public:
  using Message = BasicMessage<Atomics>;

  /// @rt nonblocking, no allocation; starts again only if another push came in between
  void push(Message& message) {
    Message* head = head_.load(std::memory_order_relaxed);
    do {
      message.next_ = head;
    } while (!head_.compare_exchange_strong(head, &message, std::memory_order_release,
                                            std::memory_order_relaxed));
  }

  /// @rt nonblocking
  bool empty() const { return head_.load(std::memory_order_relaxed) == nullptr; }

  /// Takes everything and returns the oldest; go on with `next`.
  /// @rt nonblocking, no allocation, O(messages)
  /// @thread the owner only
  Message* take_all() {
    Message* newest = head_.exchange(nullptr, std::memory_order_acquire);
    Message* oldest = nullptr;
    while (newest != nullptr) {
      Message* const older = newest->next_;
      newest->next_ = oldest;
      oldest = newest;
      newest = older;
    }
    return oldest;
  }

  /// The message after `message`; ask before delivering it, since its sender may use it again then.
  static Message* next(const Message& message) { return message.next_; }

  /// Delivers what is here now, in its order; what is sent meanwhile is left for the next time.
  /// @rt as the messages' deliveries are
  /// @thread the owner only
  void deliver_all() {
    for (Message* message = take_all(); message != nullptr;) {
      Message* const after = next(*message);
      message->deliver();
      message = after;
    }
  }

 private:
  typename Atomics::template Atomic<Message*> head_{nullptr};
};

/// A message that may be sent again and again: while it is on its way, sending it once more adds
/// nothing, and whatever the sender wrote before is seen when it is delivered.
///
/// Specification: after `raise`, the message is delivered at least once by a `take_all` that starts
/// later; the delivery, which calls `lower` first, sees all that was written before that `raise`.
template <typename Atomics = StdAtomics>
class BasicSignal : public BasicMessage<Atomics> {
 public:
  using BasicMessage<Atomics>::BasicMessage;

  /// True if the message was put into the inbox now.
  /// @rt nonblocking, no allocation
  bool raise(BasicInbox<Atomics>& inbox) {
    // Always a read-modify-write: a plain "is it raised already?" could miss that the receiver
    // lowers it at this moment without having seen the sender's data.
    if (raised_.exchange(true, std::memory_order_acq_rel)) return false;
    inbox.push(*this);
    return true;
  }

  /// To be called by the delivery before it looks at the sender's data.
  /// @thread the inbox's owner only
  void lower() { raised_.exchange(false, std::memory_order_acq_rel); }

 private:
  typename Atomics::template Atomic<bool> raised_{false};
};

using Message = BasicMessage<>;
using Inbox = BasicInbox<>;
using Signal = BasicSignal<>;

}  // namespace armature::rt
