// SPDX-License-Identifier: Apache-2.0
#include <functional>

#include "idl/canonical.hpp"
#include "idl/internal/cpp_text.hpp"

namespace armature::idl::internal {
namespace {

constexpr std::string_view kOptions = "armature::ride::CallOptions options";
constexpr std::string_view kPriority = "armature::ride::Priority priority";

class ClientWriter {
 public:
  explicit ClientWriter(const CppText& text) : text_(text), names_(text.names()) {}

  std::string header() const {
    std::string text = text_.head(true);
    if (raises_events()) text += "#include <functional>\n";
    text += "#include <string>\n#include <utility>\n\n";
    text += text_.include_flags() + "#include \"armature/ride/placeholder.hpp\"\n";
    text += "#include \"" + text_.main().name + "_types.hpp\"\n\n";
    text += text_.begin_name_space();
    for (const Interface& interface : text_.main().interfaces) text += "\n" + declared(interface);
    return text + text_.end_name_space();
  }

  std::string source() const {
    std::string text = text_.head(false) + "#include \"" + text_.main().name + "_client.hpp\"\n\n";
    text += text_.begin_name_space();
    for (const Interface& interface : text_.main().interfaces) {
      for (const Operation& operation : interface.operations) {
        text += "\n" + defined(interface, operation);
      }
    }
    return text + text_.end_name_space();
  }

 private:
  bool raises_events() const {
    for (const Interface& interface : text_.main().interfaces) {
      if (!interface.events.empty()) return true;
    }
    return false;
  }

  std::string declared(const Interface& interface) const {
    const std::string name = names_.placeholder(interface);
    std::vector<std::string> doc{"Stands for a component with the interface " + interface.name +
                                 " in another process."};
    if (!interface.doc.empty()) doc.emplace_back();
    doc.insert(doc.end(), interface.doc.begin(), interface.doc.end());
    std::string text = comment(0, doc) + class_head(name, "armature::ride::Placeholder") +
                       " public:\n" + constructor(interface);
    for (const Operation& operation : interface.operations) {
      text += "\n" + text_.documentation(operation) + function(2, head(interface, operation, true));
    }
    for (const EventName& event : interface.events) text += "\n" + subscription(event);
    return text + "};\n";
  }

  std::string constructor(const Interface& interface) const {
    const std::string head = function(2, {"",
                                          "",
                                          names_.placeholder(interface),
                                          {"armature::ride::Peer& peer", "std::string name"},
                                          ""});
    return comment(2, {"@param peer  the process it lives in",
                       "@param name  the component's name there"}) +
           head + "      : Placeholder(peer, std::move(name), " + names_.constant(interface) +
           ") {}\n";
  }

  Function head(const Interface& interface, const Operation& operation, bool in_class) const {
    Function head;
    head.name = names_.operation(interface, operation.name);
    head.parameters = text_.parameters(operation);
    head.result = operation.is_command()
                      ? "armature::ride::Sent"
                      : "armature::ride::Answer<" + text_.result_type(operation) + ">";
    const std::string last(operation.is_command() ? kPriority : kOptions);
    head.parameters.push_back(last + (in_class ? " = {}" : ""));
    head.tail = in_class ? ";" : " {";
    return head;
  }

  std::string subscription(const EventName& event) const {
    const std::string name = text_.event_type(event.name);
    const Function head{"armature::ride::Subscription",
                        "",
                        names_.handler(event.name),
                        {"std::function<void(const " + name + "&)> handler"},
                        " {"};
    return comment(2, {"Calls `handler` for each " + event.name +
                       " until the Subscription is destroyed."}) +
           short_function(2, head, "return subscribe<" + name + ">(std::move(handler));");
  }

  std::string defined(const Interface& interface, const Operation& operation) const {
    Function definition = head(interface, operation, false);
    definition.owner = names_.placeholder(interface) + "::";
    std::string text = function(0, definition);
    const Items names = text_.parameter_names(operation);
    for (std::size_t i = 0; i < names.size(); ++i) {
      text += range_check(operation, operation.parameters[i], names[i]);
    }
    return text + send(operation) + "}\n";
  }

  std::string range_check(const Operation& operation, const Field& parameter,
                          const std::string& name) const {
    if (parameter.range) {
      Items arguments{name};
      for (const std::string& bound : text_.bounds(*parameter.range, parameter.type.basic)) {
        arguments.push_back(bound);
      }
      const Call problem{"armature::ride::outside(",
                         {literal(name), name, literal(CppText::range_text(*parameter.range))}};
      return call(2, "if (!armature::ride::within(", arguments, ")) {") +
             refusal(operation,
                     [&](const Call& refuse) { return call_with_call(4, refuse, problem, "));"); });
    }
    if (!text_.has_range(parameter.type)) return {};
    const std::string condition =
        parameter.type.is_array() ? "armature::ride::all_in_range(" : "in_range(";
    return "  if (!" + condition + name + ")) {\n" + refusal(operation, [&](const Call& refuse) {
             const std::string problem = "parameter " + name + " has a member outside its range";
             return call(4, refuse.head, {refuse.arguments.front(), literal(problem)}, ");");
           });
  }

  /// `with_problem` completes a call that says which operation it was.
  std::string refusal(const Operation& operation,
                      const std::function<std::string(const Call&)>& with_problem) const {
    if (operation.is_command()) return "    return armature::ride::Sent::kMalformed;\n  }\n";
    return with_problem({"return refuse<" + text_.result_type(operation) + ">(",
                         {literal(operation.name)}}) +
           "  }\n";
  }

  std::string send(const Operation& operation) const {
    Items arguments{hexadecimal(number_of(canonical(text_.program(), operation)))};
    if (operation.is_command()) {
      arguments.emplace_back("priority");
    } else {
      arguments.push_back(literal(operation.name));
      arguments.emplace_back("options");
    }
    const Items names = text_.parameter_names(operation);
    arguments.insert(arguments.end(), names.begin(), names.end());
    if (operation.is_command()) return call(2, "return command(", arguments, ");");
    return call(2, "return request<" + text_.result_type(operation) + ">(", arguments, ");");
  }

  const CppText& text_;
  const CppNames& names_;
};

}  // namespace

std::string write_client_header(const CppText& text) { return ClientWriter(text).header(); }
std::string write_client_source(const CppText& text) { return ClientWriter(text).source(); }

}  // namespace armature::idl::internal
