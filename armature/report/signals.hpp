// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/record/mcap_reader.hpp"

namespace armature::report {

/// One number over time; what is no number is nan.
struct Signal {
  std::string name;  ///< `PID1.Ref`, `Sensor.sensor[0]`, `Head.pan.q`
  std::string unit;
  std::string doc;
  std::vector<double> time_s;  ///< never goes back
  std::vector<double> values;
};

/// What a recording has: every number in every channel, and the texts that did not change.
struct Signals {
  std::vector<Signal> all;                   ///< in the order of the channels
  std::map<std::string, std::string> texts;  ///< the last one of each channel of texts

  const Signal* find(const std::string& name) const;
};

/// The elements of the first vector whose port is called `.sensor`, or what `port` says, of
/// whatever component: `Sensor.sensor[0]` and on.
std::vector<const Signal*> elements_of_port(const Signals& signals, const std::string& port);

/// Which joint a component is by its name: `2` of `Joint2`, and of `AIC2.Joint`, the part of a
/// composite; nullopt: none.
std::optional<std::string> joint_named(std::string_view component);

/// The bound of a joint that the property `Component.MaxTorque`, or what `name` says, has: a
/// number, or a vector with one for each joint or one for all.
/// @param joint  counts from 0
std::optional<double> limit_in(const Signals& signals, const std::string& name, std::size_t joint);

Signals signals_of(const record::McapRecording& recording);

/// A real run's times are those of the machine's clock: the first sample becomes time 0.
/// @return when that was [s]; 0 without samples
double begin_at_zero(Signals& signals);
/// Times are from then on.
void begin_at(double begin_s, Signals& signals);

/// Sorts names as people count: PID2 before PID10.
bool before_by_number(const std::string& left, const std::string& right);

/// The same curve with at most about `most` points: of each stretch its smallest and its largest.
Signal thinned(const Signal& signal, std::size_t most);

}  // namespace armature::report
