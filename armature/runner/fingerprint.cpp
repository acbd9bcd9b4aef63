// SPDX-License-Identifier: Apache-2.0
#include "armature/runner/fingerprint.hpp"

#include "armature/base/hash64.hpp"
#include "armature/base/time.hpp"
#include "armature/component/interface.hpp"
#include "armature/component/properties/property.hpp"
#include "armature/exec/event_command.hpp"
#include "armature/platform/file.hpp"
#include "armature/types/enum.hpp"

namespace armature::runner {
namespace {

/// The file may lie elsewhere than when the application was checked, but has to say the same.
std::string value_text(const component::PropertyBase& property) {
  std::string text = types::to_text(property.type(), property.data());
  if (property.type().kind != types::Kind::kText || !text.starts_with('/')) return text;
  const auto content = platform::read_file(text);
  return content ? "a file " + std::to_string(base::fnv1a_64(content.value())) : text;
}

std::string activity_text(const exec::Activity& activity) {
  std::string text =
      std::string(name_of(activity.kind)) + ' ' + base::to_text(activity.period) + ' ' +
      std::string(name_of(activity.scheduler)) + ' ' + std::to_string(activity.priority) + ' ' +
      std::string(name_of(activity.overrun)) + ' ' + std::to_string(activity.late_cycles_to_fault) +
      ' ' + base::to_text(activity.budget) + " thread '" + activity.thread + "' cpus";
  for (const int cpu : activity.cpus) text += ' ' + std::to_string(cpu);
  return text;
}

std::string parameter_text(const component::CallParameter& parameter) {
  using From = component::CallParameter::From;
  switch (parameter.from) {
    case From::kMember:
      return "member " + std::to_string(parameter.member);
    case From::kPort:
      return parameter.input + " from " + parameter.port->owner().name() + '.' +
             std::string(parameter.port->name());
    case From::kConstant:
      break;
  }
  return parameter.constant->type().name + ' ' + parameter.constant->text();
}

void add(const exec::ComponentEntry& entry, std::string& to) {
  const component::Component& component = *entry.component;
  to += "component " + component.name() + " model " + entry.model + " activity " +
        activity_text(entry.activity) + (entry.autostart ? "" : " no autostart") +
        (entry.autoconfigure ? "" : " no autoconfigure") + (entry.shadow ? " shadow" : "") + '\n';
  for (const exec::PeerEntry& peer : entry.peers) {
    to += (peer.superior ? "  superior " : "  peer ") + peer.name + '\n';
  }
  for (const exec::BindingEntry& one : entry.bindings) {
    to += "  bind " + one.requirement + " to " + one.peer + '.' + one.member + '\n';
  }
  for (const component::PropertyBase* property : component::interface_of(component).properties) {
    to += "  " + property->type().name + ' ' + std::string(property->name()) + " = " +
          value_text(*property) + '\n';
  }
  const auto* const command = dynamic_cast<const exec::EventCommand*>(&component);
  if (command == nullptr) return;
  to += "  max_age " + base::to_text(command->max_age()) + '\n';
  for (const auto& one : command->parameters()) to += "  with " + parameter_text(one) + '\n';
}

void add(const exec::ConnectionEntry& entry, std::string& to) {
  const component::ConnectionPolicy& policy = entry.policy;
  const bool latest = policy.kind == component::ConnectionPolicy::Kind::kLatest;
  to += "connect " + entry.from_component + '.' + entry.from_port + " to " + entry.to_component +
        '.' + entry.to_port + (latest ? " latest" : " fifo ") +
        (latest ? ""
                : std::to_string(policy.capacity) + ' ' +
                      std::string(types::name_of(policy.when_full))) +
        (policy.one_cycle_delay ? " delayed" : "");
  if (entry.max_age) {
    to += " max_age " + base::to_text(entry.max_age->age) + ' ' +
          std::string(name_of(entry.max_age->reaction));
  }
  if (entry.on_lost) to += " on_lost " + std::string(name_of(entry.on_lost->reaction));
  to += '\n';
}

}  // namespace

std::string outline(const exec::Blueprint& blueprint, const exec::ApplicationOptions& options) {
  std::string text = "application " + blueprint.name + '\n';
  for (const exec::ComponentEntry& entry : blueprint.components) add(entry, text);
  for (const exec::ConnectionEntry& entry : blueprint.connections) add(entry, text);
  for (const exec::ModeEntry& mode : blueprint.modes) {
    text += "mode " + mode.name;
    for (const exec::ModeMember& member : mode.members) text += ' ' + member.component;
    text += '\n';
  }
  text += "begins in mode '" + blueprint.initial_mode.component + "'\non fault " +
          std::string(name_of(options.on_fault)) + '\n';
  for (const exec::CommandName& last : options.before_stop) {
    text += "before stop " + last.component + '.' + last.command + '\n';
  }
  text += "hold at stop " + base::to_text(options.hold_at_stop) + "\nblack box " +
          base::to_text(options.black_box.history) + ' ' +
          std::to_string(options.black_box.memory) + '\n';
  return text;
}

std::uint64_t fingerprint(const exec::Blueprint& blueprint,
                          const exec::ApplicationOptions& options) {
  return base::fnv1a_64(outline(blueprint, options));
}

}  // namespace armature::runner
