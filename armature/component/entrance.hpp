// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <string_view>

namespace armature::component {

class Component;
struct ExecutionContext;
namespace internal {
class Inside;
}  // namespace internal

/// A way into a component's code: a handler's, or the one of its hooks and operations. Those that
/// were entered and not left in a thread form a chain, innermost first.
class Entrance {
 public:
  Entrance() = default;
  Entrance(const Entrance&) = delete;
  Entrance& operator=(const Entrance&) = delete;

  virtual Component& component() const = 0;
  /// Of the port or event; empty for hooks and operations.
  virtual std::string_view handler() const { return {}; }
  /// The one that was entered before; meaningful while this one is entered.
  virtual const Entrance* outer() const { return nullptr; }

  /// Faults the component because this handler, while it runs, was set off by what it set off; the
  /// reason tells the way it took.
  /// @rt nonblocking, no allocation
  /// @thread that of `where`
  void refuse(ExecutionContext& where) const noexcept;

 protected:
  ~Entrance() = default;
};

/// The way into a hook or operation. A component's operations may run in several threads at once,
/// so that each thread has a stack of these.
class HookEntrance final : public Entrance {
 public:
  Component& component() const override { return *component_.load(std::memory_order_relaxed); }
  const Entrance* outer() const override { return outer_; }

 private:
  friend class internal::Inside;
  std::atomic<Component*> component_{nullptr};
  const Entrance* outer_ = nullptr;
};

}  // namespace armature::component
