// SPDX-License-Identifier: Apache-2.0
#include "armature/replay/comparison.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace armature::replay {
namespace {

using record::McapRecording;
using record::RecordedSample;

using InOrder = std::vector<const RecordedSample*>;

std::map<std::string, InOrder> by_channel(const McapRecording& recording) {
  std::map<std::string, InOrder> channels;
  for (const record::RecordedChannel& channel : recording.channels) channels[channel.name];
  for (const RecordedSample& sample : recording.samples) {
    channels[recording.channels[sample.channel].name].push_back(&sample);
  }
  return channels;
}

bool is_numbered(const InOrder& samples) {
  std::set<std::uint32_t> numbers;
  return std::ranges::all_of(samples, [&numbers](const RecordedSample* sample) {
    return numbers.insert(sample->sequence).second;
  });
}

/// By what a sample is found in the other recording: its number; where numbers come again, as in
/// channels that nobody counts, the time and how many came at that time before.
using Key = std::tuple<std::uint32_t, base::Time, std::size_t>;
using Samples = std::map<Key, const RecordedSample*>;

Samples by_key(const InOrder& samples, bool numbered) {
  Samples keyed;
  for (const RecordedSample* const sample : samples) {
    Key key{sample->sequence, numbered ? base::Time{} : sample->time, 0};
    while (!keyed.emplace(key, sample).second) ++std::get<2>(key);
  }
  return keyed;
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

/// Follows the data of one instant downstream.
class Downstream {
 public:
  /// @param equal  channels that are as they were at that time: nothing comes through them
  Downstream(const std::vector<Flow>& flows, const std::set<std::string>& equal) {
    for (const Flow& flow : flows) {
      writers_[flow.to] = component_of(flow.from);
      if (!equal.contains(flow.from) && !equal.contains(flow.to)) flows_.push_back(flow);
    }
  }

  /// Who writes what is recorded under this name.
  std::string writer_of(const std::string& channel) const {
    const auto writer = writers_.find(channel);
    return writer == writers_.end() ? std::string(component_of(channel)) : writer->second;
  }

  /// The components that the channel's data reaches.
  std::set<std::string> reached_from(const std::string& channel) const {
    std::set<std::string> reached;
    std::vector<std::string> open;
    const auto reach = [&](const Flow& flow) {
      std::string reader(component_of(flow.to));
      if (reached.insert(reader).second) open.push_back(std::move(reader));
    };
    for (const Flow& flow : flows_) {
      if (flow.from == channel || flow.to == channel) reach(flow);
    }
    while (!open.empty()) {
      const std::string component = std::move(open.back());
      open.pop_back();
      for (const Flow& flow : flows_) {
        if (component_of(flow.from) == component) reach(flow);
      }
    }
    return reached;
  }

 private:
  std::vector<Flow> flows_;                     ///< on which something may have come
  std::map<std::string, std::string> writers_;  ///< of inputs
};

class Comparer {
 public:
  Comparer(const ComparisonOptions& options, base::Time end) : options_(options), end_(end) {}

  void compare(const std::string& channel, const Samples& was, const Samples& is) {
    channel_ = &channel;
    const std::uint64_t equal_before = found_.equal;
    found_.compared.push_back(channel);
    differs_ = false;
    auto old = was.begin();
    auto now = is.begin();
    while (old != was.end() || now != is.end()) {
      const bool only_old = now == is.end() || (old != was.end() && old->first < now->first);
      const bool only_now = old == was.end() || (now != is.end() && now->first < old->first);
      const RecordedSample* const before = only_now ? nullptr : old->second;
      const RecordedSample* const after = only_old ? nullptr : now->second;
      look(std::get<0>(only_now ? now->first : old->first), before, after);
      if (!only_now) ++old;
      if (!only_old) ++now;
    }
    if (found_.equal > equal_before) ++found_.channels;
  }

  Comparison take() { return std::move(found_); }
  Comparison& found() { return found_; }

 private:
  void look(std::uint32_t number, const RecordedSample* was, const RecordedSample* is) {
    const base::Time time = was == nullptr  ? is->time
                            : is == nullptr ? was->time
                                            : std::min(was->time, is->time);
    if (time >= end_) return;
    if (was == nullptr && options_.losses) {
      ++found_.missing;
      return;
    }
    const bool shifted = options_.times && was != nullptr && is != nullptr && was->time != is->time;
    if (was != nullptr && is != nullptr && !shifted && was->json == is->json) {
      ++found_.equal;
      return;
    }
    ++found_.different;
    if (!std::exchange(differs_, true)) {
      found_.differences.push_back(
          {*channel_, time, number, told(was, shifted), told(is, shifted)});
    }
  }

  const ComparisonOptions& options_;
  const base::Time end_;
  const std::string* channel_ = nullptr;
  bool differs_ = false;
  Comparison found_;
};

}  // namespace

void Comparison::add(Comparison other) {
  equal += other.equal;
  channels += other.channels;
  different += other.different;
  missing += other.missing;
  const auto append = [](auto& to, auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(only_recorded, other.only_recorded);
  append(differences, other.differences);
  append(compared, other.compared);
}

std::optional<Difference> Comparison::first(const std::vector<Flow>& flows,
                                            const std::vector<std::string>& order) const {
  if (differences.empty()) return std::nullopt;
  const base::Time earliest = std::ranges::min(differences, {}, &Difference::time).time;
  std::vector<Difference> candidates;
  std::set<std::string> unchanged(compared.begin(), compared.end());
  for (const Difference& each : differences) {
    if (each.time != earliest) continue;
    candidates.push_back(each);
    unchanged.erase(each.channel);
  }
  const Downstream downstream(flows, unchanged);
  std::ranges::stable_sort(candidates, {}, [&](const Difference& each) {
    return std::ranges::find(order, downstream.writer_of(each.channel)) - order.begin();
  });
  const auto leads_to = [&](const Difference& cause, const std::string& component) {
    return downstream.writer_of(cause.channel) != component &&
           downstream.reached_from(cause.channel).contains(component);
  };
  const auto source = std::ranges::find_if(candidates, [&](const Difference& each) {
    const std::string writer = downstream.writer_of(each.channel);
    return std::ranges::none_of(candidates,
                                [&](const Difference& other) { return leads_to(other, writer); });
  });
  return source == candidates.end() ? candidates.front() : *source;
}

Comparison compare(const McapRecording& was, const McapRecording& is,
                   const ComparisonOptions& options) {
  // Of the last time of a recording that was cut off, some samples may be missing.
  const base::Time end = was.closed ? options.until : std::min(options.until, last_time(was));
  Comparer comparer(options, end);
  const auto replayed = by_channel(is);
  for (const auto& [channel, samples] : by_channel(was)) {
    if (options.channels != nullptr && !options.channels->contains(channel)) continue;
    const auto other = replayed.find(channel);
    if (other == replayed.end()) {
      comparer.found().only_recorded.push_back(channel);
    } else {
      const bool numbered = is_numbered(samples) && is_numbered(other->second);
      comparer.compare(channel, by_key(samples, numbered), by_key(other->second, numbered));
    }
  }
  return comparer.take();
}

std::string_view component_of(std::string_view channel) {
  const std::string_view name = channel.substr(0, channel.find(" ("));
  return name.substr(0, name.rfind('.'));
}

}  // namespace armature::replay
