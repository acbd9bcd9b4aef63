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
    for (const Interface& interface : text_.main().interfaces) text += "\n" + class_of(interface);
    return text + text_.end_name_space();
  }

  std::string source() const {
    std::string text = text_.head(false) + "#include \"" + text_.main().name + "_client.hpp\"\n\n";
    text += text_.begin_name_space();
    for (const Interface& interface : text_.main().interfaces) {
      for (const Operation& operation : interface.operations) {
        text += "\n" + definition(interface, operation);
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

  std::string class_of(const Interface& interface) const {
    const std::string name = names_.placeholder(interface);
    std::vector<std::string> doc{"Stands for a component with the interface " + interface.name +
                                 " in another process."};
    if (!interface.doc.empty()) doc.emplace_back();
    doc.insert(doc.end(), interface.doc.begin(), interface.doc.end());
    std::string text = comment(0, doc) +
                       declaration(0, "class " + name, ": public armature::ride::Placeholder {") +
                       " public:\n" + constructor(interface);
    for (const Operation& operation : interface.operations) {
      text += "\n" + text_.documentation(operation) +
              declared(2, head(interface, operation, "", priority_of(operation)));
    }
    for (const EventName& event : interface.events) text += "\n" + subscription(event);
    return text + "};\n";
  }

  std::string constructor(const Interface& interface) const {
    return comment(2, {"@param peer  the process it lives in",
                       "@param name  the component's name there"}) +
           list(2, names_.placeholder(interface) + "(",
                {"armature::ride::Peer& peer", "std::string name"}, ")") +
           list(6, ": Placeholder(", {"peer", "std::move(name)", names_.constant(interface)},
                ") {}");
  }

  /// The default of the last parameter: what the definition says, where it says something.
  static std::string priority_of(const Operation& operation) {
    if (operation.priority == 0) return " = {}";
    const std::string level = std::to_string(operation.priority);
    return operation.is_command() ? " = {" + level + "}" : " = {.priority = {" + level + "}}";
  }

  /// @param behind  its last parameter, in the class only: the default
  Function head(const Interface& interface, const Operation& operation, const std::string& in_front,
                const std::string& behind) const {
    Function head;
    head.name = in_front + names_.operation(interface, operation.name);
    head.parameters = text_.parameters(operation);
    head.result = operation.is_command()
                      ? "armature::ride::Sent"
                      : "armature::ride::Answer<" + text_.result_type(operation) + ">";
    head.parameters.push_back(std::string(operation.is_command() ? kPriority : kOptions) + behind);
    return head;
  }

  std::string subscription(const EventName& event) const {
    const std::string name = text_.event_type(event.name);
    return comment(2, {"Calls `handler` for each " + event.name +
                       " until the Subscription is destroyed."}) +
           defined(2,
                   {"armature::ride::Subscription",
                    names_.handler(event.name),
                    {"std::function<void(const " + name + "&)> handler"}},
                   list(4, "return subscribe<" + name + ">(", {"std::move(handler)"}, ");"));
  }

  std::string definition(const Interface& interface, const Operation& operation) const {
    std::string body;
    const Items names = text_.parameter_names(operation);
    for (std::size_t i = 0; i < names.size(); ++i) {
      body += range_check(operation, operation.parameters[i], names[i]);
    }
    return defined(0, head(interface, operation, names_.placeholder(interface) + "::", ""),
                   body + send(operation));
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
      return list(2, "if (!armature::ride::within(", arguments, ")) {") +
             refusal(operation,
                     [&](const Call& refuse) { return call_with_call(4, refuse, problem, "));"); });
    }
    if (!text_.has_range(parameter.type)) return {};
    const std::string condition =
        parameter.type.is_array() ? "armature::ride::all_in_range(" : "in_range(";
    return list(2, "if (!" + condition, {name}, ")) {") + refusal(operation, [&](Call refuse) {
             const std::string problem = "parameter " + name + " has a member outside its range";
             refuse.arguments.push_back(literal(problem));
             return list(4, refuse.head, refuse.arguments, ");");
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
    if (operation.is_command()) return list(2, "return command(", arguments, ");");
    return list(2, "return request<" + text_.result_type(operation) + ">(", arguments, ");");
  }

  const CppText& text_;
  const CppNames& names_;
};

}  // namespace

std::string write_client_header(const CppText& text) { return ClientWriter(text).header(); }
std::string write_client_source(const CppText& text) { return ClientWriter(text).source(); }

}  // namespace armature::idl::internal
