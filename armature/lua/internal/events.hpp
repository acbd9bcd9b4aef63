// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <lua5.4/lua.hpp>

#include "armature/component/events/event.hpp"
#include "armature/exec/application.hpp"
#include "armature/rt/inbox.hpp"
#include "armature/types/type.hpp"

namespace armature::lua::internal {

/// So many of one event may wait for the script; more are lost, and counted.
inline constexpr std::size_t kEventQueue = 64;

/// Events of components on their way to a script, in the order in which they were raised, whoever
/// raised them. The raiser never waits.
class Events {
 public:
  explicit Events(exec::Application& application);
  Events(const Events&) = delete;
  Events& operator=(const Events&) = delete;
  ~Events();

  /// What came with an event.
  using Arguments = std::vector<types::Value>;
  /// Called each time that the event was raised, where errors of Lua end it.
  using Listener = std::function<void(lua_State*, const Arguments&)>;
  using Id = std::uint64_t;
  static constexpr Id kNobody = 0;

  /// From now on; kNobody if the thread of the event's component does not answer.
  Id listen(component::EventBase& event, Listener listener);
  void forget(Id id);
  bool is_full() const { return listeners_.size() >= 1000; }

  bool any_listens() const { return !taps_.empty(); }
  bool any_arrived() const { return pending_ != nullptr || !inbox_->empty(); }
  /// Tells the listeners of the oldest event that arrived; false if there is none.
  bool deliver_next(lua_State* lua);

  struct Loss {
    std::string event;
    std::uint64_t count;  ///< since it was asked last
  };
  std::vector<Loss> take_losses();

 private:
  class Tap;
  struct Registered {
    Id id;
    const component::EventBase* event;
    std::shared_ptr<const Listener> listener;
  };

  bool tap(component::EventBase& event);
  std::shared_ptr<const Listener> listener(Id id) const;

  exec::Application& application_;
  std::shared_ptr<rt::Inbox> inbox_;  ///< shared with the taps
  rt::Message* pending_ = nullptr;    ///< of those that were taken from the inbox, the next
  std::vector<std::unique_ptr<Tap>> taps_;
  std::vector<Registered> listeners_;
  Id last_id_ = kNobody;
};

/// For the script's user.
std::string text_of(const Events::Loss& loss);

/// How many arguments they are, which are on the stack then.
int push_arguments(lua_State* lua, const Events::Arguments& arguments);

}  // namespace armature::lua::internal
