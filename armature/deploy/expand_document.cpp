// SPDX-License-Identifier: Apache-2.0
#include "armature/deploy/internal/expand_document.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/deploy/internal/changes.hpp"
#include "armature/deploy/internal/expand_names.hpp"
#include "armature/deploy/internal/once_per_place.hpp"
#include "armature/document/fields.hpp"
#include "armature/document/head.hpp"
#include "armature/document/reader.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/exec/modes.hpp"

namespace armature::deploy::internal {

using namespace document;
namespace {

constexpr const char* kModesName = exec::kModesName;

/// One text in which components stand beside each other: the application's or a composite's.
struct Level {
  const Value* components;
  const Value* connections;
  std::string instance;  ///< full name of the composite, empty for the application
  Scope scope;
  ChangesByName changes = {};
};

class DocumentBuilder {
 public:
  DocumentBuilder(const Value& tree, std::vector<Override> overrides, const Limits& limits,
                  base::Diagnostics& diagnostics)
      : tree_(tree),
        overrides_(std::move(overrides)),
        expander_(limits),
        depth_limit_(limits.depth),
        diagnostics_(diagnostics),
        reports_(diagnostics) {}

  Document build(const std::string& file) {
    document_.file = file;
    const Value* parameters = section(tree_, "parameters");
    const std::vector<Property> declared =
        parameters ? parameters->entries : std::vector<Property>{};
    document_.parameters = expander_.resolve_parameters(
        declared, take_overrides(overrides_, "", names_of(declared)), "the document", diagnostics_);
    Level level{section(tree_, "components"),
                section(tree_, "connections"),
                "",
                {document_.parameters, "the document", std::nullopt}};
    if (const Value* composites = section(tree_, "composites")) check_composites(*composites);
    read_head(expander_.expand(head_of(tree_), level.scope, diagnostics_), document_, diagnostics_);
    add_level(level);
    if (expander_.exhausted()) return nothing_of(std::move(document_));
    removals_.apply(document_, scopes_, diagnostics_);
    resolve_names(document_, scopes_, names_, diagnostics_);
    check_connections(document_, diagnostics_);
    rebase_paths(document_);
    for (const Override& setting : overrides_) {
      if (setting.used) continue;
      if (setting.names_parameter()) {
        refuse_parameter(document_, setting, names_of(declared), diagnostics_);
      } else {
        internal::apply_override(document_, setting, diagnostics_);
      }
    }
    return std::move(document_);
  }

 private:
  static const Value* section(const Value& map, std::string_view key) {
    const Property* entry = find(map.entries, key);
    return entry == nullptr ? nullptr : &entry->value;
  }

  /// Of a document that is too large nothing more is looked at.
  static Document nothing_of(Document document) {
    document.components.clear();
    document.connections.clear();
    document.named_connections.clear();
    document.composites.clear();
    document.modes.clear();
    return document;
  }

  void check_composites(const Value& composites) {
    for (const Property& composite : composites.entries) {
      const ValueReader reader("composite '" + composite.name + "'", diagnostics_);
      Fields fields(composite.value, reader, Empty::kAllowed);
      for (const char* key : {"parameters", "components", "exports"}) {
        require_kind(fields.take(key), Value::Kind::kMap, key, reader);
      }
      require_kind(fields.take("connections"), Value::Kind::kList, "connections", reader);
      fields.refuse_others();
      composites_[composite.name] = &composite;
    }
  }

  void add_level(Level& level) {
    RangesByPattern ranges;
    if (level.components != nullptr) {
      for (const Property& entry : level.components->entries) {
        if (is_change(entry.value)) for_each_instance(entry, level, nullptr, true);
      }
      for (const Property& entry : level.components->entries) {
        if (!is_change(entry.value)) for_each_instance(entry, level, &ranges, false);
      }
      refuse_unused_changes(level);
    }
    if (level.connections == nullptr) return;
    for (const Value& connection : level.connections->items) {
      add_connections(connection, level, ranges);
    }
  }

  /// Repeats a component's entry over the range in its name.
  void for_each_instance(const Property& entry, Level& level, RangesByPattern* ranges,
                         bool overrides) {
    base::Diagnostics found;
    std::string name = entry.name;
    std::optional<RangeInText> range;
    if (!entry.value.literal) {
      name = expander_.replace_parameters(name, level.scope, entry.where, found);
      const base::Location where = Expander::origin_of(entry.name, level.scope, entry.where);
      if (found.ok()) range = find_range(name, where, found);
    }
    if (found.ok() && !overrides) {
      const int count = range ? range->range.last - range->range.first + 1 : 1;
      expander_.spend_entries(static_cast<std::size_t>(count), in_quotes(name), entry.where, found);
    }
    reports_.add(found);
    if (!found.ok() || expander_.exhausted()) return;
    if (!range) {
      add_instance(name, entry, level, level.scope, overrides);
      return;
    }
    std::string pattern = name;
    pattern.replace(range->begin, range->end - range->begin, "{i}");
    if (ranges != nullptr) (*ranges)[pattern].push_back(range->range);
    Scope scope = level.scope;
    for (int number = range->range.first; number <= range->range.last; ++number) {
      if (expander_.exhausted()) return;
      scope.number = number;
      std::string one = name;
      one.replace(range->begin, range->end - range->begin, std::to_string(number));
      add_instance(replace_number(one, number, entry.where, found), entry, level, scope, overrides);
    }
  }

