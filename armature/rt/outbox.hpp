// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "armature/rt/lane.hpp"

namespace armature::rt {

struct FutexParker;
template <typename Parker>
class BasicWakeup;
using Wakeup = BasicWakeup<FutexParker>;

/// What a thread has for others and puts off until the code it runs has returned: data that it has
/// gathered, and wake-ups. A thread that is sent a hundred values at once is to get one message and
/// to wake once, not a hundred times.
///
/// Specification: `flush` sends the data that was gathered and then notifies each wake-up once,
/// however often it was owed; when there is no room for another, all are notified at once. A thread
/// flushes at the latest before it sleeps on a wake-up or enters a `PermitScope`, and puts off
/// nothing while it is in one: there it may wait for anything. Data for one thread is sent before
/// data for another is gathered, and before any other message is sent (`send_gathered`): whoever
/// is told of something knows what was sent before it.
class Outbox {
 public:
  static constexpr std::size_t kMost = 8;

  /// While it lives, what the calling thread sends goes through `outbox`.
  class Scope {
   public:
    explicit Scope(Outbox& outbox) noexcept;
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;
    ~Scope();

   private:
    Outbox* const before_;
  };

  /// The calling thread's, nullptr if it puts off nothing now.
  static Outbox* current() noexcept { return current_; }

  bool any() const { return gathering_ != nullptr || count_ != 0; }

  /// As Lane::add; the owner of the lane's inbox is woken by the next `flush`.
  /// @rt nonblocking, no allocation
  std::byte* add(Lane& lane, Wakeup& reader, Recipient& recipient, std::size_t size) {
    if (gathering_ != &lane) begin(lane, reader);
    return lane.add(recipient, size);
  }
  /// @rt nonblocking, no allocation
  void send_gathered() noexcept;
  /// @rt nonblocking; a system call for each thread that sleeps
  void flush() noexcept;

 private:
  friend void notify_soon(Wakeup& wakeup) noexcept;
  friend class PermitScope;
  void begin(Lane& lane, Wakeup& reader) noexcept;
  void owe(Wakeup& wakeup) noexcept;
  void notify_all() noexcept;
  static Outbox* suspend() noexcept;
  static void resume(Outbox* suspended) noexcept { current_ = suspended; }

  // At the same place in every thread's memory, so that a look at it costs next to nothing.
  [[gnu::tls_model("initial-exec")]] static constinit thread_local Outbox* current_;

  Lane* gathering_ = nullptr;
  Wakeup* reader_ = nullptr;  ///< of what is gathered
  std::array<Wakeup*, kMost> owed_{};
  std::size_t count_ = 0;
};

/// Notifies `wakeup` when the calling thread flushes its outbox; at once if it has none or is in a
/// `PermitScope`. `wakeup` must live until then.
/// @rt nonblocking
void notify_soon(Wakeup& wakeup) noexcept;

/// Sends the data that the calling thread has gathered: what it sends next is not to overtake it.
/// @rt nonblocking, no allocation
inline void send_gathered() noexcept {
  if (Outbox* const mine = Outbox::current()) mine->send_gathered();
}

/// Flushes the calling thread's outbox.
/// @rt nonblocking; a system call for each thread that sleeps
inline void flush_outbox() noexcept {
  if (Outbox* const mine = Outbox::current()) mine->flush();
}

}  // namespace armature::rt
