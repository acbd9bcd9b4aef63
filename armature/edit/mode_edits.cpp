// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/document/fields.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/edit/internal/targets.hpp"

namespace armature::edit::internal {
namespace {

using document::Document;
using document::make_text;
using document::Mode;
using document::Value;

const Mode* find_mode(const Document& document, const std::string& name) {
  const auto found = std::find_if(document.modes.begin(), document.modes.end(),
                                  [&](const Mode& mode) { return mode.name == name; });
  return found == document.modes.end() ? nullptr : &*found;
}

void refuse_unknown(const std::string& name, Workshop& shop) {
  std::vector<std::string> known;
  for (const Mode& mode : shop.document().modes) known.push_back(mode.name);
  shop.refuse("unknown mode '" + name + "'", base::suggestion(name, known));
}

/// A mode in the file that has the last word on it.
struct WrittenMode {
  const SourceText* file = nullptr;
  const Node* key = nullptr;
  const Node* value = nullptr;
};

std::optional<WrittenMode> find_written(const std::string& name, Workshop& shop) {
  const auto& files = shop.map().files();
  for (auto file = files.rbegin(); file != files.rend(); ++file) {
    const Node* modes = find_value((*file)->root(), "modes");
    const Node* key = find_key(modes, name);
    if (key == nullptr) continue;
    if (!shop.require(**file, *key, "mode '" + name + "'")) return std::nullopt;
    return WrittenMode{file->get(), key, find_value(modes, name)};
  }
  refuse_unknown(name, shop);
  return std::nullopt;
}

/// The file that says in which mode the application starts, and the mode's name there.
std::pair<const SourceText*, const Node*> find_initial(const SourceMap& map) {
  const auto& files = map.files();
  for (auto file = files.rbegin(); file != files.rend(); ++file) {
    if (const Node* mode = find_value((*file)->root(), "mode")) return {file->get(), mode};
  }
  return {nullptr, nullptr};
}

bool is_one_of(const Targets& targets, const std::string& name) {
  return std::any_of(targets.names.begin(), targets.names.end(), [&](const std::string& one) {
    return name == one || name.starts_with(one + ".");
  });
}

bool is_in_a_mode(const Document& document, const std::string& component) {
  return std::any_of(document.modes.begin(), document.modes.end(), [&](const Mode& mode) {
    return std::any_of(mode.components.begin(), mode.components.end(),
                       [&](const auto& one) { return one.name == component; });
  });
}

/// What no mode names any more runs in all of them.
void warn_of_free_ones(const State& before, const Document& expected,
                       base::Diagnostics& diagnostics) {
  for (const auto& component : expected.components) {
    const std::string& name = component.name;
    if (!is_in_a_mode(before.document, name) || is_in_a_mode(expected, name)) continue;
    diagnostics.warning({before.file, 0, 0}, "'" + name + "' is in no mode then, and runs in all",
                        "remove it, or give it another mode");
  }
}

/// The mode has the components that it had, and behind them those of the targets.
Expectation expect_added(const State& before, const Targets& targets, const AddToMode& add) {
  return [&before, targets, add](const State& after, base::Diagnostics&) {
    Document expected = before.document;
    const Mode* found = find_mode(after.document, add.mode);
    if (found == nullptr) return expected;
    if (find_mode(expected, add.mode) == nullptr) expected.modes.push_back({add.mode, {}, {}});
    for (Mode& mode : expected.modes) {
      if (mode.name != add.mode) continue;
      for (std::size_t i = mode.components.size(); i < found->components.size(); ++i) {
        const auto& one = found->components[i];
        if (is_one_of(targets, one.name)) mode.components.push_back(one);
      }
    }
    return expected;
  };
}

void add_to_written(const WrittenMode& mode, const std::string& component, Workshop& shop) {
  Layout& layout = shop.layout(*mode.file);
  if (mode.value->kind == Node::Kind::kList)
    return layout.add_item(*mode.value, make_text(component));
  if (mode.value->kind == Node::Kind::kAlias) {
    shop.refuse(mode.file->place_of(*mode.value), "the mode is an alias",
                "write it out there first");
    return;
  }
  Value both = document::make_list();
  both.items = {make_text(mode.value->text), make_text(component)};
  layout.replace(*mode.value, both);
}

/// The items of a mode that stand for targets alone; an error if one stands for others, too.
std::vector<const Node*> items_to_remove(const WrittenMode& written, const Mode& mode,
                                         const Targets& targets, Workshop& shop) {
  std::vector<const Node*> items;
  for (const Node* item : items_of(written.value)) {
    const base::Location where = written.file->place_of(*item);
    std::size_t all = 0;
    std::size_t meant = 0;
    for (const auto& one : mode.components) {
      if (one.where != where) continue;
      ++all;
      meant += is_one_of(targets, one.name) ? 1 : 0;
    }
    if (meant == all && all > 0) items.push_back(item);
    if (meant == all || meant == 0) continue;
    shop.refuse(where, "'" + item->text + "' stands there for others, too",
                "name '" + item->text + "'");
  }
  return items;
}

void remove_components(std::vector<Mode>& modes, const RemoveFromMode& remove,
                       const Targets& targets) {
  for (Mode& mode : modes) {
    if (mode.name != remove.mode) continue;
    std::erase_if(mode.components, [&](const auto& one) { return is_one_of(targets, one.name); });
  }
}

}  // namespace

void draft(const AddToMode& add, Workshop& shop) {
  const std::optional<Targets> targets = find_targets(add.component, shop);
  if (!targets) return;
  if (!document::is_name(add.mode)) {
    return shop.refuse("mode '" + add.mode + "' is not a valid name", "letters, digits, _ and -");
  }
  const Mode* mode = find_mode(shop.document(), add.mode);
  if (mode != nullptr) {
    for (const auto& one : mode->components) {
      if (is_one_of(*targets, one.name)) return shop.refuse("'" + one.name + "' is in it already");
    }
    if (const auto written = find_written(add.mode, shop)) {
      add_to_written(*written, add.component, shop);
    }
  } else {
    Value list = document::make_list();
    list.items.push_back(make_text(add.component));
    shop.add_to_section(shop.file_for_new(), "modes", add.mode, list, 0);
  }
  shop.expect(expect_added(shop.before(), *targets, add));
}

void draft(const RemoveFromMode& remove, Workshop& shop) {
  const std::optional<Targets> targets = find_targets(remove.component, shop);
  if (!targets) return;
  const std::optional<WrittenMode> written = find_written(remove.mode, shop);
  const Mode* mode = find_mode(shop.document(), remove.mode);
  if (!written || mode == nullptr) return;
  const auto items = items_to_remove(*written, *mode, *targets, shop);
  if (!shop.ok()) return;
  if (items.empty()) return shop.refuse("mode '" + remove.mode + "' does not name it");
  if (items.size() == items_of(written->value).size()) {
    return shop.refuse("the mode would have no component", "remove the mode");
  }
  Layout& layout = shop.layout(*written->file);
  for (const Node* item : items) layout.remove(*item);
  shop.expect([&before = shop.before(), targets = *targets, remove](
                  const State&, base::Diagnostics& diagnostics) {
    Document expected = before.document;
    remove_components(expected.modes, remove, targets);
    warn_of_free_ones(before, expected, diagnostics);
    return expected;
  });
}

void draft(const RemoveMode& remove, Workshop& shop) {
  const auto written = find_written(remove.name, shop);
  if (!written) return;
  shop.layout(*written->file).remove(*written->key);
  const auto [file, initial] = find_initial(shop.map());
  const bool starts = initial != nullptr && initial->text == remove.name;
  if (starts) {
    if (!shop.require(*file, *initial, "the mode in which it starts")) return;
    shop.layout(*file).remove(*initial);
    shop.diagnostics().note(file->place_of(*initial),
                            "the application starts in its first mode then");
  }
  shop.expect(
      [&before = shop.before(), remove, starts](const State&, base::Diagnostics& diagnostics) {
        Document expected = before.document;
        std::erase_if(expected.modes, [&](const Mode& mode) { return mode.name == remove.name; });
        if (starts) expected.mode = {};
        if (!expected.modes.empty()) warn_of_free_ones(before, expected, diagnostics);
        return expected;
      });
}

void draft(const RenameMode& rename, Workshop& shop) {
  const auto written = find_written(rename.from, shop);
  if (!written) return;
  if (!document::is_name(rename.to)) {
    return shop.refuse("'" + rename.to + "' is not a valid name", "letters, digits, _ and -");
  }
  if (find_mode(shop.document(), rename.to) != nullptr) {
    return shop.refuse("mode '" + rename.to + "' is there already", "choose another name");
  }
  shop.layout(*written->file).replace(*written->key, make_text(rename.to));
  const auto [file, initial] = find_initial(shop.map());
  if (initial != nullptr && initial->text == rename.from) {
    if (!shop.require(*file, *initial, "the mode in which it starts")) return;
    shop.layout(*file).replace(*initial, make_text(rename.to));
  }
  shop.expect([&before = shop.before(), rename](const State&, base::Diagnostics&) {
    Document expected = before.document;
    for (Mode& mode : expected.modes) {
      if (mode.name == rename.from) mode.name = rename.to;
    }
    if (expected.mode.name == rename.from) expected.mode.name = rename.to;
    return expected;
  });
}

void draft(const StartInMode& start, Workshop& shop) {
  if (find_mode(shop.document(), start.name) == nullptr) return refuse_unknown(start.name, shop);
  const auto [file, initial] = find_initial(shop.map());
  if (initial != nullptr && initial->text == start.name) {
    return shop.refuse(file->place_of(*initial), "it starts in '" + start.name + "' already");
  }
  const bool there = initial != nullptr;
  if (!there || (shop.overrides() && !shop.may_change(*file))) {
    const SourceText& own = there ? shop.map().main() : shop.file_for_new();
    shop.add_section(own, "mode", make_text(start.name), 0);
  } else if (shop.require(*file, *initial, "the mode in which it starts")) {
    shop.layout(*file).replace(*initial, make_text(start.name));
  }
  shop.expect([&before = shop.before(), start](const State&, base::Diagnostics&) {
    Document expected = before.document;
    expected.mode.name = start.name;
    return expected;
  });
}

}  // namespace armature::edit::internal
