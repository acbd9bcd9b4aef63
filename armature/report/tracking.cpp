// SPDX-License-Identifier: Apache-2.0
#include "armature/report/tracking.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "armature/base/seconds.hpp"

namespace armature::report {
namespace {

constexpr double kTwoPi = 6.283185307179586476925286766559;
constexpr double kSettling_s = 2.0;  ///< after a motion a joint should be where it was sent
constexpr double kLately_s = 10.0;
constexpr double kArming_s = 2.0;
constexpr double kNever = std::numeric_limits<double>::infinity();

bool ends_in(const std::string& text, const std::string& ending) {
  return text.size() >= ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

/// `PID12` -> `12`; a name without a number stays.
std::string number_of(const std::string& component) {
  const std::size_t last = component.find_last_not_of("0123456789");
  const bool numbered = last != std::string::npos && last + 1 < component.size();
  return numbered ? component.substr(last + 1) : component;
}

/// The value that was there at each of the times; nan before the first one.
std::vector<double> values_at(const std::vector<double>& times, const Signal& signal) {
  std::vector<double> values;
  values.reserve(times.size());
  std::size_t next = 0;
  for (const double time : times) {
    while (next < signal.time_s.size() && signal.time_s[next] <= time) ++next;
    values.push_back(next == 0 ? std::numeric_limits<double>::quiet_NaN()
                               : signal.values[next - 1]);
  }
  return values;
}

/// Just before each measurement; behind a gap, as after a restart, with it, since what was there
/// before the gap is forgotten.
std::vector<double> just_before(std::vector<double> times, double period_s) {
  double last_s = -kNever;
  for (double& time : times) {
    const bool gap = last_s > -kNever && time - last_s > 1.5 * period_s;
    last_s = time;
    if (!gap) time = std::nextafter(time, -kNever);
  }
  return times;
}

double median_period(const std::vector<double>& times) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < times.size(); ++i) periods.push_back(times[i] - times[i - 1]);
  if (periods.empty()) return 0.0;
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  return std::round(*middle * 1e9) / 1e9;
}

/// What a reference of the same cycle as a measurement is: for that, or for the next one.
enum class SameCycle { kForThis, kForNext };

Joint make_joint(std::string name, const Signal& desired, const Signal& measured, SameCycle same) {
  Joint joint;
  joint.name = std::move(name);
  joint.desired_from = desired.name;
  joint.measured_from = measured.name;
  joint.time_s = measured.time_s;
  joint.measured = measured.values;
  joint.period_s = median_period(joint.time_s);
  joint.desired = values_at(
      same == SameCycle::kForThis ? joint.time_s : just_before(joint.time_s, joint.period_s),
      desired);
  return joint;
}

std::vector<Joint> joints_with_a_controller_each(const Signals& signals) {
  std::vector<std::pair<std::string, Joint>> found;
  for (const Signal& desired : signals.all) {
    if (!ends_in(desired.name, ".Ref")) continue;
    const std::string component = desired.name.substr(0, desired.name.size() - 4);
    const Signal* const measured = signals.find(component + ".Sen");
    if (measured == nullptr) continue;
    found.emplace_back(component,
                       make_joint(number_of(component), desired, *measured, SameCycle::kForThis));
  }
  std::sort(found.begin(), found.end(),
            [](const auto& a, const auto& b) { return before_by_number(a.first, b.first); });
  std::vector<Joint> joints;
  for (auto& [component, joint] : found) joints.push_back(std::move(joint));
  return joints;
}

std::vector<Joint> joints_in_vectors(const Signals& signals) {
  const std::vector<const Signal*> measured = elements_of_port(signals, ".sensor");
  const std::vector<const Signal*> desired = elements_of_port(signals, ".reference");
  const std::size_t count = std::min(measured.size() / 2, desired.size() / 3);
  std::vector<Joint> joints;
  for (std::size_t i = 0; i < count; ++i) {
    joints.push_back(
        make_joint(std::to_string(i + 1), *desired[i], *measured[i], SameCycle::kForNext));
  }
  return joints;
}

struct Window {
  double begin_s = -kNever;
  double end_s = kNever;
};

/// `Joint2.Armed`, `AIC2.Joint.Armed`, or `Wam.Armed2` of hardware that has all joints.
const Signal* armed_signal(const Signals& signals, const std::string& joint) {
  constexpr std::string_view kArmed = ".Armed";
  for (const Signal& signal : signals.all) {
    const std::string_view name = signal.name;
    if (!name.ends_with(kArmed)) continue;
    if (joint_named(name.substr(0, name.size() - kArmed.size())) == joint) return &signal;
  }
  const auto found =
      std::find_if(signals.all.begin(), signals.all.end(),
                   [&](const Signal& signal) { return ends_in(signal.name, ".Armed" + joint); });
  return found == signals.all.end() ? nullptr : &*found;
}

/// From the first moment at which all joints were armed to the last.
Window armed_window(const Signals& signals, const std::vector<Joint>& joints) {
  Window window;
  for (const Joint& joint : joints) {
    const Signal* const armed = armed_signal(signals, joint.name);
    if (armed == nullptr) continue;
    const auto& values = armed->values;
    const auto first = std::find(values.begin(), values.end(), 1.0);
    if (first == values.end()) return {};  // stood still all the time: all of it counts
    window.begin_s =
        std::max(window.begin_s, armed->time_s[static_cast<std::size_t>(first - values.begin())]);
    const auto last = std::find(values.rbegin(), values.rend(), 1.0);
    if (last == values.rbegin()) continue;
    window.end_s = std::min(window.end_s,
                            armed->time_s[static_cast<std::size_t>(last.base() - values.begin())]);
  }
  return window;
}

bool inside(const Window& window, double time_s) {
  return time_s >= window.begin_s && time_s < window.end_s;
}

/// A sample that was lost is none: the one before stands for it, so that the time is right.
void measure(Joint& joint, const Window& window) {
  auto metrics =
      control::ErrorMetrics::make({.joints = 1, .period = base::from_seconds(joint.period_s)});
  if (!metrics) return;  // one sample only, or none
  double before_s = kNever;
  double squares = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < joint.time_s.size(); ++i) {
    const double time_s = joint.time_s[i];
    double error = joint.desired[i] - joint.measured[i];
    if (!inside(window, time_s) || (before_s == kNever && !std::isfinite(error))) continue;
    if (before_s == kNever) joint.measured_since_s = time_s;
    const double periods = before_s == kNever ? 1.0 : (time_s - before_s) / joint.period_s;
    double nothing = std::numeric_limits<double>::quiet_NaN();
    for (auto k = std::llround(periods); k > 1; --k) {
      metrics.value().step({&nothing, 1});
      ++joint.missing;
    }
    if (periods > 0.5) metrics.value().step({&error, 1});
    if (std::isfinite(error)) {
      squares += error * error;
      ++count;
    }
    before_s = time_s;
  }
  if (count > 0) joint.rms = std::sqrt(squares / static_cast<double>(count));
  joint.figures = metrics.value().of(0);
}

