// SPDX-License-Identifier: Apache-2.0
#include "idl/canonical.hpp"
#include "idl/internal/cpp_text.hpp"
#include "idl/internal/typescript_text.hpp"

namespace armature::idl::internal {
namespace {

class PlaceholderWriter {
 public:
  PlaceholderWriter(const TypescriptText& text, const Interface& interface)
      : text_(text), names_(text.names()), interface_(interface) {}

  std::string run() const {
    std::vector<std::string> doc{"Stands for a component with the interface " + interface_.name +
                                 " in another process."};
    if (!interface_.doc.empty()) doc.emplace_back();
    doc.insert(doc.end(), interface_.doc.begin(), interface_.doc.end());
    std::string text = TypescriptText::documentation(0, doc) + "export class " +
                       names_.placeholder(interface_) + " extends ride.Placeholder {\n" +
                       constructor();
    for (const Operation& operation : interface_.operations) text += "\n" + written(operation);
    for (const EventName& event : interface_.events) text += "\n" + subscription(event.name);
    return text + "}\n";
  }

 private:
  std::string constructor() const {
    const std::string number = hexadecimal(digest(text_.program(), interface_));
    return TypescriptText::documentation(2, {"@param peer  the process it lives in",
                                             "@param name  the component's name there"}) +
           "  constructor(peer: ride.Peer, name: string) {\n" +
           list(4, "super(", {"peer", "name", literal(interface_.name), number}, ");") + "  }\n";
  }

  std::string written(const Operation& operation) const {
    const std::vector<std::string> names = names_.parameters(operation.parameters);
    Items parameters = names;
    for (std::size_t i = 0; i < names.size(); ++i) {
      parameters[i] += ": " + text_.type(operation.parameters[i].type);
    }
    parameters.emplace_back("options?: ride.CallOptions");
    return TypescriptText::documentation(2, documentation_of(operation, names)) +
           list(2, names_.operation(interface_, operation.name) + "(", parameters,
                "): Promise<" + text_.type(operation.result) + "> {") +
           sent(operation, names) + "  }\n";
  }

  std::string sent(const Operation& operation, const std::vector<std::string>& names) const {
    Items values;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const Field& parameter = operation.parameters[i];
      const std::string& known = parameter.name.empty() ? names[i] : parameter.name;
      values.push_back("ride.parameter(" + literal(known) + ", " + text_.description(parameter) +
                       ", " + names[i] + ")");
    }
    const std::string number = hexadecimal(number_of(canonical(text_.program(), operation)));
    const std::string way = operation.is_command() ? "command(" : "request(";
    Items behind{"options"};
    if (!operation.is_command()) behind.insert(behind.begin(), text_.description(operation.result));
    const std::string head = "return this." + way + literal(operation.name) + ", " + number + ", [";
    std::string tail = "]";
    for (const std::string& each : behind) tail += ", " + each;
    return list(4, head, values, tail + ");");
  }

  std::string subscription(const std::string& event) const {
    const std::string name = text_.qualified(event, text_.program().find_event(event)->module);
    return TypescriptText::documentation(
               2, {"Calls `handler` for each " + event + " until the Subscription is ended."}) +
           list(2, names_.handler(event) + "(",
                {"handler: ride.Handler<" + name + ">", "options?: ride.SubscribeOptions"},
                "): ride.Subscription<" + name + "> {") +
           list(4, "return this.subscribe(", {name, "handler", "options"}, ");") + "  }\n";
  }

  const TypescriptText& text_;
  const TypescriptNames& names_;
  const Interface& interface_;
};

}  // namespace

std::vector<std::string> documentation_of(const Operation& operation,
                                          const std::vector<std::string>& names) {
  std::vector<std::string> lines = operation.doc;
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string all;
    for (const std::string& line : CppText::described(operation.parameters[i])) {
      all += (all.empty() ? "" : " ") + line;
    }
    if (!all.empty()) lines.push_back("@param " + names[i] + "  " + all);
  }
  return lines;
}

std::string write_typescript_placeholders(const TypescriptText& text) {
  std::string all;
  for (const Interface& each : text.program().main().interfaces) {
    all += "\n" + PlaceholderWriter(text, each).run();
  }
  return all;
}

}  // namespace armature::idl::internal