  void add_instance(const std::string& name, const Property& entry, Level& level,
                    const Scope& scope, bool overrides) {
    base::Diagnostics found;
    Value body = expander_.expand(entry.value, scope, found);
    const std::size_t causes = found.all().size();
    const std::string full = level.instance.empty() ? name : level.instance + "." + name;
    if (overrides) {
      check_change(name, body, found);
      level.changes[name].push_back({std::move(body), entry.where, false});
    } else if (!is_dotted_name(name)) {
      found.error(entry.where, "component " + in_quotes(name) + " is not a valid name",
                  "a name has letters, digits, '_' and '-' and begins with a letter");
    } else if (full == kModesName) {
      found.error(
          entry.where,
          "the name " + in_quotes(full) + " is reserved for the component that switches modes",
          "give the component another name");
    } else if (take_removal(level.changes, name)) {
      removals_.add_component(level.instance, name);
    } else if (!names_.add(full, level.instance, entry.where)) {
      found.error(entry.where, "component " + in_quotes(full) + " is given twice",
                  "first at " + place_text(names_.place_of(full)) +
                      "; write override: true to change that one, remove: true to leave it out");
    } else {
      apply_changes(level, name, body, found);
      add_named(full, entry.where, body, level, found);
    }
    reports_.add(found, causes);
  }

  static void apply_changes(Level& level, const std::string& name, Value& body,
                            base::Diagnostics& found) {
    const auto changes = level.changes.find(name);
    if (changes == level.changes.end()) return;
    for (const Change& change : changes->second) apply_change(body, change.body, found);
    level.changes.erase(changes);
  }

  void refuse_unused_changes(const Level& level) {
    base::Diagnostics found;
    for (const auto& [name, changes] : level.changes) {
      if (changes.front().exported) continue;  // its export is refused
      found.error(changes.front().where,
                  "component " + in_quotes(name) + " is marked " +
                      (is_removal(changes.front().body) ? "remove" : "override") +
                      ": true but does not exist");
    }
    reports_.add(found);
  }

  void add_named(const std::string& full, const base::Location& where, const Value& body,
                 const Level& level, base::Diagnostics& found) {
    const Property* model = find(body.entries, "model");
    const auto composite =
        model == nullptr ? composites_.end() : composites_.find(model->value.text);
    if (composite != composites_.end()) {
      add_composite(full, where, body, *composite->second, found);
      return;
    }
    document_.components.push_back(read_component(full, where, body, document_.priorities, found));
    scopes_.components.push_back(level.instance);
  }

  void add_composite(const std::string& full, const base::Location& where, const Value& body,
                     const Property& definition, base::Diagnostics& found) {
    if (!enter(definition.name, where, found)) return;
    const ValueReader reader("component '" + full + "'", found);
    Fields fields(body, reader);
    fields.take("model");
    const Value* properties = fields.take("properties");
    fields.refuse_others();
    const Value* parameters = section(definition.value, "parameters");
    const Value* exports = section(definition.value, "exports");

    Composite composite{full, definition.name, {}, {}, where};
    if (exports != nullptr) {
      const std::string owner = "composite '" + definition.name + "'";
      const Scope scope{{}, owner, std::nullopt};
      composite.exports =
          read_exports(expander_.expand(*exports, scope, found), ValueReader(owner, found));
    }
    const std::vector<Property> declared =
        parameters ? parameters->entries : std::vector<Property>{};
    const std::vector<Property> given = given_to(composite, declared, properties, reader);
    const std::string owner = "composite '" + definition.name + "'";
    composite.parameters = expander_.resolve_parameters(declared, given, owner, found);
    Level inside{section(definition.value, "components"),
                 section(definition.value, "connections"),
                 full,
                 {composite.parameters, owner, std::nullopt}};
    push_exported_properties(composite, given, inside);
    document_.composites.push_back(std::move(composite));
    add_level(inside);
    entered_.pop_back();
  }

  bool enter(const std::string& model, const base::Location& where, base::Diagnostics& found) {
    const bool circular = std::find(entered_.begin(), entered_.end(), model) != entered_.end();
    const bool deep = entered_.size() >= static_cast<std::size_t>(depth_limit_);
    if (circular || deep) {
      found.error(
          where,
          "composite " + in_quotes(model) + (circular ? " contains itself" : " is nested too deep"),
          circular ? "remove it from the composites inside it"
                   : "use fewer composites inside each other");
      return false;
    }
    entered_.push_back(model);
    return true;
  }

