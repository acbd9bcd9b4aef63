// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/internal/references.hpp"

#include <string_view>
#include <utility>

namespace armature::edit::internal {
namespace {

using Form = Mention::Form;

/// Goes through the sections of a file in which components are named.
class Finder {
 public:
  Finder(const SourceText& file, std::vector<Mention>& found) : file_(file), found_(found) {}

  void look_through() {
    const Node* root = file_.root();
    level(root, {});
    each_value(find_value(root, "composites"), [&](const std::string& name, const Node* body) {
      level(body, name);
      each_value(find_value(body, "exports"), [&](const std::string&, const Node* kind) {
        each_value(kind,
                   [&](const std::string&, const Node* part) { add(part, Form::kMember, name); });
      });
    });
    items(find_value(root, "before_stop"), Form::kMember, {});
    items(find_value(root, "operator_inputs"), Form::kMember, {});
    each_value(find_value(root, "grants"),
               [&](const std::string&, const Node* granted) { items(granted, Form::kMember, {}); });
    each_value(find_value(root, "modes"), [&](const std::string&, const Node* components) {
      items(components, Form::kName, {});
    });
    for (const Node* input : items_of(find_value(find_value(root, "network"), "inputs"))) {
      const Node* to = input->kind == Node::Kind::kMap ? find_value(input, "to") : input;
      add(to, Form::kMember, {}, input);
    }
  }

 private:
  template <typename Visit>
  static void each_value(const Node* map, const Visit& visit) {
    if (map == nullptr || map->kind != Node::Kind::kMap) return;
    for (std::size_t i = 0; i + 1 < map->children.size(); i += 2) {
      visit(map->children[i]->text, map->children[i + 1]);
    }
  }

  void level(const Node* body, const std::string& composite) {
    each_value(find_value(body, "components"), [&](const std::string&, const Node* component) {
      peers(find_value(component, "peers"), composite);
      peers(find_value(component, "superiors"), composite);
      items(find_value(component, "delays"), Form::kName, composite);
      each_value(find_value(component, "bind"), [&](const std::string&, const Node* member) {
        const bool named = last_dot(member->text) == member->text.npos;
        add(member, named ? Form::kName : Form::kMember, composite);
      });
      for (const Node* call : items_of(find_value(component, "calls"))) {
        add(call, Form::kMember, composite);
        add(find_value(call, "call"), Form::kMember, composite, call);
        each_value(find_value(call, "with"), [&](const std::string&, const Node* value) {
          add(value, Form::kParameter, composite, call);
        });
      }
    });
    in_connections_ = true;
    for (const Node* item : items_of(find_value(body, "connections"))) connection(item, composite);
    in_connections_ = false;
  }

  void peers(const Node* peers, const std::string& composite) {
    for (const Node* peer : items_of(peers)) {
      add(peer, Form::kName, composite);
      each_value(
          peer, [&](const std::string&, const Node* named) { add(named, Form::kName, composite); });
    }
  }

  void connection(const Node* item, const std::string& composite) {
    add(item, Form::kArrow, composite, item);
    for (const char* end : {"from", "to", "on", "do"}) {
      add(find_value(item, end), Form::kMember, composite, item);
    }
    for (const Node* port : items_of(find_value(item, "ports"))) {
      add(port, Form::kMember, composite);
    }
    each_value(find_value(item, "with"), [&](const std::string&, const Node* value) {
      add(value, Form::kParameter, composite, item);
    });
  }

  void items(const Node* list, Form form, const std::string& composite) {
    for (const Node* item : items_of(list)) add(item, form, composite);
  }

  void add(const Node* node, Form form, const std::string& composite, const Node* whole = nullptr) {
    if (node == nullptr || node->kind != Node::Kind::kScalar || node->is_empty()) return;
    found_.push_back(
        {&file_, node, form, composite, whole == nullptr ? node : whole, in_connections_});
  }

  const SourceText& file_;
  std::vector<Mention>& found_;
  bool in_connections_ = false;
};

}  // namespace

std::size_t last_dot(std::string_view text) {
  int depth = 0;
  for (std::size_t i = text.size(); i-- > 0;) {
    if (text[i] == '}') ++depth;
    if (text[i] == '{') --depth;
    if (text[i] == '.' && depth == 0) return i;
  }
  return text.npos;
}

std::vector<Mention::Part> Mention::parts() const {
  constexpr std::string_view kBlanks = " \t";
  constexpr std::string_view kArrowText = "->";
  std::vector<Part> parts;
  const std::string_view text = node->text;
  const auto add = [&](std::size_t begin, std::size_t end) {
    while (begin < end && kBlanks.find(text[begin]) != kBlanks.npos) ++begin;
    while (begin < end && kBlanks.find(text[end - 1]) != kBlanks.npos) --end;
    if (form != Form::kName) {
      const std::size_t dot = last_dot(text.substr(begin, end - begin));
      end = dot == text.npos ? begin : begin + dot;
    }
    if (begin < end) parts.push_back({begin, end - begin});
  };
  const std::size_t arrow = form == Form::kArrow ? text.find(kArrowText) : text.npos;
  add(0, arrow == text.npos ? text.size() : arrow);
  if (arrow != text.npos) add(arrow + kArrowText.size(), text.size());
  return parts;
}

std::vector<std::string> Mention::names() const {
  std::vector<std::string> names;
  for (const Part& part : parts()) names.push_back(node->text.substr(part.begin, part.size));
  return names;
}

std::vector<Mention> mentions_in(const SourceMap& map) {
  std::vector<Mention> found;
  for (const auto& file : map.files()) Finder(*file, found).look_through();
  return found;
}

}  // namespace armature::edit::internal
