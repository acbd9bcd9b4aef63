// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/fitting.hpp"

#include <memory>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/base/quoted.hpp"
#include "armature/component/author.hpp"
#include "armature/component/interface.hpp"
#include "armature/exec/mismatch.hpp"

namespace armature::inspect {
namespace {

using component::Component;
using component::EventBase;
using component::InputPortBase;
using component::OperationBase;
using component::OutputPortBase;
using exec::Blueprint;
using exec::Mismatch;

/// How an output and an input are compared.
using Compare = std::optional<Mismatch> (*)(const OutputPortBase&, const InputPortBase&);

/// Where a connection begins, or ends; all but one are nullptr.
struct Beginning {
  const InputPortBase* input = nullptr;
  const OutputPortBase* output = nullptr;
  const EventBase* event = nullptr;
  const OperationBase* command = nullptr;
};

template <typename Item>
const Item* item_called(const std::vector<Item*>& items, std::string_view name) {
  for (const Item* item : items) {
    if (item->name() == name) return item;
  }
  return nullptr;
}

const Component* component_called(const Blueprint& blueprint, std::string_view name) {
  for (const exec::ComponentEntry& entry : blueprint.components) {
    if (entry.component->name() == name) return entry.component.get();
  }
  return nullptr;
}

base::Result<Beginning> beginning_at(const Component& component, std::string_view name) {
  const component::Interface& all = component::interface_of(component);
  Beginning found{item_called(all.inputs, name), nullptr, nullptr, nullptr};
  if (found.input != nullptr) return found;
  found.output = item_called(all.outputs, name);
  if (found.output != nullptr) return found;
  found.event = item_called(all.events, name);
  if (found.event != nullptr) return found;
  found.command = item_called(all.operations, name);
  if (found.command != nullptr && found.command->is_command()) return found;
  return base::Error{base::quoted(component.name()) + " has no port, event or command " +
                     base::quoted(name)};
}

/// Who writes each input, by its path.
using Writers = std::unordered_map<std::string, std::string>;

Writers writers_of(const Blueprint& blueprint) {
  Writers writers;
  for (const exec::ConnectionEntry& one : blueprint.connections) {
    writers.emplace(one.to_component + "." + one.to_port, one.from_component + "." + one.from_port);
  }
  return writers;
}

/// Components that ports of others are connected to.
std::unordered_set<std::string> connected_in(const Blueprint& blueprint) {
  std::unordered_set<std::string> names;
  for (const exec::ConnectionEntry& one : blueprint.connections) {
    names.insert(one.from_component);
    names.insert(one.to_component);
  }
  return names;
}

/// Finds the ends for one member, component by component.
class Search {
 public:
  Search(const Beginning& from, Writers writers, Compare compare)
      : from_(from), writers_(std::move(writers)), compare_(compare) {}

  std::vector<End> among(const Blueprint& blueprint) {
    may_take_turns_ = !blueprint.modes.empty();
    connected_ = connected_in(blueprint);
    for (const exec::ComponentEntry& entry : blueprint.components) {
      look_at(component::interface_of(*entry.component));
    }
    return std::move(ends_);
  }

 private:
  void look_at(const component::Interface& all) {
    if (from_.output != nullptr) {
      for (const auto* input : all.inputs) {
        add(*input, EndKind::kInput, why_not(*input), unit_to_name(*from_.output, *input));
      }
    }
    if (from_.input != nullptr) {
      for (const auto* output : all.outputs) {
        add(*output, EndKind::kOutput, why_not(*output), unit_to_name(*from_.input, *output));
      }
    }
    if (from_.event != nullptr) {
      for (const auto* operation : all.operations) {
        if (operation->is_command()) add(*operation, EndKind::kCommand, why_not(*operation));
      }
    }
    if (from_.command != nullptr) {
      for (const auto* event : all.events) {
        add(*event, EndKind::kEvent, why_not(*from_.command));
      }
    }
  }

  template <typename Found>
  void add(const Found& found, EndKind kind, std::string why_not, UnitToName names = {}) {
    ends_.push_back({found.owner().name(), std::string(found.name()), kind, std::move(why_not),
                     std::move(names)});
  }

  /// A port of any unit takes that of the other one.
  UnitToName unit_to_name(const component::PortBase& from, const component::PortBase& end) const {
    const bool names_none = end.unit_property() != nullptr && end.unit().empty();
    const bool free = names_none && !connected_.contains(end.owner().name());
    if (!free || from.unit().empty() || !types::same_type(from.type(), end.type())) return {};
    return {std::string(end.unit_property()->name()), std::string(from.unit())};
  }

  std::string why_not(const InputPortBase& input) const {
    const auto found = compare_(*from_.output, input);
    const bool fits = !found || !unit_to_name(*from_.output, input).property.empty();
    return fits ? has_writer(input) : found->message;
  }

  std::string why_not(const OutputPortBase& output) const {
    const auto found = compare_(output, *from_.input);
    const bool fits = !found || !unit_to_name(*from_.input, output).property.empty();
    return fits ? has_writer(*from_.input) : found->message;
  }

  static std::string why_not(const OperationBase& command) {
    if (command.is_by_operator()) return "only the operator gives this command";
    return command.is_offered() ? std::string() : command.why_not_offered();
  }

  std::string has_writer(const InputPortBase& input) const {
    if (input.allows_fan_in() || may_take_turns_) return {};
    const std::string path = input.owner().name() + "." + std::string(input.name());
    const auto writer = writers_.find(path);
    if (writer == writers_.end()) return {};
    return base::quoted(path) + " is written by " + base::quoted(writer->second);
  }

  const Beginning& from_;
  const Writers writers_;
  const Compare compare_;
  bool may_take_turns_ = false;
  std::unordered_set<std::string> connected_;
  std::vector<End> ends_;
};

base::Result<Beginning> beginning_at(const Blueprint& blueprint, std::string_view component,
                                     std::string_view member) {
  const Component* const found = component_called(blueprint, component);
  if (found == nullptr) return base::Error{"unknown component " + base::quoted(component)};
  return beginning_at(*found, member);
}

std::unique_ptr<Component> make(const component::Registry::Model& model) {
  try {
    return model.make(model.name);
  } catch (...) {
    return nullptr;  // `armature models` says why
  }
}

}  // namespace

base::Result<std::vector<End>> fitting(const Blueprint& blueprint, std::string_view component,
                                       std::string_view member) {
  const auto from = beginning_at(blueprint, component, member);
  if (!from) return base::Error{from.error()};
  return Search(from.value(), writers_of(blueprint), exec::mismatch).among(blueprint);
}

ModelPorts::ModelPorts(const component::Registry& registry) {
  for (const std::string& name : registry.names()) {
    auto made = make(*registry.find(name));
    if (made == nullptr) continue;
    exec::ComponentEntry entry;
    entry.component = std::move(made);
    models_.components.push_back(std::move(entry));
  }
}

std::vector<End> ModelPorts::fitting(const Blueprint& blueprint, std::string_view component,
                                     std::string_view member) const {
  const auto from = beginning_at(blueprint, component, member);
  const bool is_port = from && (from.value().input != nullptr || from.value().output != nullptr);
  if (!is_port) return {};
  std::vector<End> ends = Search(from.value(), {}, exec::mismatch_but_size).among(models_);
  std::erase_if(ends, [](const End& end) { return !end.fits(); });
  return ends;
}

}  // namespace armature::inspect
