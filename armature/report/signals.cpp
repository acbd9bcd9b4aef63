// SPDX-License-Identifier: Apache-2.0
#include "armature/report/signals.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <nlohmann/json.hpp>

namespace armature::report {
namespace {

/// Takes one channel's samples apart.
class Unpacking {
 public:
  Unpacking(const record::RecordedChannel& channel, Signals& signals)
      : channel_(channel), signals_(signals) {}

  void add(const record::RecordedSample& sample) {
    const nlohmann::json value = nlohmann::json::parse(sample.json, nullptr, false);
    if (!value.is_object()) return;
    time_s_ = static_cast<double>(sample.time.time_since_epoch().count()) * 1e-9;
    const bool plain = value.size() == 1 && value.contains("value");
    add(plain ? value["value"] : value, channel_.name);
  }

 private:
  void add(const nlohmann::json& value, const std::string& name) {
    if (value.is_string()) {
      signals_.texts[name] = value.get<std::string>();
    } else if (value.is_array()) {
      for (std::size_t i = 0; i < value.size(); ++i) {
        std::string element = name;
        element.append("[").append(std::to_string(i)).append("]");
        add(value[i], element);
      }
    } else if (value.is_object()) {
      for (const auto& [field, inner] : value.items()) add(inner, name + '.' + field);
    } else {
      append(number(value), name);
    }
  }

  static double number(const nlohmann::json& value) {
    if (value.is_boolean()) return value.get<bool>() ? 1.0 : 0.0;
    return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
  }

  void append(double value, const std::string& name) {
    const auto [found, added] = index_.try_emplace(name, signals_.all.size());
    if (added) signals_.all.push_back({name, channel_.unit, channel_.doc, {}, {}});
    Signal& signal = signals_.all[found->second];
    if (!signal.time_s.empty() && time_s_ < signal.time_s.back()) return;
    signal.time_s.push_back(time_s_);
    signal.values.push_back(value);
  }

  const record::RecordedChannel& channel_;
  Signals& signals_;
  std::unordered_map<std::string, std::size_t> index_;
  double time_s_ = 0.0;
};

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// Takes the digits at the beginning of `text` away; without leading zeros.
std::string_view take_number(std::string_view& text) {
  std::size_t end = 0;
  while (end < text.size() && is_digit(text[end])) ++end;
  std::string_view number = text.substr(0, end);
  text.remove_prefix(end);
  while (number.size() > 1 && number.front() == '0') number.remove_prefix(1);
  return number;
}

/// Where they are.
struct Extremes {
  std::size_t least;
  std::size_t largest;
};

/// Of the values that are numbers from `begin` up to `end`; `begin` if none is.
Extremes extremes_of(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  Extremes found{begin, begin};
  for (std::size_t i = begin; i < end; ++i) {
    if (std::isnan(values[i])) continue;
    if (!(values[i] >= values[found.least])) found.least = i;
    if (!(values[i] <= values[found.largest])) found.largest = i;
  }
  return found;
}

}  // namespace

const Signal* Signals::find(const std::string& name) const {
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const Signal& signal) { return signal.name == name; });
  return found == all.end() ? nullptr : &*found;
}

Signals signals_of(const record::McapRecording& recording) {
  Signals signals;
  std::vector<std::vector<const record::RecordedSample*>> by_channel(recording.channels.size());
  for (const record::RecordedSample& sample : recording.samples) {
    by_channel[sample.channel].push_back(&sample);
  }
  for (std::size_t i = 0; i < by_channel.size(); ++i) {
    // Frames and joint states for other programs, which follow from ports that are recorded.
    if (recording.channels[i].name.starts_with('/')) continue;
    Unpacking unpacking(recording.channels[i], signals);
    for (const record::RecordedSample* sample : by_channel[i]) unpacking.add(*sample);
  }
  return signals;
}

std::vector<const Signal*> elements_of_port(const Signals& signals, const std::string& port) {
  std::vector<const Signal*> elements;
  std::string owner;
  for (const Signal& signal : signals.all) {
    const std::size_t bracket = signal.name.find('[');
    if (bracket == std::string::npos) continue;
    const std::string name = signal.name.substr(0, bracket);
    if (!name.ends_with(port)) continue;
    if (owner.empty()) owner = name;
    if (name == owner) elements.push_back(&signal);
  }
  return elements;
}

std::optional<double> limit_in(const Signals& signals, const std::string& name, std::size_t joint) {
  const bool for_each = signals.find(name + "[1]") != nullptr;
  const Signal* limit = signals.find(name + '[' + std::to_string(for_each ? joint : 0) + ']');
  if (limit == nullptr) limit = signals.find(name);
  if (limit == nullptr || limit->values.empty()) return std::nullopt;
  return limit->values.back();
}

double begin_at_zero(Signals& signals) {
  double begin_s = std::numeric_limits<double>::infinity();
  for (const Signal& signal : signals.all) {
    if (!signal.time_s.empty()) begin_s = std::min(begin_s, signal.time_s.front());
  }
  if (!std::isfinite(begin_s)) return 0.0;
  begin_at(begin_s, signals);
  return begin_s;
}

void begin_at(double begin_s, Signals& signals) {
  for (Signal& signal : signals.all) {
    for (double& time_s : signal.time_s) time_s -= begin_s;
  }
}

bool before_by_number(const std::string& left, const std::string& right) {
  std::string_view a = left;
  std::string_view b = right;
  while (!a.empty() && !b.empty()) {
    if (is_digit(a.front()) && is_digit(b.front())) {
      const std::string_view x = take_number(a);
      const std::string_view y = take_number(b);
      if (x != y) return std::pair(x.size(), x) < std::pair(y.size(), y);
    } else {
      if (a.front() != b.front()) return a.front() < b.front();
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  return a.size() < b.size();
}

std::optional<std::string> joint_named(std::string_view component) {
  constexpr std::string_view kJoint = "Joint";
  constexpr std::string_view kPart = ".Joint";
  if (component.ends_with(kPart)) {
    component.remove_suffix(kPart.size());
    const std::size_t last = component.find_last_not_of("0123456789");
    const bool numbered = last != std::string_view::npos && last + 1 < component.size();
    return std::string(numbered ? component.substr(last + 1) : component);
  }
  if (!component.starts_with(kJoint)) return std::nullopt;
  return std::string(component.substr(kJoint.size()));
}

Signal thinned(const Signal& signal, std::size_t most) {
  const std::size_t size = signal.values.size();
  if (size <= most) return signal;
  Signal thin{signal.name, signal.unit, signal.doc, {}, {}};
  const auto keep = [&](std::size_t i) {
    thin.time_s.push_back(signal.time_s[i]);
    thin.values.push_back(signal.values[i]);
  };
  const std::size_t stretches = std::max<std::size_t>(most / 2, 1);
  for (std::size_t stretch = 0; stretch < stretches; ++stretch) {
    const Extremes found =
        extremes_of(signal.values, stretch * size / stretches, (stretch + 1) * size / stretches);
    keep(std::min(found.least, found.largest));
    if (found.least != found.largest) keep(std::max(found.least, found.largest));
  }
  return thin;
}

}  // namespace armature::report
