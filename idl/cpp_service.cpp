// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "idl/canonical.hpp"
#include "idl/internal/cpp_text.hpp"

namespace armature::idl::internal {
namespace {

const std::string kMalformed = "return armature::ride::Executed::kMalformed;\n";
const std::string kUnknown = "return armature::ride::Executed::kNoSuchOperation;\n";

class ServiceWriter {
 public:
  explicit ServiceWriter(const CppText& text) : text_(text), names_(text.names()) {}

  std::string header() const {
    std::string text = text_.head(true) + text_.include_flags() +
                       "#include \"armature/ride/service.hpp\"\n" + "#include \"" +
                       text_.main().name + "_types.hpp\"\n\n" + text_.begin_name_space();
    for (const Interface& interface : text_.main().interfaces) text += "\n" + class_of(interface);
    return text + text_.end_name_space();
  }

  std::string source() const {
    std::string text = text_.head(false) + "#include \"" + text_.main().name +
                       "_service.hpp\"\n\n" + text_.begin_name_space();
    for (const Interface& interface : text_.main().interfaces) text += "\n" + definition(interface);
    return text + text_.end_name_space();
  }

 private:
  std::string class_of(const Interface& interface) const {
    const std::string name = names_.service(interface);
    std::vector<std::string> doc{"The frame of a component with the interface " + interface.name +
                                 ": derive, fill in the operations, give it to a Node."};
    if (!interface.doc.empty()) doc.emplace_back();
    doc.insert(doc.end(), interface.doc.begin(), interface.doc.end());
    std::string text = comment(0, doc) +
                       declaration(0, "class " + name, ": public armature::ride::Service {") +
                       " public:\n  " + name + "();\n";
    for (const Operation& operation : interface.operations) {
      text +=
          "\n" + text_.documentation(operation) + declared(2, head(interface, operation), " = 0;");
    }
    text += "\n";
    if (!interface.events.empty()) text += " protected:\n";
    for (const EventName& event : interface.events) text += raise(event) + "\n";
    return text + " private:\n" +
           declared(2, execute_head("", !interface.operations.empty()), " override;") + "};\n";
  }

  Function head(const Interface& interface, const Operation& operation) const {
    Items parameters = text_.parameters(operation);
    if (operation.later) parameters.push_back(reply_type(operation) + " reply");
    return {"virtual " + (operation.later ? "void" : text_.result_type(operation)),
            names_.operation(interface, operation.name), parameters};
  }

  std::string reply_type(const Operation& operation) const {
    return "armature::ride::ReplyOf<" + text_.result_type(operation) + ">";
  }

  static std::string priority_of(const EventName& event) {
    return event.priority == 0 ? "" : ", {" + std::to_string(event.priority) + "}";
  }

  std::string raise(const EventName& event) const {
    const std::string type = text_.event_type(event.name);
    return comment(2, {"Tells all subscribers.  @thread any"}) +
           defined(2, {"void", "raise", {"const " + type + "& event"}},
                   "    publish(event" + priority_of(event) + ");\n");
  }

  static Function execute_head(const std::string& owner, bool named) {
    const auto parameter = [&](std::string type, const std::string& name) {
      return named ? type + " " + name : type;
    };
    return {"armature::ride::Executed",
            owner + "execute",
            {parameter("armature::ride::Number", "operation"),
             parameter("armature::ride::Decoder&", "parameters"),
             parameter("armature::ride::Reply&", "reply")}};
  }

  std::string definition(const Interface& interface) const {
    const std::string name = names_.service(interface);
    const bool has_operations = !interface.operations.empty();
    std::string body;
    if (has_operations) {
      body = "  switch (operation) {\n";
      for (const Operation& operation : interface.operations) body += branch(interface, operation);
      body += "    default:\n      " + kUnknown + "  }\n";
    } else {
      body = "  " + kUnknown;
    }
    return declaration(0, name + "::" + name + "()",
                       ": Service(" + names_.constant(interface) + ") {}") +
           "\n" + defined(0, execute_head(name + "::", has_operations), body);
  }

  /// What one operation does with its message.
  std::string branch(const Interface& interface, const Operation& operation) const {
    const Items names = text_.parameter_names(operation);
    std::string text = "    case " + hexadecimal(number_of(canonical(text_.program(), operation))) +
                       ": {  // " + operation.name + "\n";
    Items problems;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const Type& type = operation.parameters[i].type;
      text += declaration(6, text_.variable_type(type), names[i] + text_.initial(type) + ";");
      problems.push_back("!parameters.take(" + names[i] + ")");
    }
    problems.emplace_back("!parameters.ended()");
    text += chain(6, "if (", problems, "||", ") {") + "        " + kMalformed + "      }\n";
    for (std::size_t i = 0; i < names.size(); ++i) {
      text += range_check(operation.parameters[i], names[i]);
    }
    return text + execution(interface, operation, names) +
           "      return armature::ride::Executed::kDone;\n    }\n";
  }

  /// Ranges of a struct's members are looked at where it is decoded.
  std::string range_check(const Field& parameter, const std::string& name) const {
    if (!parameter.range) return {};
    Items arguments{literal(name), name};
    for (const std::string& bound : text_.bounds(*parameter.range, parameter.type.basic)) {
      arguments.push_back(bound);
    }
    return list(6, "if (!parameters.expect_within(", arguments, ")) {") + "        " + kMalformed +
           "      }\n";
  }

  std::string execution(const Interface& interface, const Operation& operation,
                        const Items& names) const {
    const std::string name = names_.operation(interface, operation.name);
    // A variable of execute() may have the operation's name.
    const bool hidden = std::find(names.begin(), names.end(), name) != names.end() ||
                        name == "operation" || name == "parameters" || name == "reply";
    const std::string begin = (hidden ? "this->" : "") + name + "(";
    if (operation.is_command()) return list(6, begin, names, ");") + "      reply.done();\n";
    if (!operation.later) return call_with_call(6, {"reply.put(", {}}, {begin, names}, "));");
    Items given = names;
    given.push_back(reply_type(operation) + "(reply)");
    return list(6, begin, given, ");") + "      armature::ride::expect_settled(reply);\n";
  }

  const CppText& text_;
  const CppNames& names_;
};

}  // namespace

std::string write_service_header(const CppText& text) { return ServiceWriter(text).header(); }
std::string write_service_source(const CppText& text) { return ServiceWriter(text).source(); }

}  // namespace armature::idl::internal
