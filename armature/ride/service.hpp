// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "armature/ride/codec.hpp"
#include "armature/ride/interface.hpp"
#include "armature/ride/origin.hpp"
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

/// Thrown where the sender may not do what it has asked for: the answer is NOT_ALLOWED, with this
/// text, and the node logs it.
class NotAllowed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Thrown where a parameter is none of the operation's, or out of its range: the answer is
/// MALFORMED, with this text, which names it.
class Malformed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Who has sent the message that is executed.
class Sender {
 public:
  virtual ~Sender() = default;
  /// By which connection.
  virtual Origin origin() const { return {}; }
  virtual bool allows(std::string_view component, Access access) const = 0;
  /// Why not: the sender, as `operator@tls`, and what it may not do to the component.
  virtual std::string refusal(std::string_view component, Access access) const = 0;
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

  Holding holding_;  ///< what the parameters take, as long as the answer is owed
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
  /// @param sender  none: one that may do everything
  /// @param holding  of its parameters; none: they are not counted
  /// @param parameters  none: what they were taken from stays until the operation returns
  Reply(internal::Link* link, std::uint32_t call, Priority priority, Number operation,
        std::uint32_t component, const Sender* sender = nullptr, Holding* holding = nullptr,
        const Decoder* parameters = nullptr)
      : link_(link),
        call_(call),
        priority_(priority),
        operation_(operation),
        component_(component),
        sender_(sender),
        holding_(holding),
        parameters_(parameters) {}
  Reply(const Reply&) = delete;
  Reply& operator=(const Reply&) = delete;

  /// Answers at once. No parameter is taken after that.
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

  /// Whether the policy lets the sender do so to `component`, too, which the node need not host:
  /// for an operation that acts on others.
  bool allows(std::string_view component, Access access) const {
    return sender_ == nullptr || sender_->allows(component, access);
  }
  /// Throws NotAllowed if it does not.
  void demand(std::string_view component, Access access) const {
    if (!allows(component, access)) throw NotAllowed(sender_->refusal(component, access));
  }
  /// By which connection it came.
  Origin origin() const { return sender_ == nullptr ? Origin() : sender_->origin(); }

 private:
  void answer(const Fields& result);

  internal::Link* link_;
  std::uint32_t call_;
  Priority priority_;
  Number operation_;
  std::uint32_t component_;
  const Sender* sender_;
  Holding* holding_;
  const Decoder* parameters_;
  bool settled_ = false;
};

/// A PendingReply for a result of type `T`.
template <typename T>
class PendingReplyOf {
 public:
  explicit PendingReplyOf(PendingReply reply) : reply_(std::move(reply)) {}

  void put(const T& result) { reply_.put(result); }
  void fail(std::string_view text) { reply_.fail(text); }
  explicit operator bool() const { return static_cast<bool>(reply_); }

 private:
  PendingReply reply_;
};

/// A Reply for a result of type `T`: what an operation that is declared `[later]` is given. It puts
/// its result, now or later, or throws Failure or NotAllowed as any operation.
/// @thread the one that executes, while it does
template <typename T>
class ReplyOf {
 public:
  explicit ReplyOf(Reply& reply) : reply_(reply) {}

  void put(const T& result) { reply_.put(result); }
  PendingReplyOf<T> keep() { return PendingReplyOf<T>(reply_.keep()); }
  bool allows(std::string_view component, Access access) const {
    return reply_.allows(component, access);
  }
  void demand(std::string_view component, Access access) const { reply_.demand(component, access); }
  Origin origin() const { return reply_.origin(); }

 private:
  Reply& reply_;
};

/// For generated code, behind an operation that is declared `[later]`: one that has neither
/// answered nor kept its reply has failed.
inline void expect_settled(const Reply& reply) {
  if (!reply.settled()) throw Failure("the component dropped the request without an answer");
}

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
