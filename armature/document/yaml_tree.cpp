// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <exception>
#include <optional>
#include <sstream>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include "armature/base/near_name.hpp"
#include "armature/document/internal/yaml_syntax.hpp"
#include "armature/document/source_text.hpp"
#include "armature/document/typed_text.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/document/yaml.hpp"

namespace armature::document {
namespace {

bool may_have_type(Value::Kind kind, std::string_view type) {
  return kind == Value::Kind::kText   ? is_simple_type(type)
         : kind == Value::Kind::kList ? is_list_type(type)
                                      : false;
}

/// The tags that YAML itself defines for texts, lists and maps.
bool is_standard_tag(std::string_view tag) {
  constexpr std::string_view kStandard = "tag:yaml.org,2002:";
  if (tag.empty() || tag == "?" || tag == "!") return true;
  if (!tag.starts_with(kStandard)) return false;
  constexpr std::array<std::string_view, 7> kKnown = {"str",  "int", "float", "bool",
                                                      "null", "map", "seq"};
  return std::find(kKnown.begin(), kKnown.end(), tag.substr(kStandard.size())) != kKnown.end();
}

/// Ends the parse from inside yaml-cpp once the reason has been reported.
struct Abandoned {};

/// Builds a tree from yaml-cpp's events.
class TreeBuilder final : public YAML::EventHandler {
 public:
  TreeBuilder(const std::string& file, const std::optional<base::Location>& fixed,
              const Limits& limits, base::Diagnostics& diagnostics)
      : file_(file), fixed_(fixed), limits_(limits), diagnostics_(diagnostics) {}

  Value take_root() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ < 2) return;
    abandon(place(mark), "a second document begins here", "remove the line '---'");
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    Value value;
    value.where = place(mark);
    add(std::move(value), anchor, 1);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    Value value = make(Value::Kind::kText, mark, tag);
    value.text = text;
    add(std::move(value), anchor, 1);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end())
      abandon(place(mark), "the alias refers to the value that contains it");
    if (open_.size() + depth_of(found->second.value) > static_cast<std::size_t>(limits_.depth)) {
      refuse_depth(place(mark));
    }
    add(found->second.value, 0, found->second.nodes);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(make(Value::Kind::kList, mark, tag), anchor);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(make(Value::Kind::kMap, mark, tag), anchor);
  }
  void OnMapEnd() override {
    merge_defaults(open_.back().value);
    refuse_twins(open_.back().value);
    close();
  }

 private:
  struct Open {
    Value value;
    YAML::anchor_t anchor;
    std::size_t nodes_before;
    std::optional<Value> key;  ///< of a map: the key whose value comes next
  };
  struct Anchored {
    Value value;
    std::size_t nodes;
  };

  base::Location place(const YAML::Mark& mark) const {
    if (fixed_) return *fixed_;
    return {file_, mark.line + 1, mark.column + 1};
  }

  [[noreturn]] void abandon(base::Location where, std::string message, std::string hint = {}) {
    diagnostics_.error(std::move(where), std::move(message), std::move(hint));
    throw Abandoned{};
  }

  [[noreturn]] void refuse_depth(base::Location where) {
    abandon(std::move(where),
            "lists and maps are nested more than " + std::to_string(limits_.depth) + " deep");
  }

  Value make(Value::Kind kind, const YAML::Mark& mark, const std::string& tag) {
    Value value;
    value.kind = kind;
    value.where = place(mark);
    apply_tag(tag, value);
    return value;
  }

  void apply_tag(const std::string& tag, Value& value) {
    if (is_standard_tag(tag)) return;
    const std::string name = tag.substr(tag[0] == '!' ? 1 : 0);
    const bool is_map = value.kind == Value::Kind::kMap;
    const bool of_struct = is_map && name.starts_with(kStructTag);
    if (name == "literal") {
      value.literal = true;
    } else if (may_have_type(value.kind, name)) {
      value.type = name;
    } else if (of_struct && is_struct_type(name.substr(kStructTag.size()))) {
      value.type = name.substr(kStructTag.size());
    } else {
      const std::string known = "known: !literal and the types of OROCOS property files";
      diagnostics_.error(value.where, "unknown tag " + in_quotes(tag),
                         is_map ? known + ", !orocos:TYPE for a struct" : known);
    }
  }

  void open(Value value, YAML::anchor_t anchor) {
    if (open_.size() >= static_cast<std::size_t>(limits_.depth)) refuse_depth(value.where);
    open_.push_back({std::move(value), anchor, nodes_, {}});
  }

  void close() {
    Open closed = std::move(open_.back());
    open_.pop_back();
    const std::size_t nodes = nodes_ - closed.nodes_before + 1;
    nodes_ = closed.nodes_before;  // `add` counts them again, with this one
    add(std::move(closed.value), closed.anchor, nodes);
  }

  void count(std::size_t nodes, const base::Location& where) {
    nodes_ += nodes;
    if (nodes_ + anchored_nodes_ <= limits_.nodes) return;
    abandon(where, "the document has more than " + std::to_string(limits_.nodes) + " values");
  }

  void add(Value value, YAML::anchor_t anchor, std::size_t nodes) {
    if (anchor != 0) {
      anchored_nodes_ += nodes;
      anchors_[anchor] = {value, nodes};
    }
    count(nodes, value.where);
    if (open_.empty()) {
      root_ = std::move(value);
    } else if (open_.back().value.kind == Value::Kind::kList) {
      open_.back().value.items.push_back(std::move(value));
    } else {
      add_to_map(open_.back(), std::move(value));
    }
  }

  void add_to_map(Open& map, Value value) {
    if (!map.key) {
      if (value.kind != Value::Kind::kText) {
        diagnostics_.error(value.where, "a key must be text");
        value.text.clear();
      }
      map.key = std::move(value);
      return;
    }
    if (value.kind == Value::Kind::kNone) value.where = map.key->where;
    if (map.key->kind == Value::Kind::kText) {
      value.literal = value.literal || map.key->literal;
      map.value.entries.push_back({map.key->text, std::move(value), {}, map.key->where});
    }
    map.key.reset();
  }

  /// `<<: *defaults`: what the map itself says goes before what it takes over.
  void merge_defaults(Value& map) {
    const Property* merge = find(map.entries, "<<");
    if (merge == nullptr) return;
    const Property taken = *merge;
    std::erase_if(map.entries, [](const Property& entry) { return entry.name == "<<"; });
    std::unordered_set<std::string> own;
    for (const Property& entry : map.entries) own.insert(entry.name);
    const bool one = taken.value.kind == Value::Kind::kMap;
    for (const Value& defaults : one ? std::vector<Value>{taken.value} : taken.value.items) {
      for (const Property& entry : defaults.entries) {
        if (own.insert(entry.name).second) map.entries.push_back(entry);
      }
    }
    if (!one && taken.value.kind != Value::Kind::kList) {
      diagnostics_.error(taken.where, "'<<' takes a map or a list of maps");
    }
  }

  /// Keeps the first of entries with the same key.
  void refuse_twins(Value& map) {
    std::unordered_map<std::string, base::Location> first;
    std::erase_if(map.entries, [&](const Property& entry) {
      const auto [found, is_new] = first.emplace(entry.name, entry.where);
      if (!is_new) {
        diagnostics_.error(entry.where, "'" + entry.name + "' is given twice",
                           "first at " + place_text(found->second));
      }
      return !is_new;
    });
  }

  const std::string& file_;
  const std::optional<base::Location>& fixed_;
  const Limits& limits_;
  base::Diagnostics& diagnostics_;
  std::vector<Open> open_;
  std::unordered_map<YAML::anchor_t, Anchored> anchors_;
  std::size_t nodes_ = 0;
  std::size_t anchored_nodes_ = 0;
  int documents_ = 0;
  Value root_;
};

