// SPDX-License-Identifier: Apache-2.0
#include "armature/generate/internal/main_text.hpp"

#include <cstdint>
#include <cstdio>
#include <string_view>

#include "armature/base/time.hpp"
#include "armature/component/interface.hpp"
#include "armature/component/operations/operation.hpp"
#include "armature/exec/event_command.hpp"
#include "armature/exec/modes.hpp"
#include "armature/generate/internal/code.hpp"
#include "armature/generate/internal/literal.hpp"
#include "armature/runner/fingerprint.hpp"
#include "armature/types/enum.hpp"

namespace armature::generate::internal {
namespace {

using Calls = std::vector<std::string>;

/// `kCatchUp` of `catch_up`.
template <typename Enum>
std::string enumerator(Enum value) {
  std::string name = "k";
  bool begins = true;
  for (const char c : std::string(types::name_of(value))) {
    const bool lower = c >= 'a' && c <= 'z';
    if (c != '_') name += begins && lower ? static_cast<char>(c - 'a' + 'A') : c;
    begins = c == '_';
  }
  return name;
}

std::string call(const std::string& head, const Calls& arguments) {
  std::string text = head + '(';
  for (std::size_t i = 0; i < arguments.size(); ++i) text += (i == 0 ? "" : ", ") + arguments[i];
  return text + ')';
}

std::string in_braces(const Calls& items) {
  std::string text = "{";
  for (std::size_t i = 0; i < items.size(); ++i) text += (i == 0 ? "" : ", ") + items[i];
  return text + '}';
}

std::string yes_or_no(bool yes) { return yes ? "true" : "false"; }

// ---- Components

/// `periodic(10ms, 80)` says all of it.
bool is_plain(const exec::Activity& activity) {
  const bool urgent = activity.scheduler == exec::Activity::Scheduler::kRealtime;
  const exec::Activity usual;
  return activity.owns_thread() && activity.scheduler != exec::Activity::Scheduler::kDeadline &&
         urgent == (activity.priority > 0) && activity.cpus.empty() &&
         activity.overrun == usual.overrun && activity.budget == usual.budget &&
         activity.late_cycles_to_fault == usual.late_cycles_to_fault && activity.thread.empty();
}

std::string plain_activity_text(const exec::Activity& activity) {
  const bool periodic = activity.kind == exec::Activity::Kind::kPeriodic;
  Calls said;
  if (periodic) said.push_back(duration_literal(activity.period));
  if (activity.priority > 0) said.push_back(std::to_string(activity.priority));
  return call(periodic ? "Activity::periodic" : "Activity::triggered", said);
}

/// What differs from an activity that says nothing, member by member.
std::string activity_text(const exec::Activity& activity) {
  if (is_plain(activity)) return call(".activity", {plain_activity_text(activity)});
  const exec::Activity usual;
  Calls said = {".kind = Activity::Kind::" + enumerator(activity.kind)};
  if (activity.period != usual.period) {
    said.push_back(".period = " + duration_literal(activity.period));
  }
  if (activity.scheduler != usual.scheduler) {
    said.push_back(".scheduler = Activity::Scheduler::" + enumerator(activity.scheduler));
  }
  if (activity.priority != usual.priority) {
    said.push_back(".priority = " + std::to_string(activity.priority));
  }
  if (!activity.cpus.empty()) {
    Calls cpus;
    for (const int cpu : activity.cpus) cpus.push_back(std::to_string(cpu));
    said.push_back(".cpus = " + in_braces(cpus));
  }
  if (activity.overrun != usual.overrun) {
    said.push_back(".overrun = Overrun::" + enumerator(activity.overrun));
  }
  if (activity.late_cycles_to_fault != usual.late_cycles_to_fault) {
    said.push_back(".late_cycles_to_fault = " + std::to_string(activity.late_cycles_to_fault));
  }
  if (activity.budget != usual.budget) {
    said.push_back(".budget = " + duration_literal(activity.budget));
  }
  if (!activity.thread.empty()) said.push_back(".thread = " + text_literal(activity.thread));
  return call(".activity", {in_braces(said)});
}

std::string property_text(const component::PropertyBase& property, const DataFiles& data) {
  const std::string name = text_literal(property.name());
  if (const std::string* const file = data.name_of(property)) {
    return call(".set", {name, call("to.file", {text_literal(*file)})});
  }
  if (const auto value = literal(property.type(), property.data())) {
    return call(".set", {name, *value});
  }
  return call(".set_text", {name, text_literal(types::to_text(property.type(), property.data()))});
}

bool is_given(const document::Component* written, std::string_view name) {
  return written != nullptr && document::find(written->properties, name) != nullptr;
}

/// Those that were set, in the order in which the deployment's builder sets them: what a model's
/// name or a property file says, then what the deployment says.
std::vector<const component::PropertyBase*> set_properties(const component::Component& component,
                                                           const document::Component* written) {
  std::vector<const component::PropertyBase*> found;
  const auto& all = component::interface_of(component).properties;
  for (const component::PropertyBase* property : all) {
    if (property->was_set() && !is_given(written, property->name())) found.push_back(property);
  }
  if (written == nullptr) return found;
  for (const document::Property& given : written->properties) {
    for (const component::PropertyBase* property : all) {
      if (property->name() == given.name && property->was_set()) found.push_back(property);
    }
  }
  return found;
}

const document::Component* find_written(const document::Document& document, std::string_view name) {
  for (const document::Component& component : document.components) {
    if (component.name == name) return &component;
  }
  return nullptr;
}

Calls component_calls(const exec::ComponentEntry& entry, const document::Component* written,
                      const DataFiles& data) {
  Calls calls = {
      call("to.component", {text_literal(entry.component->name()), text_literal(entry.model)})};
  if (entry.activity.kind != exec::Activity::Kind::kSequential) {
    calls.push_back(activity_text(entry.activity));
  }
  for (const auto* property : set_properties(*entry.component, written)) {
    calls.push_back(property_text(*property, data));
  }
  for (const exec::PeerEntry& peer : entry.peers) {
    calls.push_back(call(peer.superior ? ".superior" : ".peer", {text_literal(peer.name)}));
  }
  for (const exec::BindingEntry& one : entry.bindings) {
    calls.push_back(call(".bind", {text_literal(one.requirement), text_literal(one.peer),
                                   text_literal(one.member)}));
  }
  if (!entry.autoconfigure) calls.push_back(call(".autoconfigure", {yes_or_no(false)}));
  if (!entry.autostart) calls.push_back(call(".autostart", {yes_or_no(false)}));
  if (entry.shadow) calls.push_back(call(".shadow", {}));
  return calls;
}

/// The runtime's own are made by what they do.
bool is_of_a_model(const exec::ComponentEntry& entry) {
  return dynamic_cast<const exec::EventCommand*>(entry.component.get()) == nullptr &&
         dynamic_cast<const exec::Modes*>(entry.component.get()) == nullptr;
}

void add_components(const deploy::Deployment& deployment, const DataFiles& data, Code& code) {
  code.line("void add_components(Assembly& to) {");
  bool first = true;
  for (const exec::ComponentEntry& entry : deployment.blueprint.components) {
    if (!is_of_a_model(entry)) continue;
    if (!first) code.line();
    first = false;
    const auto* const written = find_written(deployment.document, entry.component->name());
    code.chain(component_calls(entry, written, data));
  }
  code.line("}");
}

// ---- Commands that events give, and connections

std::string parameter_text(const component::CallParameter& parameter) {
  using From = component::CallParameter::From;
  switch (parameter.from) {
    case From::kMember:
      return call("member", {std::to_string(parameter.member)});
    case From::kPort: {
      const std::string output =
          parameter.port->owner().name() + '.' + std::string(parameter.port->name());
      return call("port", {text_literal(parameter.input), text_literal(output)});
    }
    case From::kConstant:
      break;
  }
  const types::Value& value = *parameter.constant;
  const bool is_text = value.type().kind == types::Kind::kText;
  if (const auto text = literal(value.type(), value.data())) {
    return call("constant", {is_text ? call("std::string", {*text}) : *text});
  }
  return call("text_constant", {text_literal(value.text())});
}

std::string end_text(const exec::ComponentEntry& entry, std::string_view requirement) {
  for (const exec::BindingEntry& one : entry.bindings) {
    if (one.requirement == requirement) return text_literal(one.peer + '.' + one.member);
  }
  return "\"\"";
}

std::string command_text(const exec::ComponentEntry& entry, const exec::EventCommand& command) {
  Calls said = {".name = " + text_literal(entry.component->name()),
                ".on = " + end_text(entry, exec::EventCommand::kOn),
                ".give = " + end_text(entry, exec::EventCommand::kDo)};
  if (command.max_age() != base::Duration::zero()) {
    said.push_back(".max_age = " + duration_literal(command.max_age()));
  }
  Calls arguments = {in_braces(said)};
  Calls parameters;
  for (const component::CallParameter& one : command.parameters()) {
    parameters.push_back(parameter_text(one));
  }
  if (!parameters.empty()) arguments.push_back(in_braces(parameters));
  return call("to.command", arguments);
}

void add_commands(const exec::Blueprint& blueprint, Code& code) {
  for (const exec::ComponentEntry& entry : blueprint.components) {
    const auto* const command = dynamic_cast<const exec::EventCommand*>(entry.component.get());
    if (command != nullptr) code.chain({command_text(entry, *command)});
  }
}

std::string policy_text(const component::ConnectionPolicy& policy) {
  Calls said;
  if (policy.kind == component::ConnectionPolicy::Kind::kFifo) {
    said = {".kind = ConnectionPolicy::Kind::kFifo",
            ".capacity = " + std::to_string(policy.capacity),
            ".when_full = WhenFull::" + enumerator(policy.when_full)};
  }
  if (policy.one_cycle_delay) said.emplace_back(".one_cycle_delay = true");
  return said.empty() ? std::string() : in_braces(said);
}

Calls connection_calls(const exec::ConnectionEntry& entry) {
  Calls ends = {text_literal(entry.from_component + '.' + entry.from_port),
                text_literal(entry.to_component + '.' + entry.to_port)};
  if (std::string policy = policy_text(entry.policy); !policy.empty()) ends.push_back(policy);
  Calls calls = {call("to.connect", ends)};
  if (entry.max_age) {
    calls.push_back(call(".max_age", {duration_literal(entry.max_age->age),
                                      "Reaction::" + enumerator(entry.max_age->reaction)}));
  }
  if (entry.on_lost) {
    calls.push_back(call(".on_lost", {"Reaction::" + enumerator(entry.on_lost->reaction)}));
  }
  return calls;
}

void add_connections(const exec::Blueprint& blueprint, Code& code) {
  code.line("void add_connections(Assembly& to) {");
  add_commands(blueprint, code);
  for (const exec::ConnectionEntry& entry : blueprint.connections) {
    code.chain(connection_calls(entry));
  }
  code.line("}");
}

// ---- The application as a whole

void add_modes(const exec::Blueprint& blueprint, Code& code) {
  for (const exec::ModeEntry& mode : blueprint.modes) {
    Calls members;
    for (const exec::ModeMember& member : mode.members) {
      members.push_back(text_literal(member.component));
    }
    code.chain({call("to.mode", {text_literal(mode.name), in_braces(members)})});
  }
  const std::string& initial = blueprint.initial_mode.component;
  if (!initial.empty()) code.chain({call("to.initial_mode", {text_literal(initial)})});
}

/// Of its options what a deployment may say and a program can do.
void add_options(const exec::ApplicationOptions& options, Code& code) {
  const exec::ApplicationOptions usual;
  if (options.on_fault != usual.on_fault) {
    code.chain({"to.options().on_fault = OnFault::" + enumerator(options.on_fault)});
  }
  for (const exec::CommandName& last : options.before_stop) {
    code.chain({call("to.options().before_stop.push_back",
                     {in_braces({text_literal(last.component), text_literal(last.command)})})});
  }
  if (options.hold_at_stop != usual.hold_at_stop) {
    code.chain({"to.options().hold_at_stop = " + duration_literal(options.hold_at_stop)});
  }
  if (options.black_box.history != usual.black_box.history) {
    code.chain({"to.options().black_box.history = " + duration_literal(options.black_box.history)});
  }
  if (options.black_box.memory != usual.black_box.memory) {
    code.chain({"to.options().black_box.memory = " + std::to_string(options.black_box.memory)});
  }
}

void add_head(const Facts& facts, Code& code) {
  code.line("// Generated by `armature generate` from " + facts.deployment + '.');
  code.line("// Change that file and generate this one again: the program runs what was checked.");
  for (const char* header : {"array", "chrono", "cstdint", "string", "vector"}) {
    code.line("#include <" + std::string(header) + '>');
  }
  code.line();
  code.line("#include <armature/runner/program.hpp>");
  code.line();
  code.line("// The component libraries that it is linked with.");
  code.line("extern \"C\" {");
  for (const UsedLibrary& library : facts.libraries) {
    code.line("const armature::component::LibraryDescription* " + library.entry + "();");
  }
  code.line("}");
  code.line();
  code.line("namespace {");
  code.line();
  code.line("using namespace std::chrono_literals;");
  code.line("using namespace armature::runner;");
  for (const char* name : {"component::ConnectionPolicy", "component::Reaction", "exec::Activity",
                           "exec::OnFault", "exec::Overrun", "rt::WhenFull"}) {
    code.line("using armature::" + std::string(name) + ';');
  }
  code.line();
}

std::string in_hex(std::uint64_t number) {
  char text[32];
  std::snprintf(text, sizeof text, "0x%016llx", static_cast<unsigned long long>(number));
  return text;
}

void add_main(const Facts& facts, std::uint64_t fingerprint, Code& code) {
  code.line("int main(int argc, char** argv) {");
  code.line("  Program program;");
  code.line("  program.name = " + text_literal(facts.name) + ';');
  code.line("  program.libraries = {");
  for (const UsedLibrary& library : facts.libraries) {
    code.line("      {" + text_literal(library.name) + ", &" + library.entry + "},");
  }
  code.line("  };");
  code.line("  program.assemble = &assemble;");
  code.line("  program.fingerprint = " + in_hex(fingerprint) + "u;");
  code.line("  return run_program(program, argc, argv);");
  code.line("}");
}

}  // namespace

std::string main_text(const deploy::Deployment& deployment, const Facts& facts) {
  Code code;
  add_head(facts, code);
  add_components(deployment, facts.data, code);
  code.line();
  add_connections(deployment.blueprint, code);
  code.line();
  code.line("void assemble(Assembly& to) {");
  code.chain({call("to.name", {text_literal(deployment.blueprint.name)})});
  add_options(deployment.options, code);
  code.line("  add_components(to);");
  add_modes(deployment.blueprint, code);
  code.line("  add_connections(to);");
  code.line("}");
  code.line();
  code.line("}  // namespace");
  code.line();
  add_main(facts, runner::fingerprint(deployment.blueprint, deployment.options), code);
  return code.text();
}

}  // namespace armature::generate::internal
