// SPDX-License-Identifier: Apache-2.0
#include "armature/foxglove/internal/joint_source.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <string_view>

#include "armature/base/quoted.hpp"

namespace armature::foxglove::internal {
namespace {

using Components = std::vector<inspect::ComponentDescription>;

constexpr double kEnough = 5.0;

bool has_one_of(const std::string& text, std::initializer_list<std::string_view> words) {
  return std::ranges::any_of(
      words, [&](std::string_view word) { return text.find(word) != std::string::npos; });
}

/// How much a port looks like measured positions of joints.
double likeness(const inspect::PortDescription& port) {
  std::string text = port.name + " " + port.doc;
  std::ranges::transform(text, text.begin(),
                         [](unsigned char one) { return static_cast<char>(std::tolower(one)); });
  double score = port.unit == "rad" || port.unit == "m" ? 1.0 : 0.0;
  if (has_one_of(text, {"position", "angle", "[q1"})) score += 2.0;
  if (has_one_of(text, {"measured", "sensor", "encoder", "actual"})) score += 2.0;
  const bool short_reference = port.name.find("Ref") != std::string::npos;
  if (short_reference ||
      has_one_of(text, {"desired", "wanted", "reference", "target", "goal", "command", "limit"})) {
    score -= 10.0;
  }
  return score;
}

bool may_be_positions(const inspect::PortDescription& port) {
  return port.unit == "rad" || port.unit == "m" || port.unit.empty();
}

bool is_number(const std::string& type) { return type == "double" || type == "float"; }

bool is_list(const std::string& type) {
  const std::size_t begin = type.find('<') + 1;
  const bool list = type.starts_with("vector<") || type.starts_with("array<");
  return list && is_number(type.substr(begin, type.find_first_of(",>") - begin));
}

void add_lists(const Components& components, std::size_t joints, std::vector<JointSource>& to) {
  for (const auto& component : components) {
    for (const auto& port : component.outputs) {
      if (!is_list(port.type) || !may_be_positions(port) || port.size.value_or(joints) < joints) {
        continue;
      }
      const std::string path = component.name + "." + port.name;
      to.push_back({path, {path}, likeness(port) + (port.size == joints ? 2.0 : 0.5)});
    }
  }
}

/// `Joint7` as `Joint` and 7.
std::optional<std::pair<std::string, int>> counted(const std::string& name) {
  const std::size_t begin = name.find_last_not_of("0123456789") + 1;
  if (begin == 0 || begin == name.size() || name.size() - begin > 6) return std::nullopt;
  return std::pair(name.substr(0, begin), std::stoi(name.substr(begin)));
}

/// Ports of one number each that are counted by their components' names or their own.
void add_series(const Components& components, std::size_t joints, std::vector<JointSource>& to) {
  struct Series {
    std::string begin;
    std::string end;
    double score = 0.0;
    std::map<int, std::string> items;
  };
  std::map<std::string, Series> all;
  for (const auto& component : components) {
    for (const auto& port : component.outputs) {
      if (!is_number(port.type) || !may_be_positions(port)) continue;
      const auto of_component = counted(component.name);
      const auto of_port = counted(port.name);
      if (!of_component && !of_port) continue;
      const auto& [name, number] = of_component ? *of_component : *of_port;
      const std::string begin = of_component ? name : component.name + "." + name;
      const std::string end = of_component ? "." + port.name : "";
      Series& series =
          all.try_emplace(begin + "{}" + end,
                          Series{begin, end, likeness(port) + (of_component ? 1.5 : 1.0), {}})
              .first->second;
      series.items[number] = component.name + "." + port.name;
    }
  }
  for (const auto& [pattern, series] : all) {
    if (series.items.size() != joints) continue;
    JointSource source{series.begin + "{" + std::to_string(series.items.begin()->first) + ".." +
                           std::to_string(series.items.rbegin()->first) + "}" + series.end,
                       {},
                       series.score};
    for (const auto& [number, item] : series.items) source.items.push_back(item);
    to.push_back(std::move(source));
  }
}

/// `Arm.` of `Arm.Sensor`.
std::string composite_of(const std::string& component) {
  return component.substr(0, component.rfind('.') + 1);
}

}  // namespace

base::Result<JointSource> joint_source(const Components& components, const std::string& owner,
                                       std::size_t joints, const std::string& chosen) {
  std::vector<JointSource> sources;
  add_lists(components, joints, sources);
  add_series(components, joints, sources);
  for (JointSource& one : sources) {
    if (one.items[0].starts_with(composite_of(owner))) one.score += 0.25;
  }
  std::ranges::stable_sort(sources, [](const JointSource& a, const JointSource& b) {
    return a.score != b.score ? a.score > b.score : a.port < b.port;
  });
  if (!chosen.empty()) {
    const auto found = std::ranges::find(sources, chosen, &JointSource::port);
    if (found != sources.end()) return *found;
    return base::Error{base::quoted(chosen) + ", which was chosen, has not the positions of " +
                       std::to_string(joints) + " joints: choose another port in the studio"};
  }
  if (sources.empty() || sources[0].score < kEnough) {
    return base::Error{
        "no port looks like the measured positions of its joints: choose one in "
        "the studio"};
  }
  if (sources.size() > 1 && sources[1].score == sources[0].score) {
    return base::Error{base::quoted(sources[0].port) + " and " + base::quoted(sources[1].port) +
                       " look alike: choose in the studio which has its joints' positions"};
  }
  return sources[0];
}

}  // namespace armature::foxglove::internal
