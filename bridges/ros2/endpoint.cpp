// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/endpoint.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/component/face.hpp"
#include "armature/component/host.hpp"
#include "armature/rt/guard.hpp"
#include "bridges/ros2/internal/own_thread.hpp"
#include "bridges/ros2/internal/reach_check.hpp"

namespace armature::ros2 {

using component::Component;
using component::Outcome;

namespace {

RosNode* find_node(const std::vector<Component*>& components) {
  for (Component* each : components) {
    if (auto* const node = dynamic_cast<RosNode*>(each)) return node;
  }
  return nullptr;
}

bool is_of_this_library(const Component& component) {
  return dynamic_cast<const Endpoint*>(&component) != nullptr ||
         dynamic_cast<const RosNode*>(&component) != nullptr;
}

}  // namespace

std::string internal::objection_to_thread(const Component& component,
                                          const component::Surroundings& surroundings) {
  const component::ExecutionContext& own = component::Host::context(component);
  constexpr const char* kHint = "give it activity: {periodic: 2 ms, scheduler: other, thread: ros}";
  if (own.real_time) return std::string("it works with DDS in a real-time thread: ") + kHint;
  for (const Component* each : surroundings.components) {
    if (&component::Host::context(*each) != &own || is_of_this_library(*each)) continue;
    return "it works with DDS in the thread of '" + each->name() + "': " + kHint;
  }
  return {};
}

std::vector<Endpoint::Objection> Endpoint::objections(const Components& /*components*/) const {
  return {};
}

std::vector<Endpoint::Objection> Endpoint::check_view(const Components& components) const {
  std::vector<Objection> found = objections(components);
  if (find_node(components) == nullptr) {
    found.push_back({"there is no RosNode, which says how ROS 2 is reached",
                     "add Ros: {model: RosNode, activity: {periodic: 2 ms, scheduler: other, "
                     "thread: ros}}"});
  }
  return found;
}

void Endpoint::observe(const component::Surroundings& surroundings) {
  node_ = find_node(surroundings.components);
  refused_ = internal::objection_to_thread(*this, surroundings);
  if (!refused_.empty()) return;
  if (const auto opened = node_->participant(); !opened) {
    refused_ = opened.error();
    return;
  }
  if (std::string wrong = open(surroundings); !wrong.empty()) refused_ = std::move(wrong);
}

std::unique_ptr<Writer> Endpoint::writer(const std::string& topic, const dds_topic_descriptor& type,
                                         const Quality& quality) {
  auto made = node_->participant().value()->write_to(topic, type, quality);
  if (made) return std::move(made).value();
  refused_ = made.error();
  return nullptr;
}

std::unique_ptr<Reader> Endpoint::reader(const std::string& topic, const dds_topic_descriptor& type,
                                         const Quality& quality) {
  auto made = node_->participant().value()->read_from(topic, type, quality);
  if (made) return std::move(made).value();
  refused_ = made.error();
  return nullptr;
}

Outcome Endpoint::on_start() {
  if (!refused_.empty()) return component::refused(refused_);
  const rt::PermitScope allocates;
  begin();
  return component::accepted();
}

void Endpoint::on_update() {
  const rt::PermitScope waits_for_dds;  // in a thread in which nobody else waits for it
  try {
    work();
  } catch (...) {
    end();
    throw;  // a fault of this component
  }
}

void Endpoint::on_cleanup() {
  close();
  node_ = nullptr;
  refused_.clear();
}

void Publisher::begin() {
  published_count_ = lost_count_ = 0;
  told_loss_ = false;
  tell();
}

void Publisher::publish(Writer& writer, const void* sample) {
  if (writer.write(sample)) {
    ++published_count_;
  } else {
    count_lost(1);
  }
}

void Publisher::count_lost(std::uint64_t more) {
  lost_count_ += more;
  if (more == 0 || std::exchange(told_loss_, true)) return;
  log_warning("a sample was lost on its way to ROS 2; the port Lost counts them");
}

void Publisher::tell() {
  published_.write(published_count_);
  lost_.write(lost_count_);
}

void Subscriber::on_check(component::Check& check) const {
  expect_arming(check, internal::check_reach(*this, written_input(check), check));
}

const component::InputPortBase* Subscriber::written_input(const component::Check& /*check*/) const {
  return nullptr;
}

void Subscriber::begin() {
  received_count_ = refused_count_ = 0;
  refuses_ = false;
  heard_at_ = updated_at_ = time();
  disarmed_now_ = face(armed_).source() != nullptr;
  deafen();
  received_.write(0);
  refusals_.write(0);
}

void Subscriber::arm() {
  disarmed_now_ = false;
  deafen();
}

void Subscriber::disarm() {
  disarmed_now_ = true;
  deafen();
}

void Subscriber::deafen() {
  deafened_ = true;
  deaf_until_ = time() + base::from_seconds(max_silence_);
}

bool Subscriber::is_silent() const { return time() - heard_at_ > base::from_seconds(max_silence_); }

/// @param commanded  components that move the robot as this one says
void Subscriber::expect_arming(component::Check& check,
                               const std::vector<const Component*>& commanded) const {
  if (commanded.empty() && !moves_robots()) return;
  const component::EventBase* const arms = check.source_of(armed_);
  const component::EventBase* const stops = check.source_of(stopped_);
  if (arms == nullptr || check.source_of(disarmed_) == nullptr || stops == nullptr) {
    return check.error(
        "it is not told when the operator arms or stops the robot, and would go on by itself",
        "add Arming to its peers");
  }
  for (const Component* each : commanded) {
    const Component& brakes = *internal::brakes(*each, check);
    if (&brakes == &stops->owner()) continue;
    check.error("it commands '" + each->name() + "', which '" + brakes.name() +
                    "' stops, and is told of '" + stops->owner().name() + "'",
                "give both the same Arming as a peer");
  }
}

bool Subscriber::was_held_up() {
  constexpr base::Duration kLongest = std::chrono::milliseconds(500);
  return time() - std::exchange(updated_at_, time()) > std::max(kLongest, 2 * period());
}

void Subscriber::receive(Reader& reader, const std::function<std::string(const void*)>& obey) {
  const bool too_old = was_held_up();
  deaf_ = std::exchange(deafened_, false) || time() < deaf_until_;
  if (deaf_) {
    for (const Sender& each : reader.senders()) ignored_.insert(each);
  }
  reader.take(kMostInAnUpdate, [&](const void* sample, const Sender* sender) {
    std::string why = objection_to(sender);
    if (why.empty() && too_old) why = "it waited while the thread of this component was held up";
    if (why.empty()) why = obey(sample);
    if (!why.empty()) return refuse(why);
    heard_at_ = time();
    refuses_ = false;
    received_.write(++received_count_);
  });
}

std::string Subscriber::objection_to(const Sender* sender) {
  if (sender == nullptr) return "who sent it has gone already";
  if (disarmed_now_) return "the robot is not armed";
  if (!ignored_.contains(*sender)) return {};
  return "nothing goes on by itself: its sender was there when the robot was armed or stopped, or "
         "this component started, and must begin anew";
}

void Subscriber::refuse(std::string_view why) {
  refusals_.write(++refused_count_);
  if (std::exchange(refuses_, true)) return;
  constexpr std::size_t kPart = 95;  // of a text in a log line
  log_warning("refused a message: {}{}", why.substr(0, kPart),
              why.substr(std::min(kPart, why.size())));
}

}  // namespace armature::ros2
