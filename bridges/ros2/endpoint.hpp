// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/component/observing/observer.hpp"
#include "bridges/ros2/node.hpp"

namespace armature::ros2 {

/// What components that speak with a topic have in common: they find the application's node, and
/// refuse to start in a thread of the control. To be extended by what is read or written.
/// @thread the component's own, which is shared by components of this library only
class Endpoint : public component::Component, private component::Observer {
 public:
  explicit Endpoint(std::string name) : Component(std::move(name)), Observer(this) {}

 protected:
  using Components = std::vector<component::Component*>;
  using component::Observer::Objection;

  /// What is wrong with its properties; changes nothing.
  virtual std::vector<Objection> objections(const Components& components) const;
  /// Opens what it reads and writes, before anybody runs.
  /// @return why it cannot; empty if it can
  virtual std::string open(const component::Surroundings& surroundings) = 0;
  /// Closes that.
  virtual void close() = 0;
  /// It starts, and works with DDS.
  virtual void begin() {}
  /// Its update; it may allocate and wait.
  virtual void work() = 0;
  /// It stops or fails: what it has begun elsewhere ends.
  virtual void end() {}

  /// Of the application; known from `open` on.
  RosNode& node() const { return *node_; }
  std::unique_ptr<Writer> writer(const std::string& topic, const dds_topic_descriptor& type,
                                 const Quality& quality);
  std::unique_ptr<Reader> reader(const std::string& topic, const dds_topic_descriptor& type,
                                 const Quality& quality);

 private:
  std::vector<Objection> check_view(const Components& components) const final;
  void observe(const component::Surroundings& surroundings) final;
  component::Outcome on_start() final;
  void on_update() final;
  void on_stop() final { end(); }
  void on_cleanup() final;

  RosNode* node_ = nullptr;
  std::string refused_;
};

/// An endpoint that writes; it counts what it wrote, and what was lost on the way.
class Publisher : public Endpoint {
 public:
  using Endpoint::Endpoint;

 protected:
  /// Writes a sample, and counts it.
  void publish(Writer& writer, const void* sample);
  /// Counts samples that found no room on the way from their port.
  void count_lost(std::uint64_t more);
  void begin() override;
  /// What was told so far goes to the ports.
  void tell();

 private:
  component::OutputPort<std::uint64_t> published_{this, "Published", "messages since the start"};
  component::OutputPort<std::uint64_t> lost_{
      this, "Lost", "samples since the start that are no message: this component came too late"};
  std::uint64_t published_count_ = 0;
  std::uint64_t lost_count_ = 0;
  bool told_loss_ = false;
};

/// An endpoint that reads: it refuses a message as a whole, counts that, and logs the first one of
/// a series.
///
/// What waited while its thread was held up for half a second is refused, too: it is too old.
///
/// Nothing goes on by itself. With Arming among its peers, it hears nobody before the operator has
/// armed the robot. Who is there when the operator arms, disarms or stops it, or this component
/// starts, is not heard any more; nor is who comes within `max_silence` after that. Who begins
/// later may command: a program that makes its publisher anew.
///
/// What it leads to is checked: an effort only behind a component that takes commands and brakes at
/// the operator's stop, such as a generator of motions or a chassis, which keeps the limits. Where
/// it leads to one of these, it must be told of the same operator: it needs Arming among its peers.
class Subscriber : public Endpoint {
 public:
  using Endpoint::Endpoint;

 protected:
  void on_check(component::Check& check) const override;
  void begin() override;
  /// Takes what has come: `obey` answers why it refuses a message, or nothing.
  void receive(Reader& reader, const std::function<std::string(const void* sample)>& obey);
  void refuse(std::string_view why);
  /// Who is there is not heard any more, nor who comes within `max_silence`.
  void deafen();
  bool is_deaf() const { return deaf_ || deafened_; }
  /// No message was obeyed for `max_silence`.
  bool is_silent() const;
  /// An input that it writes without a connection; nullptr: none.
  virtual const component::InputPortBase* written_input(const component::Check& check) const;
  /// It commands motions, whatever it is connected to.
  virtual bool moves_robots() const { return false; }

  component::Property<double> max_silence_{
      this, "max_silence",
      0.5,  "without a message for so long, who sent them is gone",
      "s",  component::range(0.02, 10.0)};

 private:
  void arm();
  void disarm();

  component::EventHandler<> armed_{this,
                                   "Arm",
                                   component::serve<&Subscriber::arm>,
                                   "the operator has armed the robot",
                                   component::optional,
                                   component::leads_to_nothing()};
  component::EventHandler<> disarmed_{this,
                                      "Disarm",
                                      component::serve<&Subscriber::disarm>,
                                      "the robot is disarmed",
                                      component::optional,
                                      component::leads_to_nothing()};
  component::EventHandler<> stopped_{this,
                                     "Stop",
                                     component::serve<&Subscriber::deafen>,
                                     "the operator stops the robot",
                                     component::optional,
                                     component::leads_to_nothing()};
  component::OutputPort<std::uint64_t> received_{this, "Received",
                                                 "messages since the start that were obeyed"};
  component::OutputPort<std::uint64_t> refusals_{this, "Refused",
                                                 "messages since the start that were not"};
  void expect_arming(component::Check& check,
                     const std::vector<const component::Component*>& commanded) const;
  bool was_held_up();
  std::string objection_to(const Sender* sender);

  std::uint64_t received_count_ = 0;
  std::uint64_t refused_count_ = 0;
  bool refuses_ = false;       ///< the last one was refused
  bool disarmed_now_ = false;  ///< and nobody is heard
  bool deafened_ = false;      ///< since the last update
  bool deaf_ = false;          ///< in this update
  base::Time deaf_until_{};
  std::set<Sender> ignored_;  ///< for good
  base::Time updated_at_{};
  base::Time heard_at_{};
};

/// What reads messages takes so many in an update at most.
inline constexpr std::size_t kMostInAnUpdate = 256;
/// What they promise: a thread that is held up loses none of so many.
inline constexpr Quality kCommands{.depth = kMostInAnUpdate};

}  // namespace armature::ros2