  /// The values that an instance and the command line give: of parameters and exported properties.
  std::vector<Property> given_to(const Composite& composite, const std::vector<Property>& declared,
                                 const Value* properties, const ValueReader& reader) {
    std::vector<std::string> known = names_of(declared);
    for (const Export& one : composite.exports) {
      if (one.kind == ExportKind::kProperty) known.push_back(one.name);
    }
    std::vector<Property> given = take_overrides(overrides_, composite.name + ".", known);
    if (properties == nullptr) return given;
    for (const Property& property : properties->entries) {
      if (std::find(known.begin(), known.end(), property.name) == known.end()) {
        reader.error(property.where,
                     "composite " + in_quotes(composite.model) + " has no parameter " +
                         in_quotes(property.name),
                     base::suggestion(property.name, known));
      } else if (find(given, property.name) == nullptr) {
        given.push_back(property);
      }
    }
    return given;
  }

  /// A value for an exported property overrides that of the part.
  static void push_exported_properties(const Composite& composite,
                                       const std::vector<Property>& given, Level& level) {
    for (const Export& one : composite.exports) {
      const Property* value = find(given, one.name);
      if (one.kind != ExportKind::kProperty || value == nullptr) continue;
      Value properties = make_map(value->where);
      properties.entries.push_back({one.member, value->value, {}, value->where});
      Value change = make_map(value->where);
      change.entries.push_back({"properties", std::move(properties), {}, value->where});
      level.changes[one.component].push_back({std::move(change), value->where, true});
    }
  }

  void add_connections(const Value& written, const Level& level, const RangesByPattern& ranges) {
    base::Diagnostics found;
    std::optional<Value> connection = connection_map(written, found);
    if (connection) {
      for (const char* key : {"from", "to"}) {
        Property* end = find(connection->entries, key);
        if (end == nullptr || end->value.literal) continue;
        end->value.text =
            expander_.replace_parameters(end->value.text, level.scope, end->value.where, found);
      }
    }
    std::optional<Repetition> repetition;
    if (connection && found.ok()) repetition = find_repetition(*connection, ranges, found);
    if (repetition) {
      const int count = repetition->range.last - repetition->range.first + 1;
      expander_.spend_entries(static_cast<std::size_t>(count), "this connection", written.where,
                              found);
    }
    reports_.add(found);
    if (!repetition) return;
    const Value pattern = without_range(*connection);
    Scope scope = level.scope;
    for (int i = repetition->range.first; i <= repetition->range.last; ++i) {
      if (expander_.exhausted()) return;
      if (repetition->repeated) scope.number = i;
      base::Diagnostics of_this;
      const Value expanded = expander_.expand(pattern, scope, of_this);
      const std::size_t causes = of_this.all().size();
      add_connection(expanded, level, of_this);
      reports_.add(of_this, causes);
    }
  }

  void add_connection(Value map, const Level& level, base::Diagnostics& found) {
    if (is_removal(map)) return remove_connection(std::move(map), level, found);
    auto connection = read_connection(map, found);
    if (!connection) return;
    if (auto* directed = std::get_if<Connection>(&*connection)) {
      add_name(*directed, level, found);
      document_.connections.push_back(std::move(*directed));
      scopes_.connections.push_back(level.instance);
    } else {
      document_.named_connections.push_back(std::get<NamedConnection>(std::move(*connection)));
      scopes_.named_connections.push_back(level.instance);
    }
  }

  /// What gives a command is known by its name, as the components beside it are.
  void add_name(const Connection& connection, const Level& level, base::Diagnostics& found) {
    if (connection.name.empty()) return;
    const std::string full = full_name(level.instance, connection.name);
    if (names_.add(full, level.instance, connection.where)) return;
    found.error(connection.where, in_quotes(full) + " is already the name of a component",
                "give this one another: name: Follow");
  }

  /// By its two ends, or by its name.
  void remove_connection(Value map, const Level& level, base::Diagnostics& found) {
    std::erase_if(map.entries, [](const Property& entry) { return entry.name == "remove"; });
    if (const Property* name = find(map.entries, "name");
        name != nullptr && map.entries.size() == 1) {
      removals_.add_named(level.instance, {name->value.text, map.where});
      return;
    }
    auto connection = read_connection(map, found);
    if (!connection) return;
    if (auto* directed = std::get_if<Connection>(&*connection)) {
      removals_.add_connection(level.instance, std::move(*directed));
    } else {
      found.error(map.where, "a connection with remove: true takes only its name, or from and to");
    }
  }

  const Value& tree_;
  std::vector<Override> overrides_;
  Expander expander_;
  int depth_limit_;
  base::Diagnostics& diagnostics_;
  OncePerPlace reports_;
  Document document_;
  NameTable names_;
  Scopes scopes_;
  Removals removals_;
  std::unordered_map<std::string, const Property*> composites_;
  std::vector<std::string> entered_;
};

}  // namespace

Document build_document(const Value& tree, const std::string& file, std::vector<Override> overrides,
                        const Limits& limits, base::Diagnostics& diagnostics) {
  return DocumentBuilder(tree, std::move(overrides), limits, diagnostics).build(file);
}

}  // namespace armature::deploy::internal