void look_at_rest(Joint& joint, const Window& window) {
  double since_s = kNever;
  for (std::size_t i = 0; i < joint.time_s.size(); ++i) {
    const double error = std::abs(joint.desired[i] - joint.measured[i]);
    if (!inside(window, joint.time_s[i]) || !std::isfinite(error)) continue;
    const bool moved = i > 0 && joint.desired[i] != joint.desired[i - 1];
    if (moved || since_s == kNever) since_s = joint.time_s[i];
    if (joint.time_s[i] - since_s < kSettling_s) continue;
    joint.at_rest = std::max(joint.at_rest.value_or(0.0), error);
  }
}

/// Measured positions of the time before the joints were armed.
void look_at_arming(Joint& joint, const Signal* armed, const Window& window) {
  if (armed == nullptr) return;
  const double begin_s = window.begin_s - kArming_s;
  const double end_s = window.begin_s == -kNever ? kNever : window.begin_s;
  double lowest = kNever, highest = -kNever;
  for (std::size_t i = 0; i < joint.time_s.size(); ++i) {
    const bool counts = joint.time_s[i] >= begin_s && joint.time_s[i] <= end_s;
    if (!counts || !std::isfinite(joint.measured[i])) continue;
    lowest = std::min(lowest, joint.measured[i]);
    highest = std::max(highest, joint.measured[i]);
  }
  if (lowest <= highest) joint.moved_arming = highest - lowest;
}

void look_at_the_end(Joint& joint, const Window& window) {
  std::vector<double> times, positions;
  for (std::size_t i = 0; i < joint.time_s.size(); ++i) {
    if (!inside(window, joint.time_s[i]) || !std::isfinite(joint.measured[i])) continue;
    times.push_back(joint.time_s[i]);
    positions.push_back(joint.measured[i]);
  }
  if (times.empty() || times.back() - times.front() < kLately_s) return;
  const auto begin = std::lower_bound(times.begin(), times.end(), times.back() - kLately_s);
  const auto first = static_cast<std::size_t>(begin - times.begin());
  joint.moved_lately = 0.0;
  for (std::size_t i = first; i < positions.size(); ++i) {
    joint.moved_lately = std::max(*joint.moved_lately, std::abs(positions[i] - positions[first]));
  }
}

std::optional<double> value_of(const Signals& signals, const std::string& name) {
  const Signal* const signal = signals.find(name);
  if (signal == nullptr || signal->values.empty()) return std::nullopt;
  return signal->values.back();
}

std::optional<double> rad_per_count(const Signals& signals, const std::string& joint) {
  const auto peer = signals.texts.find("Joint" + joint + ".PeerName");
  const auto ratio = value_of(signals, "Joint" + joint + ".GearRatio");
  if (peer == signals.texts.end() || !ratio) return std::nullopt;
  const auto counts = value_of(signals, peer->second + ".CountsPerTurn");
  const auto card_ratio = value_of(signals, peer->second + ".GearRatio");
  if (!counts || !card_ratio || !(*counts > 0.0)) return std::nullopt;
  return std::abs(kTwoPi / *counts * *card_ratio * *ratio);
}

}  // namespace

std::vector<Joint> joints_of(const Signals& signals) {
  std::vector<Joint> joints = joints_with_a_controller_each(signals);
  const bool in_vectors = joints.empty();
  if (in_vectors) joints = joints_in_vectors(signals);
  Window window = armed_window(signals, joints);
  // The measurement of the cycle in which it was armed came before that.
  if (in_vectors) window.begin_s = std::nextafter(window.begin_s, kNever);
  for (Joint& joint : joints) {
    joint.rad_per_count = rad_per_count(signals, joint.name);
    measure(joint, window);
    look_at_arming(joint, armed_signal(signals, joint.name), window);
    look_at_rest(joint, window);
    look_at_the_end(joint, window);
  }
  return joints;
}

const char* what_is_looked_for() {
  return "of each joint a component's ports Ref and Sen, such as PID1.Ref and PID1.Sen, or the "
         "ports reference and sensor of all joints, such as BridgeRef.reference and Sensor.sensor";
}

}  // namespace armature::report
