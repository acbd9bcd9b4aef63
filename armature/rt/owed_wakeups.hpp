// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace armature::rt {

struct FutexParker;
template <typename Parker>
class BasicWakeup;
using Wakeup = BasicWakeup<FutexParker>;

/// Wake-ups that a thread puts off until the code it runs has returned: a thread that is sent a
/// hundred values at once is to wake once, not a hundred times.
///
/// Specification: a wake-up that is owed is notified once by the next `pay`, however often it was
/// owed; when there is no room for another, all are paid at once. A thread pays at the latest
/// before it sleeps on a wake-up or enters a `PermitScope`, and owes nothing while it is in one:
/// there it may wait for anything.
class OwedWakeups {
 public:
  static constexpr std::size_t kMost = 8;

  /// While it lives, what the calling thread notifies with `notify_soon` is put off.
  class Account {
   public:
    explicit Account(OwedWakeups& owed) noexcept;
    Account(const Account&) = delete;
    Account& operator=(const Account&) = delete;
    ~Account();

   private:
    OwedWakeups* const before_;
  };

  bool any() const { return count_ != 0; }
  /// @rt nonblocking; a system call for each thread that sleeps
  void pay() noexcept;

 private:
  friend void notify_soon(Wakeup& wakeup) noexcept;
  void owe(Wakeup& wakeup) noexcept;

  std::array<Wakeup*, kMost> owed_{};
  std::size_t count_ = 0;
};

/// Notifies `wakeup` when the calling thread pays what it owes; at once if it has no account or is
/// in a `PermitScope`. `wakeup` must live until then.
/// @rt nonblocking
void notify_soon(Wakeup& wakeup) noexcept;

/// Pays what the calling thread owes.
/// @rt nonblocking; a system call for each thread that sleeps
void pay_owed_wakeups() noexcept;

}  // namespace armature::rt
