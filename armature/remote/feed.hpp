// SPDX-License-Identifier: Apache-2.0
#pragma once

// What components raise and write, on its way to subscribers in other processes. The component
// never waits: what finds no room is dropped and counted. A feed that nobody subscribed to is not
// attached, and costs nothing.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/component/events/event_tap.hpp"
#include "armature/component/observing/tap.hpp"
#include "armature/rt/ring.hpp"

namespace armature::remote {

/// Runs work in the component's thread; false if it was not done in time.
using RunInThread = std::function<bool(component::Component&, std::function<void()>)>;

/// So many of an event, or samples of a port, may wait to be sent.
inline constexpr std::size_t kFeedCapacity = 64;

/// What an event or a port has for others while it is open.
/// @thread the controlling one
class Feed {
 public:
  explicit Feed(RunInThread run) : run_(std::move(run)) {}
  Feed(const Feed&) = delete;
  Feed& operator=(const Feed&) = delete;
  virtual ~Feed() = default;

  bool attached() const { return attached_; }
  /// What was dropped since it was asked last.
  virtual std::uint64_t take_dropped() = 0;

 protected:
  /// False if it was not done in time: it may be done later, so that what it uses has to stay.
  bool run(component::Component& owner, std::function<void()> work) const {
    return run_(owner, std::move(work));
  }
  void set_attached(bool attached) { attached_ = attached; }

 private:
  RunInThread run_;
  bool attached_ = false;
};

/// Each time that an event is raised.
class EventFeed final : public Feed {
 public:
  EventFeed(component::EventBase& event, RunInThread run);
  ~EventFeed() override;

  void open();
  void close();
  /// Calls `use` for each that waits, with its arguments.
  void take(const std::function<void(const void* const* arguments)>& use);
  std::uint64_t take_dropped() override;

 private:
  class Tap;
  component::EventBase& event_;
  std::unique_ptr<Tap> tap_;
};

/// Each sample that an output writes.
class PortFeed final : public Feed {
 public:
  PortFeed(component::OutputPortBase& port, RunInThread run);
  ~PortFeed() override;

  /// The value that the port holds now.
  struct Present {
    types::Value value;
    std::uint64_t sequence;  ///< 0: nothing was written yet
    base::Time time;
  };

  void open();
  void close();
  /// What the port held when `open` was called last; nullptr if its thread did not answer.
  const Present* present() const { return present_.get(); }
  /// Calls `use` for each sample that waits.
  void take(const std::function<void(const component::TappedSample&, const void* value)>& use);
  std::uint64_t take_dropped() override;

 private:
  /// Has the port's thread look at its value, and do `also` at that moment.
  bool look(std::function<void()> also);

  component::OutputPortBase& port_;
  std::unique_ptr<Present> present_;
  std::unique_ptr<component::AttachedTap> tap_;
  component::TappedSample sample_;
  types::Value value_;
  std::uint64_t told_ = 0;
};

}  // namespace armature::remote
