// SPDX-License-Identifier: Apache-2.0
#include "idl/json_backend.hpp"

#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "idl/canonical.hpp"
#include "idl/number.hpp"

namespace armature::idl {
namespace {

using Json = nlohmann::ordered_json;

Json doc_of(const Doc& doc) {
  std::string text;
  for (const std::string& line : doc) text += (&line == &doc.front() ? "" : "\n") + line;
  return text;
}

Json number(const Whole& whole) {
  if (!whole.negative) return whole.magnitude;
  return static_cast<std::int64_t>(~whole.magnitude + 1);
}

Json number(const std::string& text, Basic type) {
  if (!is_whole_number(type)) return parse_real(text).value_or(0.0);
  return number(parse_whole(text).value_or(Whole{}));
}

/// `type` as written; of an array also what is in it, and how many.
void add_type(Json& to, const std::string& key, const Type& type) {
  to[key] = to_text(type);
  if (!type.is_array()) return;
  to["element"] = to_text(type.element());
  to["count"] = type.form == Type::Form::kFixed ? Json(type.count) : Json(nullptr);
}

Json fields(const std::vector<Field>& all) {
  Json list = Json::array();
  for (const Field& field : all) {
    Json one;
    one["name"] = field.name.empty() ? Json(nullptr) : Json(field.name);
    add_type(one, "type", field.type);
    if (!field.unit.empty()) one["unit"] = field.unit;
    if (field.range) {
      one["range"] = {number(field.range->low, field.type.basic),
                      number(field.range->high, field.type.basic)};
    }
    one["doc"] = doc_of(field.doc);
    list.push_back(std::move(one));
  }
  return list;
}

class Writer {
 public:
  Writer(const Program& program, const CppNames& names) : program_(program), names_(names) {}

  Json run() {
    const Module& main = program_.main();
    find_used();
    Json all;
    all["rcidl"] = 1;
    all["name"] = main.name;
    all["namespace"] = names_.name_space(main);
    all["imports"] = Json::array();
    for (const Import& import : main.imports) all["imports"].push_back(import.path);
    all["enums"] = enumerations();
    all["structs"] = structures(false);
    all["events"] = structures(true);
    all["interfaces"] = Json::array();
    for (const Interface& each : main.interfaces) all["interfaces"].push_back(interface(each));
    return all;
  }

 private:
  void find_used() {
    const Module& main = program_.main();
    for (const Enumeration& each : main.enumerations) used_enums_.insert(&each);
    for (const Structure& each : main.structures) use(each);
    for (const Interface& each : main.interfaces) {
      for (const EventName& event : each.events) use(*program_.find_event(event.name));
      for (const Operation& operation : each.operations) {
        use(operation.result);
        for (const Field& parameter : operation.parameters) use(parameter.type);
      }
    }
  }

  void use(const Type& type) {
    if (type.basic == Basic::kStruct) use(*program_.find_struct(type.name));
    if (type.basic == Basic::kEnum) used_enums_.insert(program_.find_enum(type.name));
  }

  void use(const Structure& structure) {
    if (!used_.insert(&structure).second) return;
    for (const Field& member : structure.members) use(member.type);
  }

  /// In the order in which they are defined, imported ones first.
  Json enumerations() {
    Json list = Json::array();
    for (const Module& module : program_.modules()) {
      for (const Enumeration& each : module.enumerations) {
        if (used_enums_.contains(&each)) list.push_back(enumeration(each));
      }
    }
    return list;
  }

  static Json enumeration(const Enumeration& enumeration) {
    Json one;
    one["name"] = enumeration.name;
    one["module"] = enumeration.module;
    one["canonical"] = canonical(enumeration);
    one["type"] = name_of(enumeration.underlying);
    one["doc"] = doc_of(enumeration.doc);
    one["enumerators"] = Json::array();
    for (const Enumerator& each : enumeration.enumerators) {
      one["enumerators"].push_back(
          {{"name", each.name}, {"value", number(each.value)}, {"doc", doc_of(each.doc)}});
    }
    return one;
  }

  /// In the same order.
  Json structures(bool events) {
    Json list = Json::array();
    for (const Module& module : program_.modules()) {
      for (const Structure& each : module.structures) {
        if (each.is_event != events || used_.count(&each) == 0) continue;
        Json one;
        one["name"] = each.name;
        one["module"] = each.module;
        one["canonical"] = canonical(program_, each);
        if (events) one["number"] = number_of(canonical(program_, each));
        one["doc"] = doc_of(each.doc);
        one["members"] = fields(each.members);
        list.push_back(std::move(one));
      }
    }
    return list;
  }

  Json interface(const Interface& interface) {
    Json one;
    one["name"] = interface.name;
    one["digest"] = digest(program_, interface);
    one["doc"] = doc_of(interface.doc);
    one["operations"] = Json::array();
    for (const Operation& each : interface.operations) one["operations"].push_back(operation(each));
    one["events"] = Json::array();
    Json priorities;
    for (const EventName& event : interface.events) {
      one["events"].push_back(event.name);
      if (event.priority != 0) priorities[event.name] = event.priority;
    }
    if (!priorities.empty()) one["event_priorities"] = std::move(priorities);
    one["declarations"] = declarations(program_, interface);
    return one;
  }

  Json operation(const Operation& operation) {
    Json one;
    one["name"] = operation.name;
    one["canonical"] = canonical(program_, operation);
    one["number"] = number_of(canonical(program_, operation));
    one["mode"] = operation.is_command() ? "command" : "request";
    one["access"] = name_of(operation.access);
    if (operation.priority != 0) one["priority"] = operation.priority;
    one["doc"] = doc_of(operation.doc);
    Json result;
    add_type(result, "type", operation.result);
    one["result"] = std::move(result);
    one["parameters"] = fields(operation.parameters);
    return one;
  }

  const Program& program_;
  const CppNames& names_;
  std::set<const Structure*> used_;
  std::set<const Enumeration*> used_enums_;
};

}  // namespace

OutputFile write_json(const Program& program, const CppNames& names) {
  return {program.main().name + ".json", Writer(program, names).run().dump(2) + "\n"};
}

}  // namespace armature::idl