/// Says what is no YAML: a bracket or quote that was opened and not closed, or what yaml-cpp says.
void report_syntax(const YAML::Exception& error, std::string_view text, const std::string& file,
                   const std::optional<base::Location>& fixed, base::Diagnostics& diagnostics) {
  const base::Location found = {file, std::max(0, error.mark.line) + 1,
                                std::max(0, error.mark.column) + 1};
  const LineIndex lines(text, file);
  const std::string not_yaml = "this is not YAML: ";
  if (const std::optional<Unclosed> open = find_unclosed(text)) {
    const std::string the = not_yaml + "the " + open->what;
    if (fixed) return diagnostics.error(*fixed, the + " is not closed");
    const base::Location where = lines.at(open->at);
    if (std::pair(where.line, where.column) <= std::pair(found.line, found.column)) {
      return diagnostics.error(where, the + " that opens here is not closed",
                               "what follows was read up to " + place_text(found));
    }
  }
  diagnostics.error(fixed.value_or(found), not_yaml + error.msg,
                    hint_for_line(line_of(text, found.line)));
}

bool is_xml(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return trimmed(text).starts_with('<') && !trimmed(text).starts_with("<<");
}

Value parse(std::string_view text, const std::string& file,
            const std::optional<base::Location>& fixed, const Limits& limits,
            base::Diagnostics& diagnostics) {
  if (!check_source_text(text, file, limits.file_bytes, diagnostics)) return {};
  if (!fixed && is_xml(text)) {
    diagnostics.error({file, 1, 1}, "this is XML, but the file has the name of a YAML file",
                      "OROCOS files end in .xml or .cpf");
    return {};
  }
  TreeBuilder builder(file, fixed, limits, diagnostics);
  try {
    std::istringstream stream{std::string(text)};
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
    return builder.take_root();
  } catch (const Abandoned&) {
  } catch (const YAML::Exception& error) {
    report_syntax(error, text, file, fixed, diagnostics);
  } catch (const std::exception& error) {
    diagnostics.error(fixed.value_or(base::Location{file, 0, 0}),
                      std::string("this is not YAML: ") + error.what());
  }
  return {};
}

}  // namespace

Value parse_yaml(std::string_view text, const std::string& file, const Limits& limits,
                 base::Diagnostics& diagnostics) {
  return parse(text, file, std::nullopt, limits, diagnostics);
}

Value parse_yaml_value(std::string_view text, const base::Location& where, const Limits& limits,
                       base::Diagnostics& diagnostics) {
  return parse(text, where.file, where, limits, diagnostics);
}

}  // namespace armature::document
