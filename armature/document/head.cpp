// SPDX-License-Identifier: Apache-2.0
#include "armature/document/head.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "armature/document/network.hpp"
#include "armature/document/reader.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/exec/inlets.hpp"

namespace armature::document {

std::string path_from(const Document& document, std::string_view path) {
  const std::filesystem::path folder = std::filesystem::path(document.file).parent_path();
  return (folder / std::filesystem::path(path)).string();
}

namespace {

constexpr std::array<std::string_view, 15> kHeadKeys = {
    "application",  "on_fault", "black_box",  "libraries", "grants",
    "modes",        "mode",     "composed",   "network",   "before_stop",
    "hold_at_stop", "threads",  "priorities", "accept",    "operator_inputs"};

/// The system itself has an end.
constexpr int kMostThreads = 10'000;

constexpr const char* kGiveOne = "give it one, or remove the key";

std::vector<OperationOf> read_operations(const Value* list, const char* what,
                                         const ValueReader& reader) {
  std::vector<OperationOf> operations;
  for (const Value* item : items_of(list)) {
    const auto whole = reader.dotted_name(*item, what);
    if (!whole) continue;
    auto [component, operation] = split_last_dot(*whole);
    if (component.empty()) {
      reader.error(item->where, std::string(what) + " must be component.operation, found " +
                                    in_quotes(operation));
      continue;
    }
    operations.push_back({std::move(component), std::move(operation), item->where});
  }
  return operations;
}

void read_grants(const Value& value, const ValueReader& reader, Document& document) {
  Fields fields(value, reader);
  document.script_grants = read_operations(fields.take("script"), "grant", reader);
  document.remote_grants = read_operations(fields.take("remote"), "grant", reader);
  if (const Value* confirmed = fields.take("on_hardware")) {
    const Choices<bool> choices = {{"true", true}, {"false", false}};
    assign(reader.choice(*confirmed, "on_hardware of grants", choices),
           document.grants_on_hardware);
  }
  fields.refuse_others();
}

void read_modes(const Value& value, const ValueReader& reader, Document& document) {
  for (const Property& entry : value.entries) {
    Mode mode{entry.name, {}, entry.where};
    if (!is_name(entry.name)) {
      reader.error(entry.where,
                   "mode " + in_quotes(entry.name) + " must be a name: letters, digits, _ and -");
    }
    for (const Value* component : items_of(&entry.value)) {
      if (component->kind == Value::Kind::kNone) continue;  // an empty mode is refused later
      auto name = reader.dotted_name(*component, "mode " + in_quotes(entry.name));
      if (name) mode.components.push_back({std::move(*name), component->where});
    }
    document.modes.push_back(std::move(mode));
  }
}

BlackBox read_black_box(const Value& value, const ValueReader& reader) {
  constexpr int kMostMemory = 1'000'000;
  BlackBox box;
  if (value.kind != Value::Kind::kMap) {
    const Choices<bool> choices = {{"off", false}, {"on", true}};
    assign(reader.choice(value, "black_box", choices), box.kept);
    return box;
  }
  Fields fields(value, reader);
  if (const Value* history = fields.take("history")) {
    box.history = reader.duration(*history, "history of black_box");
  }
  if (const Value* memory = fields.take("memory_kB")) {
    box.memory_kb = reader.whole_number(*memory, "memory_kB of black_box", 1, kMostMemory);
  }
  fields.refuse_others();
  return box;
}

void read_composed(const Value& value, Document& document, base::Diagnostics& diagnostics) {
  for (const Property& entry : value.entries) {
    const ValueReader reader("composed '" + entry.name + "'", diagnostics);
    Composite composite{entry.name, {}, {}, {}, entry.where};
    Fields fields(entry.value, reader);
    if (const Value* model = fields.take("model")) {
      assign(reader.text(*model, "model"), composite.model);
    }
    const Value* parameters = fields.take("parameters");
    if (parameters != nullptr &&
        require_kind(parameters, Value::Kind::kMap, "parameters", reader)) {
      composite.parameters = parameters->entries;
    }
    if (const Value* exports = fields.take("exports")) {
      composite.exports = read_exports(*exports, reader);
    }
    fields.refuse_others();
    document.composites.push_back(std::move(composite));
  }
}

std::string rebased(const std::string& path, const std::string& from, const std::string& to) {
  namespace fs = std::filesystem;
  const fs::path source = fs::path(from).parent_path();
  const fs::path target = fs::path(to).parent_path();
  if (from.empty() || source == target || fs::path(path).is_absolute()) return path;
  const fs::path whole = (source / path).lexically_normal();
  const fs::path relative =
      whole.lexically_relative(target.empty() ? fs::path(".") : target.lexically_normal());
  return relative.empty() ? whole.string() : relative.string();
}

}  // namespace

bool require_kind(const Value* value, Value::Kind kind, std::string_view key,
                  const ValueReader& reader) {
  if (value == nullptr || value->kind == kind) return true;
  reader.error(value->where, std::string(key) + " must be " + std::string(name_of(kind)) +
                                 ", found " + std::string(name_of(value->kind)));
  return false;
}

std::vector<Property> sections_of(Value tree, base::Diagnostics& diagnostics) {
  constexpr std::array<std::pair<const char*, Value::Kind>, 9> kKinds = {
      {{"parameters", Value::Kind::kMap},
       {"network", Value::Kind::kMap},
       {"grants", Value::Kind::kMap},
       {"modes", Value::Kind::kMap},
       {"components", Value::Kind::kMap},
       {"composites", Value::Kind::kMap},
       {"connections", Value::Kind::kList},
       {"before_stop", Value::Kind::kList},
       {"composed", Value::Kind::kMap}}};
  const ValueReader reader("document", diagnostics);
  Fields fields(tree, reader, Empty::kAllowed);
  std::vector<std::string> known;
  const auto take = [&](const char* key) {
    known.emplace_back(key);
    return fields.take(key);
  };
  for (const char* key : {"include", "libraries", "accept", "operator_inputs"}) take(key);
  for (const char* key :
       {"application", "on_fault", "black_box", "mode", "hold_at_stop", "threads", "priorities"}) {
    take(key);
    const Property* const entry = find(tree.entries, key);
    const bool empty = entry != nullptr && entry->value.kind == Value::Kind::kNone;
    if (empty) reader.error(entry->where, in_quotes(key) + " has no value", kGiveOne);
  }
  const auto refuse = [&](const char* key, const char* message, const char* hint) {
    if (const Value* given = fields.take(key)) reader.error(given->where, message, hint);
  };
  refuse("scripts", "'scripts' is not a section of a deployment: scripts are given at start",
         "armature run FILE --script SCRIPT");
  refuse("recorder",
         "'recorder' is not a section of a deployment: a component of the model Reporter records",
         "see docs/recording.md");
  for (const auto& [key, kind] : kKinds) require_kind(take(key), kind, key, reader);
  fields.refuse_others();
  std::erase_if(tree.entries, [&](const Property& entry) {
    return std::find(known.begin(), known.end(), entry.name) == known.end();
  });
  return std::move(tree.entries);
}

Value head_of(const Value& tree) {
  Value head = make_map(tree.where);
  for (const std::string_view key : kHeadKeys) {
    if (const Property* entry = find(tree.entries, key)) head.entries.push_back(*entry);
  }
  return head;
}

std::vector<Export> read_exports(const Value& value, const ValueReader& reader) {
  constexpr std::array<std::pair<const char*, ExportKind>, 4> kKinds = {
      {{"ports", ExportKind::kPort},
       {"operations", ExportKind::kOperation},
       {"events", ExportKind::kEvent},
       {"properties", ExportKind::kProperty}}};
  std::vector<Export> exports;
  Fields fields(value, reader, Empty::kAllowed);
  for (const auto& [key, kind] : kKinds) {
    const Value* names = fields.take(key);
    if (names == nullptr || !require_kind(names, Value::Kind::kMap, key, reader)) continue;
    for (const Property& entry : names->entries) {
      const auto target = reader.dotted_name(entry.value, "export " + in_quotes(entry.name));
      if (!target) continue;
      auto [part, member] = split_last_dot(*target);
      if (part.empty()) {
        reader.error(entry.value.where, "export " + in_quotes(entry.name) + " must be part." +
                                            member + ", found " + in_quotes(*target));
        continue;
      }
      exports.push_back({kind, entry.name, std::move(part), std::move(member), entry.value.where});
    }
  }
  fields.refuse_others();
  return exports;
}

void read_head(const Value& head, Document& document, base::Diagnostics& diagnostics) {
  const ValueReader reader("document", diagnostics);
  Fields fields(head, reader, Empty::kAllowed);
  if (const Value* name = fields.take("application")) {
    assign(reader.text(*name, "application"), document.application);
  }
  if (const Value* on_fault = fields.take("on_fault")) {
    assign(reader.choice<OnFault>(*on_fault, "on_fault"), document.on_fault);
  }
  if (const Value* box = fields.take("black_box")) {
    document.black_box = read_black_box(*box, reader);
  }
  if (const Value* threads = fields.take("threads")) {
    document.most_threads = reader.whole_number(*threads, "threads", 1, kMostThreads);
  }
  for (const Value* library : items_of(fields.take("libraries"))) {
    if (auto name = reader.text(*library, "library")) {
      document.libraries.push_back({std::move(*name), library->where});
    }
  }
  if (const Value* priorities = fields.take("priorities")) {
    assign(reader.choice<Priorities>(*priorities, "priorities"), document.priorities);
  }
  for (const Value* warning : items_of(fields.take("accept"))) {
    if (auto name = reader.text(*warning, "accept")) {
      document.accepted.push_back({std::move(*name), warning->where});
    }
  }
  for (OperationOf& input : read_operations(fields.take("operator_inputs"), "input", reader)) {
    const Endpoint to{std::move(input.component), std::move(input.operation), input.where};
    document.operator_inputs.push_back(
        {{exec::kOperatorName, to_text(to), to.where}, to, {}, to.where});
  }
  if (const Value* grants = fields.take("grants")) read_grants(*grants, reader, document);
  document.before_stop = read_operations(fields.take("before_stop"), "before_stop", reader);
  if (const Value* hold = fields.take("hold_at_stop")) {
    document.hold_at_stop = reader.duration(*hold, "hold_at_stop");
  }
  if (const Value* network = fields.take("network")) {
    document.network = read_network(*network, reader);
  }
  if (const Value* modes = fields.take("modes")) read_modes(*modes, reader, document);
  if (const Value* mode = fields.take("mode")) {
    document.mode.where = mode->where;
    assign(reader.text(*mode, "mode"), document.mode.name);
  }
  if (const Value* composed = fields.take("composed")) {
    read_composed(*composed, document, diagnostics);
  }
}

void rebase_paths(Document& document) {
  for (Reference& library : document.libraries) {
    if (library.name.find('/') == std::string::npos) continue;  // found by name
    library.name = rebased(library.name, library.where.file, document.file);
  }
  Network& network = document.network;
  for (Reference* file :
       {&network.policy, &network.certificate, &network.key, &network.authority}) {
    if (!file->name.empty()) file->name = rebased(file->name, file->where.file, document.file);
  }
  for (Component& component : document.components) {
    Reference& interface = component.interface;
    if (!interface.name.empty()) {
      interface.name = rebased(interface.name, interface.where.file, document.file);
    }
    for (PropertyFile& file : component.property_files) {
      file.path = rebased(file.path, file.where.file, document.file);
    }
  }
}

}  // namespace armature::document
