// SPDX-License-Identifier: Apache-2.0
#include "armature/replay/comparison.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace armature::replay {
namespace {

using record::McapRecording;
using record::RecordedSample;

/// Samples of one channel by their numbers. The first sample of a property may share its number
/// with none.
using Samples = std::map<std::uint32_t, const RecordedSample*>;

std::map<std::string, Samples> by_channel(const McapRecording& recording) {
  std::map<std::string, Samples> channels;
  for (const record::RecordedChannel& channel : recording.channels) channels[channel.name];
  for (const RecordedSample& sample : recording.samples) {
    channels[recording.channels[sample.channel].name].emplace(sample.sequence, &sample);
  }
  return channels;
}

base::Time last_time(const McapRecording& recording) {
  base::Time last = base::Time::min();
  for (const RecordedSample& sample : recording.samples) last = std::max(last, sample.time);
  return last;
}

std::string told(const RecordedSample* sample, bool with_time) {
  if (sample == nullptr) return "no such sample";
  return with_time ? sample->json + " at " + std::to_string(base::to_ns(sample->time)) + " ns"
                   : sample->json;
}

bool comes_before(const Difference& a, const Difference& b) {
  return std::tie(a.time, a.rank, a.channel, a.sequence) <
         std::tie(b.time, b.rank, b.channel, b.sequence);
}

class Comparer {
 public:
  Comparer(const ComparisonOptions& options, base::Time end) : options_(options), end_(end) {}

  void compare(const std::string& channel, const Samples& was, const Samples& is) {
    channel_ = &channel;
    bool any = false;
    auto old = was.begin();
    auto now = is.begin();
    while (old != was.end() || now != is.end()) {
      const bool only_old = now == is.end() || (old != was.end() && old->first < now->first);
      const bool only_now = old == was.end() || (now != is.end() && now->first < old->first);
      const RecordedSample* const before = only_now ? nullptr : old->second;
      const RecordedSample* const after = only_old ? nullptr : now->second;
      any |= look(only_now ? now->first : old->first, before, after);
      if (!only_now) ++old;
      if (!only_old) ++now;
    }
    if (any) ++found_.channels;
  }

  Comparison take() { return std::move(found_); }
  Comparison& found() { return found_; }

 private:
  /// @return whether they are equal
  bool look(std::uint32_t number, const RecordedSample* was, const RecordedSample* is) {
    const base::Time time = was == nullptr  ? is->time
                            : is == nullptr ? was->time
                                            : std::min(was->time, is->time);
    if (time >= end_) return false;
    if (was == nullptr && options_.losses) {
      ++found_.missing;
      return false;
    }
    const bool equal =
        was != nullptr && is != nullptr && was->time == is->time && was->json == is->json;
    if (equal) {
      ++found_.equal;
      return true;
    }
    const bool shifted = was != nullptr && is != nullptr && was->time != is->time;
    Difference difference{*channel_, time, number, told(was, shifted), told(is, shifted), rank()};
    if (!found_.first || comes_before(difference, *found_.first)) {
      found_.first = std::move(difference);
    }
    return false;
  }

  std::size_t rank() const {
    const auto place = std::ranges::find(options_.order, component_of(*channel_));
    return static_cast<std::size_t>(place - options_.order.begin());
  }

  const ComparisonOptions& options_;
  const base::Time end_;
  const std::string* channel_ = nullptr;
  Comparison found_;
};

}  // namespace

void Comparison::add(Comparison other) {
  equal += other.equal;
  channels += other.channels;
  missing += other.missing;
  only_recorded.insert(only_recorded.end(), other.only_recorded.begin(), other.only_recorded.end());
  if (!other.first) return;
  if (!first || comes_before(*other.first, *first)) first = std::move(other.first);
}

Comparison compare(const McapRecording& was, const McapRecording& is,
                   const ComparisonOptions& options) {
  // Of the last time of a recording that was cut off, some samples may be missing.
  const base::Time end = was.closed ? options.until : std::min(options.until, last_time(was));
  Comparer comparer(options, end);
  const auto replayed = by_channel(is);
  for (const auto& [channel, samples] : by_channel(was)) {
    const std::string owner(component_of(channel));
    if (std::ranges::find(options.left_out, owner) != options.left_out.end()) continue;
    const auto other = replayed.find(channel);
    if (other == replayed.end()) {
      comparer.found().only_recorded.push_back(channel);
    } else {
      comparer.compare(channel, samples, other->second);
    }
  }
  return comparer.take();
}

std::string_view component_of(std::string_view channel) {
  const std::string_view name = channel.substr(0, channel.find(" ("));
  return name.substr(0, name.rfind('.'));
}

}  // namespace armature::replay
