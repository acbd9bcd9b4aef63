// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/internal/definition_text.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "armature/document/value_tree.hpp"
#include "armature/document/yaml.hpp"
#include "armature/edit/internal/element_text.hpp"
#include "armature/edit/internal/layout.hpp"
#include "armature/edit/internal/scalar_text.hpp"

namespace armature::edit::internal {
namespace {

using document::make_text;
using document::Property;
using document::Value;

/// Names in `${name}` of what stands in a node.
void find_parameters(const SourceText& file, const Node& node, std::set<std::string>& names) {
  if (is_literal(file, node)) return;
  const std::string& text = node.text;
  for (std::size_t at = text.find("${"); at != text.npos; at = text.find("${", at + 2)) {
    const std::size_t end = text.find('}', at);
    if (end != text.npos) names.insert(text.substr(at + 2, end - at - 2));
  }
  for (const Node* child : node.children) find_parameters(file, *child, names);
}

/// Lines of a definition in block style.
class DefinitionWriter {
 public:
  DefinitionWriter(const SourceText& file, const Layout& layout)
      : file_(file),
        end_of_line_(file.end_of_line()),
        step_(layout.step()),
        list_(layout.list_step()) {}

  /// Its first line has no indentation; the others have that of an entry of `composites`.
  std::string text_of(const std::string& name, const Value& parameters,
                      const std::vector<const Entry*>& parts,
                      const std::vector<const ConnectionEntry*>& connections,
                      const Value& exports) {
    text_ = name + ":";
    if (!parameters.entries.empty()) line(2, "parameters: " + written_in_flow(parameters));
    line(2, "components:");
    for (const Entry* part : parts) element(*part->key, 3 * step_, "");
    if (!connections.empty()) line(2, "connections:");
    for (const ConnectionEntry* one : connections) element(*one->item, 2 * step_ + list_, "- ");
    if (!exports.entries.empty()) line(2, "exports:");
    for (const Property& kind : exports.entries) add_exports(kind);
    return text_;
  }

 private:
  void line(std::size_t level, const std::string& text) {
    text_ += end_of_line_ + spaces(level * step_) + text;
  }

  void element(const Node& first, std::size_t column, const std::string& dash) {
    const std::string margin = end_of_line_ + spaces(column);
    for (const std::string& comment : comments_above(file_, first)) text_ += margin + comment;
    CopyChanges changes;
    changes.comment_behind = true;
    text_ += margin + dash +
             moved_lines(copied_element(file_, first, changes), file_.column(first.begin),
                         column + dash.size());
  }

  void add_exports(const Property& kind) {
    constexpr std::size_t kWidth = 100;
    const std::string flow = kind.name + ": " + written_in_flow(kind.value);
    if (3 * step_ + flow.size() <= kWidth) return line(3, flow);
    line(3, kind.name + ":");
    for (const Property& one : kind.value.entries) {
      line(4, written_in_block(make_text(one.name)) + ": " + written_in_block(one.value));
    }
  }

