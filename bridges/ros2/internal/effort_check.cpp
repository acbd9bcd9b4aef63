// SPDX-License-Identifier: Apache-2.0
#include "bridges/ros2/internal/effort_check.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "armature/base/unit.hpp"
#include "armature/component/interface.hpp"
#include "armature/component/operations/command.hpp"
#include "armature/component/ports/input_port.hpp"
#include "armature/component/ports/output_port.hpp"

namespace armature::ros2::internal {
namespace {

using component::Component;

bool is_effort(std::string_view text) {
  constexpr std::string_view kOr = " or ";  // of axes of both kinds: "Nm or N"
  if (const auto at = text.find(kOr); at != std::string_view::npos) {
    return is_effort(text.substr(0, at)) || is_effort(text.substr(at + kOr.size()));
  }
  const auto unit = base::parse_unit(text);
  if (!unit) return false;
  return std::ranges::any_of(std::array{"V", "A", "N", "N m", "W"}, [&](const char* effort) {
    return base::parse_unit(effort).value().same_kind(unit.value());
  });
}

bool has_effort(const types::Type& type) {
  if (type.sealed) return true;
  if (type.element != nullptr) return has_effort(*type.element);
  return std::ranges::any_of(type.fields, [](const types::Field& field) {
    return is_effort(field.unit) || has_effort(*field.type);
  });
}

bool moves(const component::PortBase& port) {
  return is_effort(port.unit()) || has_effort(port.type());
}

bool takes_commands(const Component& component) {
  return std::ranges::any_of(component::interface_of(component).operations,
                             [](const component::OperationBase* each) {
                               return dynamic_cast<const component::CommandBase*>(each) != nullptr;
                             });
}

/// Whether it is an effort, which is told; goes on behind it where its component hands on what it
/// is given.
bool is_told(const component::InputPortBase& input, std::vector<const Component*>& reached,
             component::Check& check) {
  const Component& reader = input.owner();
  if (moves(input)) {
    check.error("what comes from ROS 2 leads to the effort '" + reader.name() + "." +
                    std::string(input.name()) + "'",
                "connect it to a generator of motions or to a chassis, which keep limits");
    return true;
  }
  if (!takes_commands(reader) && std::ranges::find(reached, &reader) == reached.end()) {
    reached.push_back(&reader);
  }
  return false;
}

/// Tells of the first effort that the components reach.
void check_from(std::vector<const Component*> reached, component::Check& check) {
  for (std::size_t i = 0; i < reached.size(); ++i) {
    for (const auto* output : component::interface_of(*reached[i]).outputs) {
      for (const auto* input : check.readers_of(*output)) {
        if (is_told(*input, reached, check)) return;
      }
    }
  }
}

}  // namespace

void check_efforts(const Component& from, component::Check& check) { check_from({&from}, check); }

void check_efforts_behind(const component::InputPortBase& input, component::Check& check) {
  std::vector<const Component*> reached;
  if (!is_told(input, reached, check)) check_from(reached, check);
}

}  // namespace armature::ros2::internal
