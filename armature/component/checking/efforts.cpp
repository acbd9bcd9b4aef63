// SPDX-License-Identifier: Apache-2.0
#include "armature/component/checking/efforts.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "armature/base/unit.hpp"
#include "armature/component/operations/argument_unit.hpp"
#include "armature/component/operations/operation.hpp"
#include "armature/component/ports/port.hpp"

namespace armature::component {
namespace {

bool is_unit_of_effort(std::string_view text) {
  constexpr std::string_view kOr = " or ";  // of axes of both kinds: "Nm or N"
  if (const auto at = text.find(kOr); at != std::string_view::npos) {
    return is_unit_of_effort(text.substr(0, at)) || is_unit_of_effort(text.substr(at + kOr.size()));
  }
  const auto unit = base::parse_unit(text);
  if (!unit) return false;
  return std::ranges::any_of(std::array{"V", "A", "N", "N m", "W"}, [&](const char* effort) {
    return base::parse_unit(effort).value().same_kind(unit.value());
  });
}

bool is_type_of_effort(const types::Type& type) {
  if (type.sealed) return true;
  if (type.element != nullptr) return is_type_of_effort(*type.element);
  return std::ranges::any_of(type.fields, [](const types::Field& field) {
    return is_unit_of_effort(field.unit) || is_type_of_effort(*field.type);
  });
}

}  // namespace

bool has_effort(const PortBase& port) {
  return is_unit_of_effort(port.unit()) || is_type_of_effort(port.type());
}

bool takes_effort(const OperationBase& operation) {
  return std::ranges::any_of(operation.signature().arguments, [](const auto& each) {
    return is_unit_of_effort(argument_unit(each.name)) || is_type_of_effort(*each.type);
  });
}

}  // namespace armature::component
