// SPDX-License-Identifier: Apache-2.0
#include "idl/canonical.hpp"
#include "idl/internal/cpp_text.hpp"
#include "idl/internal/typescript_text.hpp"

namespace armature::idl::internal {
namespace {

class TypescriptServiceWriter {
 public:
  TypescriptServiceWriter(const TypescriptText& text, const Interface& interface)
      : text_(text), names_(text.names()), interface_(interface) {}

  std::string run() const {
    std::vector<std::string> doc{"The frame of a component with the interface " + interface_.name +
                                 ": derive, fill in the operations, give it to a Host."};
    if (!interface_.doc.empty()) doc.emplace_back();
    doc.insert(doc.end(), interface_.doc.begin(), interface_.doc.end());
    std::string text = TypescriptText::documentation(0, doc) + "export abstract class " +
                       names_.service(interface_) + " extends ride.Service {\n" + constructor();
    for (const Operation& operation : interface_.operations) text += "\n" + declared(operation);
    for (const EventName& event : interface_.events) text += "\n" + raised(event);
    return text + "}\n";
  }

 private:
  std::string constructor() const {
    const std::string number = hexadecimal(digest(text_.program(), interface_));
    std::string events;
    for (const EventName& each : interface_.events) {
      events += (events.empty() ? "" : ", ") + event_type(each);
    }
    std::string text =
        "  constructor() {\n" +
        list(4, "super(", {literal(interface_.name), number, "[" + events + "]"}, ");");
    for (const Operation& operation : interface_.operations) text += defined(operation);
    return text + "  }\n";
  }

  std::string event_type(const EventName& event) const {
    return text_.qualified(event.name, text_.program().find_event(event.name)->module);
  }

  /// How its message becomes a call of its function.
  std::string defined(const Operation& operation) const {
    const std::vector<std::string> names = names_.parameters(operation.parameters);
    const std::string number = hexadecimal(number_of(canonical(text_.program(), operation)));
    Items values;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const Field& parameter = operation.parameters[i];
      const std::string& known = parameter.name.empty() ? names[i] : parameter.name;
      values.push_back("from.take(" + literal(known) + ", " + text_.description(parameter) + ")");
    }
    values.emplace_back("from.call()");
    return list(4, "ride.Service.define(",
                {"this", literal(operation.name), number,
                 literal(std::string(name_of(operation.access))),
                 text_.description(operation.result), "(from) =>"},
                "") +
           list(6, "this." + names_.operation(interface_, operation.name) + "(", values, "));");
  }

  std::string declared(const Operation& operation) const {
    const std::vector<std::string> names = names_.parameters(operation.parameters);
    Items parameters = names;
    for (std::size_t i = 0; i < names.size(); ++i) {
      parameters[i] += ": " + text_.type(operation.parameters[i].type);
    }
    parameters.push_back(names_.call(names) + ": ride.Call");
    const std::string result = text_.type(operation.result);
    return TypescriptText::documentation(2, documentation_of(operation, names)) +
           list(2, "abstract " + names_.operation(interface_, operation.name) + "(", parameters,
                "): " + result + " | Promise<" + result + ">;");
  }

  std::string raised(const EventName& event) const {
    const std::string type = event_type(event);
    return TypescriptText::documentation(
               2, {"Tells all subscribers, and returns how many had no room for it."}) +
           list(2, "protected " + names_.raiser(interface_, event.name) + "(", {"event: " + type},
                "): number {") +
           list(4, "return ride.Service.raise(",
                {"this", type, "event", std::to_string(event.priority)}, ");") +
           "  }\n";
  }

  const TypescriptText& text_;
  const TypescriptNames& names_;
  const Interface& interface_;
};

}  // namespace

std::string write_typescript_services(const TypescriptText& text) {
  std::string all;
  for (const Interface& each : text.program().main().interfaces) {
    all += "\n" + TypescriptServiceWriter(text, each).run();
  }
  return all;
}

}  // namespace armature::idl::internal