  const SourceText& file_;
  std::string end_of_line_;
  std::size_t step_;
  std::size_t list_;
  std::string text_;
};

/// The document's parameters that parts and connections use, with the values that they have now.
Value parameters_of(const SourceText& file, const std::vector<const Entry*>& parts,
                    const std::vector<const ConnectionEntry*>& connections,
                    const document::Document& document) {
  std::set<std::string> names;
  for (const Entry* part : parts) {
    find_parameters(file, *part->key, names);
    find_parameters(file, *part->value, names);
  }
  for (const ConnectionEntry* one : connections) find_parameters(file, *one->item, names);
  Value parameters = document::make_map();
  for (const Property& parameter : document.parameters) {
    if (!names.contains(parameter.name)) continue;
    parameters.entries.push_back({parameter.name, parameter.value, {}, {}});
  }
  return parameters;
}

/// `{model: Arm, properties: {bus: "${bus}"}}`.
std::string instance_text(const std::string& name, const Value& parameters) {
  Value body = document::make_map();
  body.entries.push_back({"model", make_text(name), {}, {}});
  Value given = document::make_map();
  for (const Property& parameter : parameters.entries) {
    given.entries.push_back({parameter.name, make_text("${" + parameter.name + "}"), {}, {}});
  }
  if (!given.entries.empty()) body.entries.push_back({"properties", given, {}, {}});
  return name + ": " + written_in_flow(body);
}

void write_section(const SourceText& file, const std::string& definition, Workshop& shop) {
  Layout& layout = shop.layout(file);
  const Node* section = find_value(file.root(), "composites");
  if (file.root()->flow || (section != nullptr && (section->flow || section->children.empty()))) {
    const Node& node = section == nullptr ? *file.root() : *section;
    return shop.refuse(file.place_of(node),
                       "a definition stands on lines of its own, not in brackets",
                       "write 'composites' without brackets first");
  }
  if (section != nullptr) return layout.add_entry_text(*section, definition);
  const std::string end_of_line{file.end_of_line()};
  layout.add_section_text(*find_key(file.root(), "components"),
                          "composites:" + end_of_line + spaces(layout.step()) + definition);
}

void move_out(const SourceText& file, const GroupMembers& members,
              const std::vector<const ConnectionEntry*>& connections, const std::string& instance,
              Workshop& shop) {
  Layout& layout = shop.layout(file);
  const Node& first = *members.entries().front()->key;
  layout.replace_with_comments(first, instance);
  for (const Entry* part : members.entries()) {
    if (part->key != &first) layout.remove_with_comments(*part->key);
  }
  const Node* list = find_value(file.root(), "connections");
  const bool all = list != nullptr && items_of(list).size() == connections.size();
  for (const ConnectionEntry* one : connections) {
    if (all) {
      layout.remove(*one->item);  // the comments among them go with the section
    } else {
      layout.remove_with_comments(*one->item);
    }
  }
}

}  // namespace

void write_definition(const std::string& name, const GroupMembers& members,
                      const std::vector<const ConnectionEntry*>& connections, const Value& exports,
                      Workshop& shop) {
  const SourceText& file = members.file();
  const Value parameters = parameters_of(file, members.entries(), connections, shop.document());
  Value literal = document::make_map();
  for (Property one : parameters.entries) {
    one.value.literal = one.value.text.find_first_of("{$") != std::string::npos;
    literal.entries.push_back(std::move(one));
  }
  const std::string definition =
      DefinitionWriter(file, shop.layout(file))
          .text_of(name, literal, members.entries(), connections, exports);
  write_section(file, definition, shop);
  if (shop.ok()) move_out(file, members, connections, instance_text(name, parameters), shop);
}

std::string section_of(const Node& node) {
  const Node* inner = &node;
  while (inner->parent != nullptr && inner->parent->parent != nullptr) inner = inner->parent;
  if (inner->parent == nullptr || inner->parent->kind != Node::Kind::kMap) return {};
  const auto& all = inner->parent->children;
  const auto at = std::find(all.begin(), all.end(), inner) - all.begin();
  return all[static_cast<std::size_t>(at - at % 2)]->text;
}

std::string key_around(const Node& node) {
  for (const Node* inner = &node; inner->parent != nullptr; inner = inner->parent) {
    for (const char* key : {"peers", "bind", "delays"}) {
      if (find_value(inner->parent, key) == inner) return key;
    }
  }
  return {};
}

void add_composite(const document::Document& found, const std::string& name,
                   document::Document& expected) {
  for (std::size_t i = 0; i < found.composites.size(); ++i) {
    if (found.composites[i].name != name || found.composites[i].model != name) continue;
    const auto at = static_cast<std::ptrdiff_t>(std::min(i, expected.composites.size()));
    expected.composites.insert(expected.composites.begin() + at, found.composites[i]);
    return;
  }
}

void take_order_of_modes(const document::Document& found, document::Document& expected) {
  const auto names_of = [](const document::Mode& mode) {
    std::vector<std::string> names;
    for (const auto& one : mode.components) names.push_back(one.name);
    std::ranges::sort(names);
    return names;
  };
  for (std::size_t i = 0; i < std::min(found.modes.size(), expected.modes.size()); ++i) {
    const auto& other = found.modes[i];
    if (other.name != expected.modes[i].name) continue;
    if (names_of(other) == names_of(expected.modes[i])) expected.modes[i] = other;
  }
}

}  // namespace armature::edit::internal
