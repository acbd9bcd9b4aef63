// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/orocos/deployer_file.hpp"
#include "armature/orocos/internal/xml_component.hpp"
#include "armature/orocos/internal/xml_tree.hpp"

namespace armature::orocos {

using namespace document;
namespace {

void mark_literal(Value& value) {
  value.literal = true;
  for (Value& item : value.items) mark_literal(item);
  for (Property& entry : value.entries) mark_literal(entry.value);
}

/// A later struct for a component that is already there: its entries replace or join those.
void merge(XmlElement& earlier, const XmlElement& later) {
  for (const XmlElement& child : later.children) {
    const auto same = std::find_if(
        earlier.children.begin(), earlier.children.end(),
        [&](const XmlElement& one) { return one.name == child.name && !one.name.empty(); });
    if (same == earlier.children.end()) {
      earlier.children.push_back(child);
    } else if (same->is_simple() || child.is_simple()) {
      *same = child;
    } else {
      if (child.name == "Activity") same->type = child.type;
      merge(*same, child);
    }
  }
}

class DocumentReader {
 public:
  DocumentReader(const Limits& limits, base::Diagnostics& diagnostics)
      : limits_(limits), diagnostics_(diagnostics) {}

  Value read(XmlElement root) {
    tree_ = make_map(root.where);
    for (XmlElement& child : root.children) read_child(child);
    if (!libraries_.items.empty()) add_entry(tree_, "libraries", std::move(libraries_));
    if (!includes_.items.empty()) add_entry(tree_, "include", std::move(includes_));
    add_components(root.where);
    Value connections = connections_of(policies_, ports_, limits_, diagnostics_);
    if (!connections.items.empty()) add_entry(tree_, "connections", std::move(connections));
    read_extras(root);
    for (Property& entry : tree_.entries) mark_literal(entry.value);
    return std::move(tree_);
  }

 private:
  void read_child(XmlElement& child) {
    if (child.is_simple()) {
      read_simple(child);
    } else if (child.type == "ConnPolicy") {
      policies_.push_back(&child);
    } else if (child.name.empty()) {
      diagnostics_.error(child.where, "a component's struct needs a name", "add name=\"...\"");
    } else {
      read_component(child);
    }
  }

  void read_simple(const XmlElement& child) {
    if (child.name == "Import" || child.name == "LoadLibrary") {
      libraries_.kind = Value::Kind::kList;
      libraries_.items.push_back(make_text(child.text, child.where));
    } else if (child.name == "Include") {
      includes_.kind = Value::Kind::kList;
      includes_.items.push_back(make_text(child.text, child.where));
    } else if (child.name == "Path") {
      // Without it another library of the same name would be found.
      diagnostics_.error(child.where,
                         "Path " + in_quotes(child.text) +
                             " is not supported: folders of libraries are given at start",
                         "remove it, and write armature run -L " + in_quotes(child.text) +
                             ", or import the libraries by their own paths");
    } else {
      diagnostics_.error(child.where, "unknown simple " + in_quotes(child.name),
                         base::suggestion(child.name, {"Import", "Include"}));
    }
  }

  void read_component(XmlElement& child) {
    const auto same = indices_.find(child.name);
    const bool has_interface = std::ranges::any_of(
        child.extras, [](const auto& extra) { return extra.first == "interface"; });
    const bool change = child.type == "PropertyBag" || (child.type.empty() && !has_interface);
    if (change && same != indices_.end()) return merge(components_[same->second], child);
    if (change) {
      diagnostics_.error(child.where,
                         "component " + in_quotes(child.name) + ": type must be a component model",
                         "type PropertyBag only changes a component that is listed before");
    }
    const bool override = std::any_of(child.extras.begin(), child.extras.end(),
                                      [](const auto& extra) { return extra.first == "override"; });
    if (same != indices_.end() && !override) {
      diagnostics_.error(child.where, "component " + in_quotes(child.name) + " is given twice",
                         "first at " + place_text(components_[same->second].where) +
                             "; type PropertyBag changes a component that is listed before");
      return;
    }
    if (components_.size() >= limits_.expanded_entries) {
      if (!too_many_) {
        diagnostics_.error(
            child.where,
            "the file has more than " + std::to_string(limits_.expanded_entries) + " components");
      }
      too_many_ = true;
      return;
    }
    indices_.emplace(child.name, components_.size());
    components_.push_back(std::move(child));
  }

  void add_components(const base::Location& where) {
    if (components_.empty()) return;
    seat_slaves(components_, diagnostics_);
    Value map = make_map(where);
    for (const XmlElement& component : components_) {
      Value body = component_of(component, ports_, limits_, diagnostics_);
      map.entries.push_back({component.name, std::move(body), {}, component.where});
    }
    add_entry(tree_, "components", std::move(map));
  }

  /// What OROCOS has no word for, as attributes of the root.
  void read_extras(const XmlElement& root) {
    constexpr std::array<std::string_view, 15> kKnown = {
        "application", "on_fault",    "black_box",    "parameters", "composed",
        "grants",      "before_stop", "hold_at_stop", "network",    "modes",
        "mode",        "threads",     "priorities",   "accept",     "operator_inputs"};
    XmlElement known;
    known.where = root.where;
    known.extras = root.extras;
    std::erase_if(known.extras, [&](const auto& extra) {
      const bool good = std::find(kKnown.begin(), kKnown.end(), extra.first) != kKnown.end();
      if (!good) {
        diagnostics_.error(root.where, "unknown attribute " + in_quotes("armature:" + extra.first),
                           base::suggestion(extra.first, {kKnown.begin(), kKnown.end()}));
      }
      return !good;
    });
    add_extras(known, tree_, limits_, diagnostics_);
  }

  const Limits& limits_;
  base::Diagnostics& diagnostics_;
  Value tree_;
  Value libraries_;
  Value includes_;
  std::vector<XmlElement> components_;
  bool too_many_ = false;
  std::unordered_map<std::string, std::size_t> indices_;
  std::vector<const XmlElement*> policies_;
  std::vector<XmlPort> ports_;
};

}  // namespace

Value parse_xml(std::string_view text, const std::string& file, const Limits& limits,
                base::Diagnostics& diagnostics) {
  std::optional<XmlElement> root = parse_orocos_xml(text, file, limits, diagnostics);
  return root ? DocumentReader(limits, diagnostics).read(std::move(*root)) : Value{};
}

}  // namespace armature::orocos
