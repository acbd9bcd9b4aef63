// SPDX-License-Identifier: Apache-2.0
#include "armature/lua/internal/events.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <utility>

#include "armature/component/component.hpp"
#include "armature/component/events/event_tap.hpp"
#include "armature/component/observing/tap.hpp"
#include "armature/lua/internal/values.hpp"
#include "armature/rt/entry_pool.hpp"

namespace armature::lua::internal {

/// The queue of one event: its raiser fills it, the script's thread empties it.
class Events::Tap final : public component::EventTap {
 public:
  struct Entry final : rt::Message {
    Entry() : rt::Message(nullptr) {}
    Tap* tap = nullptr;
    Arguments arguments;
    rt::InUse in_use;
  };

  Tap(component::EventBase& event, std::shared_ptr<rt::Inbox> inbox)
      : event_(event), inbox_(std::move(inbox)), entries_(kEventQueue) {
    for (Entry& entry : entries_) {
      entry.tap = this;
      for (const auto& argument : event.signature().arguments) {
        entry.arguments.emplace_back(*argument.type);
      }
    }
  }

  component::EventBase& event() const { return event_; }
  void event_raised(const void* const* arguments) noexcept override;
  std::uint64_t take_lost() {
    const std::uint64_t lost = lost_.load(std::memory_order_relaxed);
    return lost - std::exchange(told_, lost);
  }

 private:
  component::EventBase& event_;
  std::shared_ptr<rt::Inbox> inbox_;
  rt::EntryPool<Entry> entries_;
  std::atomic<std::uint64_t> lost_{0};
  std::uint64_t told_ = 0;
};

/// Arguments of events are trivially copyable.
void Events::Tap::event_raised(const void* const* arguments) noexcept {
  Entry* const entry = entries_.claim();
  if (entry == nullptr) {
    lost_.store(lost_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    return;
  }
  for (types::Value& value : entry->arguments) {
    std::memcpy(value.data(), *arguments++, value.type().size);
  }
  inbox_->push(*entry);
}

Events::Events(exec::Application& application)
    : application_(application), inbox_(std::make_shared<rt::Inbox>()) {}

Events::~Events() {
  for (std::unique_ptr<Tap>& tap : taps_) {
    Tap* const told = tap.release();  // stays where it is if its event might go on to tell it
    const auto remove = [told] { told->event().remove_tap(*told); };
    if (application_.run_in_thread_of(told->event().owner(), remove)) delete told;
  }
}

bool Events::tap(component::EventBase& event) {
  const bool tapped = std::any_of(taps_.begin(), taps_.end(),
                                  [&](const auto& tap) { return &tap->event() == &event; });
  if (tapped) return true;
  auto tap = std::make_unique<Tap>(event, inbox_);
  Tap* const told = tap.release();
  if (!application_.run_in_thread_of(event.owner(), [told] { told->event().add_tap(*told); })) {
    return false;  // it may still come to it
  }
  taps_.emplace_back(told);
  return true;
}

Events::Id Events::listen(component::EventBase& event, Listener listener) {
  if (!tap(event)) return kNobody;
  listeners_.push_back({++last_id_, &event, std::make_shared<const Listener>(std::move(listener))});
  return last_id_;
}

void Events::forget(Id id) {
  std::erase_if(listeners_, [id](const Registered& one) { return one.id == id; });
}

std::shared_ptr<const Events::Listener> Events::listener(Id id) const {
  const auto found = std::find_if(listeners_.begin(), listeners_.end(),
                                  [id](const Registered& one) { return one.id == id; });
  return found == listeners_.end() ? nullptr : found->listener;
}

bool Events::deliver_next(lua_State* lua) {
  if (pending_ == nullptr) pending_ = inbox_->take_all();
  if (pending_ == nullptr) return false;
  auto& entry = static_cast<Tap::Entry&>(*pending_);
  pending_ = rt::Inbox::next(entry);
  const component::EventBase* const event = &entry.tap->event();
  const Arguments arguments = entry.arguments;
  entry.in_use.give_back();
  std::vector<Id> ids;
  for (const Registered& one : listeners_) {
    if (one.event == event) ids.push_back(one.id);
  }
  for (const Id id : ids) {  // one may forget another
    if (const auto told = listener(id)) (*told)(lua, arguments);
  }
  return true;
}

std::vector<Events::Loss> Events::take_losses() {
  std::vector<Loss> losses;
  for (const std::unique_ptr<Tap>& tap : taps_) {
    const std::uint64_t count = tap->take_lost();
    const std::string name = tap->event().owner().name() + "." + std::string(tap->event().name());
    if (count > 0) losses.push_back({name, count});
  }
  return losses;
}

std::string text_of(const Events::Loss& loss) {
  return std::to_string(loss.count) + " of the events " + loss.event + " were lost: more than " +
         std::to_string(kEventQueue) + " came before the script looked";
}

int push_arguments(lua_State* lua, const Events::Arguments& arguments) {
  luaL_checkstack(lua, static_cast<int>(arguments.size()), "arguments");
  for (const types::Value& value : arguments) push_value(lua, value.type(), value.data());
  return static_cast<int>(arguments.size());
}

}  // namespace armature::lua::internal
