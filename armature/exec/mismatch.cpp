// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/mismatch.hpp"

#include <string_view>

#include "armature/base/quoted.hpp"
#include "armature/base/unit.hpp"
#include "armature/component/component.hpp"

namespace armature::exec {
namespace {

using base::quoted;
using component::InputPortBase;
using component::OutputPortBase;

std::string path(const component::PortBase& port) {
  return quoted(port.owner().name() + "." + std::string(port.name()));
}

std::string unit_text(std::string_view unit) {
  return unit.empty() ? "plain numbers" : quoted(unit);
}

std::string unknown_unit(const component::PortBase& port) {
  return "the model of " + quoted(port.owner().name()) + " declares the unknown unit " +
         quoted(port.unit());
}

/// A port that serves any unit and was told none takes that of the other one.
std::string hint_about_units(const OutputPortBase& output, const InputPortBase& input) {
  const auto may_name = [](const component::PortBase& port) {
    return port.unit_property() != nullptr && port.unit().empty();
  };
  const auto hint = [](const component::PortBase& port, const component::PortBase& other) {
    return "name the unit of " + quoted(port.owner().name()) + ": " +
           std::string(port.unit_property()->name()) + ": " + std::string(other.unit());
  };
  if (may_name(input)) return hint(input, output);
  if (may_name(output)) return hint(output, input);
  return "connect ports of the same unit, or convert in a component between them";
}

/// A port of axes of both kinds is in "rad or m": it suits what is in one of them.
bool suit(std::string_view from, std::string_view to) {
  constexpr std::string_view kOr = " or ";
  if (const auto at = from.find(kOr); at != std::string_view::npos) {
    return suit(from.substr(0, at), to) || suit(from.substr(at + kOr.size()), to);
  }
  if (const auto at = to.find(kOr); at != std::string_view::npos) {
    return suit(from, to.substr(0, at)) || suit(from, to.substr(at + kOr.size()));
  }
  const auto one = base::parse_unit(from);
  const auto other = base::parse_unit(to);
  return one && other && one.value().same_as(other.value());
}

std::optional<Mismatch> mismatch_of_units(const OutputPortBase& output,
                                          const InputPortBase& input) {
  if (output.unit() == input.unit() || suit(output.unit(), input.unit())) return std::nullopt;
  const auto from = base::parse_unit(output.unit());
  const auto to = base::parse_unit(input.unit());
  return Mismatch{path(output) + " is in " + unit_text(output.unit()) + ", but " + path(input) +
                      " expects " + unit_text(input.unit()),
                  !from ? unknown_unit(output)
                  : !to ? unknown_unit(input)
                        : hint_about_units(output, input)};
}

std::optional<Mismatch> mismatch_of_sizes(const OutputPortBase& output,
                                          const InputPortBase& input) {
  const component::PortSize& writes = output.declared_size();
  const component::PortSize& reads = input.declared_size();
  const bool known = writes.declared() && reads.declared();
  if (!known || writes.value() == reads.value()) return std::nullopt;
  return Mismatch{path(output) + " has " + std::to_string(writes.value()) + " elements, but " +
                      path(input) + " expects " + std::to_string(reads.value()),
                  "give both the same number of elements"};
}

}  // namespace

std::optional<Mismatch> mismatch_but_size(const OutputPortBase& output,
                                          const InputPortBase& input) {
  if (!types::same_type(output.type(), input.type())) {
    return Mismatch{path(output) + " writes " + std::string(output.type().name) + ", but " +
                        path(input) + " reads " + std::string(input.type().name),
                    "connect ports of the same type"};
  }
  return mismatch_of_units(output, input);
}

std::optional<Mismatch> mismatch(const OutputPortBase& output, const InputPortBase& input) {
  auto found = mismatch_but_size(output, input);
  return found ? found : mismatch_of_sizes(output, input);
}

}  // namespace armature::exec
