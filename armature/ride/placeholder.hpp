// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "armature/ride/answer.hpp"
#include "armature/ride/codec.hpp"
#include "armature/ride/interface.hpp"
#include "armature/ride/peer.hpp"

namespace armature::ride {

/// Stands for a component that lives in another process. rcidl derives one from it for each
/// interface, with a function for each operation and event. It goes before its node does.
class Placeholder {
 public:
  /// @param peer  the process the component lives in
  /// @param name  the component's name there
  /// @param interface  what it is expected to have; lives as long as the program
  Placeholder(Peer& peer, std::string name, const Interface& interface);
  Placeholder(const Placeholder&) = delete;
  Placeholder& operator=(const Placeholder&) = delete;
  virtual ~Placeholder();

  const std::string& name() const;
  const Interface& interface() const;
  Peer& peer() const { return peer_; }
  /// The peer has a component of this name and interface.
  /// @thread any
  bool found() const;

  /// Calls `handler` for each command of the component that failed, until the Subscription goes.
  Subscription on_failed(std::function<void(const Failed&)> handler) {
    return subscribe<Failed>(std::move(handler));
  }

 protected:
  /// Sends a request and waits for its answer or the deadline. No allocation if the result has a
  /// fixed size and there is one.
  /// @param operation  its name, for errors
  /// @thread any, several at a time
  template <typename Result, typename... Parameters>
  Answer<Result> request(Number number, std::string_view operation, const CallOptions& options,
                         const Parameters&... parameters) {
    const auto all = std::tie(parameters...);
    if constexpr (std::is_void_v<Result>) {
      std::string error;
      const Code code = call(number, operation, options, Fields(all), Place(), error);
      return code == Code::kNone ? Answer<void>() : Answer<void>(code, std::move(error));
    } else {
      Result result{};
      std::string error;
      const Code code = call(number, operation, options, Fields(all), Place(result), error);
      return code == Code::kNone ? Answer<Result>(std::move(result))
                                 : Answer<Result>(code, std::move(error));
    }
  }

  /// Sends a command: at once, or, when another message went out a moment ago, with those that
  /// follow within some microseconds. Never waits for the other side.
  /// @return kQueueFull if the other side has not yet taken earlier messages; kNotConnected also
  ///   while the component has not been found there
  /// @thread any, several at a time
  template <typename... Parameters>
  Sent command(Number number, Priority priority, const Parameters&... parameters) {
    return send(number, priority, Fields(std::tie(parameters...)));
  }

  /// Calls `handler` for each Event until the Subscription is destroyed. One subscription on the
  /// wire serves all of this process; it is made anew after each reconnection.
  /// @param handler  called by the node's I/O thread
  template <typename Event>
  Subscription subscribe(std::function<void(const Event&)> handler) {
    return subscribe(event_number(static_cast<const Event*>(nullptr)),
                     [handler = std::move(handler)](Decoder& members) {
                       Event event{};
                       if (!members.take(event) || !members.ended()) return false;
                       handler(event);
                       return true;
                     });
  }

  /// What `request`, `command` and `subscribe` come to, for who builds messages at run time.
  Code call(Number number, std::string_view operation, const CallOptions& options,
            const Fields& parameters, const Place& result, std::string& error);
  Sent send(Number number, Priority priority, const Fields& parameters);
  Subscription subscribe(Number event, std::function<bool(Decoder&)> handler);

  /// Told what a request brought: why there is no answer, or the answer's body.
  using Then =
      std::function<void(Code code, std::string_view text, std::span<const std::byte> result)>;
  /// Sends a request and returns at once. There is no deadline: an answer that does not come is
  /// told when the connection is lost.
  /// @param then  called once, by the node's I/O thread or this one; it must not wait
  /// @thread any
  void ask(Number number, Priority priority, const Fields& parameters, Then then);

  /// An answer for a parameter that is out of its range, which is never sent.
  template <typename Result>
  Answer<Result> refuse(std::string_view operation, std::string_view problem) const {
    return Answer<Result>(Code::kMalformed, error_text(operation, problem));
  }

 private:
  std::string error_text(std::string_view operation, std::string_view problem) const;

  Peer& peer_;
  std::shared_ptr<internal::RemoteComponent> component_;
};

}  // namespace armature::ride
