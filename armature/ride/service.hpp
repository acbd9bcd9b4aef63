// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <tuple>

#include "armature/ride/codec.hpp"
#include "armature/ride/interface.hpp"
#include "armature/ride/wire.hpp"

namespace armature::ride {

namespace internal {
class Link;
class Publisher;
}  // namespace internal

/// Thrown by an operation that cannot do what it was asked for: the requester gets its text. Of a
/// command, which has no answer, it is logged and raised as the event `Failed`.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What became of a message that a service was to execute; kBusy: no room for it now.
enum class Executed { kDone, kNoSuchOperation, kMalformed, kBusy };

/// The answer to a request that is given later, by any thread, once. Who lets it go without an
/// answer tells the requester that the operation failed.
class PendingReply {
 public:
  PendingReply() = default;
  PendingReply(PendingReply&& other) noexcept;
  PendingReply& operator=(PendingReply&& other) noexcept;
  ~PendingReply();

  /// Sends the result, unless the requester has gone.
  /// @thread any
  template <typename T>
  void put(const T& result) {
    answer(Fields(std::tie(result)));
  }
  /// For an operation without result.
  void done() { answer(Fields(kNothing)); }
  /// Tells the requester that the operation failed, and why.
  void fail(std::string_view text);
  /// True as long as an answer is owed.
  explicit operator bool() const { return link_ != nullptr; }

 private:
  friend class Reply;
  static constexpr std::tuple<> kNothing{};
  void answer(const Fields& result);

  std::shared_ptr<internal::Link> link_;
  std::uint32_t connection_ = 0;  ///< which of the link's: the call is none of a later one
  std::uint32_t call_ = 0;
  Priority priority_;
  Number operation_ = 0;
  std::uint32_t component_ = 0;
};

/// Where an operation puts its result while it executes. A command's result goes nowhere.
/// @thread the one that executes
class Reply {
 public:
  /// @param call, operation, component  of the request; `link` is none for a command
  Reply(internal::Link* link, std::uint32_t call, Priority priority, Number operation,
        std::uint32_t component)
      : link_(link),
        call_(call),
        priority_(priority),
        operation_(operation),
        component_(component) {}
  Reply(const Reply&) = delete;
  Reply& operator=(const Reply&) = delete;

  /// Answers at once.
  template <typename T>
  void put(const T& result) {
    answer(Fields(std::tie(result)));
  }
  /// Puts off the answer; of a command a PendingReply that owes none.
  PendingReply keep();
  /// True once it was answered or kept.
  bool settled() const { return settled_; }
  /// Answers without a value.
  void done() { answer(Fields(PendingReply::kNothing)); }

 private:
  void answer(const Fields& result);

  internal::Link* link_;
  std::uint32_t call_;
  Priority priority_;
  Number operation_;
  std::uint32_t component_;
  bool settled_ = false;
};

/// The frame of a component that others use through a node. rcidl derives one from it for each
/// interface; the component's author derives from that and fills in the operations, which are
/// executed by the node's I/O thread, one at a time.
///
/// Remove it from its node, or destroy the node, before the derived object goes.
class Service {
 public:
  /// @param interface  lives as long as the program
  explicit Service(const Interface& interface);
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;
  virtual ~Service();

  const Interface& interface() const { return interface_; }

 protected:
  /// Tells all subscribers. Encoded once; a subscriber whose queue is full loses its oldest event,
  /// which is counted. One system call for each connection that subscribed.
  /// @thread any
  template <typename Event>
  void publish(const Event& event, Priority priority = {}) {
    publish(event_number(static_cast<const Event*>(nullptr)), Fields(std::tie(event)), priority);
  }
  void publish(Number event, const Fields& members, Priority priority);

  /// Changes when somebody subscribes to one of its events, or does so no more.
  /// @thread any
  std::uint64_t subscription_changes() const;
  bool has_subscribers(Number event) const;

 private:
  friend class internal::Publisher;
  friend class Node;
  friend class ServiceAccess;

  /// Executes an operation with its parameters.
  /// @return kDone; kNoSuchOperation; kMalformed if the parameters are not the operation's; kBusy
  virtual Executed execute(Number operation, Decoder& parameters, Reply& reply) = 0;

  const Interface& interface_;
  std::shared_ptr<internal::Publisher> publisher_;
};

/// How a node reaches what a service keeps to itself.
class ServiceAccess {
 public:
  static Executed execute(Service& service, Number operation, Decoder& from, Reply& reply) {
    return service.execute(operation, from, reply);
  }
  static internal::Publisher& publisher(Service& service) { return *service.publisher_; }
};

}  // namespace armature::ride
