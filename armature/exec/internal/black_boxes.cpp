// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/black_boxes.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include "armature/component/author.hpp"
#include "armature/component/host.hpp"

namespace armature::exec::internal {
namespace {

using component::BlackBox;
using component::Component;

/// What a fault sets off is part of it.
constexpr base::Duration kAftermath = std::chrono::milliseconds(200);
/// A component that faults again and again fills no disk: of more faults only those of another kind
/// are written.
constexpr int kMostReports = 4;
constexpr std::size_t kMostKinds = 32;
constexpr std::size_t kNotes = 48;  // of each thread
constexpr std::size_t kFewestPictures = 4;

/// So many values are copied in a millisecond: half a percent of a thread's time. Simulated time
/// passes as fast as threads compute, so that there it is no more than a few percent of that,
/// unless whoever deploys it has reserved memory for more.
constexpr std::size_t kValuesPerMillisecond = 1024;
constexpr std::size_t kValuesPerSimulatedMillisecond = 8;

std::size_t simulated_rate(std::size_t memory) {
  const std::size_t in_proportion =
      kValuesPerSimulatedMillisecond * memory / BlackBoxOptions{}.memory;
  return std::clamp(in_proportion, kValuesPerSimulatedMillisecond, kValuesPerMillisecond);
}

base::Duration interval_for(std::size_t values, std::size_t rate) {
  return std::chrono::milliseconds(1 + values / rate);
}

/// How often a thread has a cycle, as far as that is known.
base::Duration period_of(const ThreadPlan& thread) {
  return std::max(thread.activity.period, thread.trigger_period);
}

struct Room {
  std::size_t pictures;
  base::Duration interval;
};

/// Of a thread that shares the memory with the others in proportion to what each wants.
Room room_for(std::size_t picture, base::Duration interval, const BlackBoxOptions& options,
              double share) {
  const auto all = static_cast<double>(options.history / std::max(interval, base::Duration(1)) + 1);
  const auto pictures = std::max(static_cast<std::size_t>(all * share), kFewestPictures);
  const base::Duration least = options.history / 4;
  const auto count = static_cast<std::int64_t>(pictures);
  if (picture == 0) return {0, interval};
  return {pictures, std::max(interval, least / count)};
}

std::string dotted(const Component& component, std::string_view member) {
  return component.name() + "." + std::string(member);
}

BlackBoxReport::Channel channel_of(const BlackBox::Channel& channel) {
  if (channel.port == nullptr) {
    return {dotted(channel.event->owner(), channel.event->name()),
            types::Value::of(std::uint64_t{0}),
            {},
            "how often it was raised"};
  }
  const component::OutputPortBase& port = *channel.port;
  return {dotted(port.owner(), port.name()),
          channel.shape ? *channel.shape : types::Value(port.type()), std::string(port.unit()),
          std::string(port.doc())};
}

}  // namespace

void BlackBoxes::set_engines(const std::vector<std::unique_ptr<Engine>>& engines,
                             const Blueprint& blueprint, const Plan& plan, bool simulated) {
  boxes_.clear();
  noticed_.reset();
  written_ = 0;
  kinds_.clear();
  if (!options_.write || options_.history <= base::Duration::zero()) return;
  const std::size_t rate = simulated ? simulated_rate(options_.memory) : kValuesPerMillisecond;
  double wanted = 0.0;
  std::vector<base::Duration> intervals;
  for (std::size_t t = 0; t < engines.size(); ++t) {
    boxes_.push_back({std::make_shared<Box>(), plan.threads[t].name});
    Box& box = *boxes_.back().box;
    for (const Index each : plan.threads[t].members) {
      const Component& component = *blueprint.components[each].component;
      if (&component::Host::context(component) == &engines[t]->context()) box.add(component);
    }
    intervals.push_back(std::max(interval_for(box.values(), rate), period_of(plan.threads[t])));
    wanted += static_cast<double>(box.picture_size()) *
              static_cast<double>(options_.history / intervals.back() + 1);
  }
  const double share = std::min(1.0, static_cast<double>(options_.memory) / std::max(wanted, 1.0));
  for (std::size_t t = 0; t < engines.size(); ++t) {
    Box& box = *boxes_[t].box;
    const Room room = room_for(box.picture_size(), intervals[t], options_, share);
    const bool idle = plan.threads[t].members.empty();
    box.reserve(room.pictures, idle ? 0 : kNotes, room.interval);
    engines[t]->keep_black_box(boxes_[t].box);
  }
}

std::string BlackBoxes::write_if_due(Incidents& incidents, base::Time now) {
  if (boxes_.empty() || incidents.first() == nullptr) return {};
  if (!noticed_) noticed_ = now;
  if (now < *noticed_ + kAftermath) return {};
  return write_last(incidents, now);
}

std::string BlackBoxes::write_last(Incidents& incidents, base::Time now) {
  if (boxes_.empty()) return {};
  const Component* const first = incidents.take_first();
  noticed_.reset();
  return first == nullptr ? std::string() : write(*first, now);
}

std::string BlackBoxes::write(const Component& first, base::Time now) {
  try {
    const BlackBoxReport report = report_of(first, now);
    const bool is_new = is_another_kind(report);
    if (!is_new && written_ >= kMostReports) return {};
    const bool last = ++written_ == kMostReports;
    const std::string said = options_.write(report);
    return last ? said + "; from now on only faults of another kind are kept" : said;
  } catch (const std::exception& thrown) {
    return std::string("black box: ") + thrown.what();
  }
}

/// The kind of a fault is whose it is and what it says, without its figures.
bool BlackBoxes::is_another_kind(const BlackBoxReport& report) {
  std::string kind = report.component + ": " + report.reason;
  std::erase_if(kind, [](char one) { return one >= '0' && one <= '9'; });
  const bool known = std::ranges::find(kinds_, kind) != kinds_.end();
  if (known || kinds_.size() == kMostKinds) return false;
  kinds_.push_back(std::move(kind));
  return true;
}

BlackBoxReport BlackBoxes::report_of(const Component& first, base::Time now) const {
  BlackBoxReport report;
  report.component = first.name();
  report.time = now;
  for (const Kept& kept : boxes_) add_box(kept, report);
  const auto by_time = [](const auto& a, const auto& b) { return a.time < b.time; };
  std::stable_sort(report.samples.begin(), report.samples.end(), by_time);
  std::stable_sort(report.happenings.begin(), report.happenings.end(), by_time);
  const auto decisive = std::find_if(
      report.happenings.rbegin(), report.happenings.rend(), [&](const auto& happening) {
        return happening.component == report.component &&
               (happening.kind == name_of(BlackBox::Note::Kind::kFault) ||
                happening.kind == name_of(BlackBox::Note::Kind::kReaction));
      });
  if (decisive != report.happenings.rend()) {
    report.reason = decisive->text;
    report.time = decisive->time;
  }
  return report;
}

void BlackBoxes::add_box(const Kept& kept, BlackBoxReport& report) const {
  const Box& box = *kept.box;
  const std::optional<Box::Content> content = box.copy();
  if (!content) {
    report.incomplete += "nothing of the thread '" + kept.thread + "', which hangs; ";
    return;
  }
  if (box.missed() > 0) {
    report.incomplete += std::to_string(box.missed()) + " entries of the thread '" + kept.thread +
                         "', which came while it was read; ";
  }
  for (const Box::Channel& channel : box.channels()) {
    const std::size_t number = report.channels.size();
    report.channels.push_back(channel_of(channel));
    for (std::size_t i = 0; i < content->times.size(); ++i) {
      const types::Value value =
          Box::value_in(content->pictures.data() + i * box.picture_size(), channel);
      BlackBoxReport::Sample sample{number, content->times[i], {}};
      types::encode(value.type(), value.data(), sample.value);
      report.samples.push_back(std::move(sample));
    }
  }
  for (const Box::Note& note : content->notes) {
    report.happenings.push_back({note.time, note.component->name(), std::string(name_of(note.kind)),
                                 std::string(note.item), std::string(note.text.view())});
  }
}

}  // namespace armature::exec::internal
