// SPDX-License-Identifier: Apache-2.0
#include "armature/deploy/load.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "armature/deploy/internal/expand_document.hpp"
#include "armature/deploy/internal/overrides.hpp"
#include "armature/document/fields.hpp"
#include "armature/document/head.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/document/yaml.hpp"
#include "armature/orocos/deployer_file.hpp"
#include "armature/platform/file.hpp"

namespace armature::deploy {

using namespace document;
namespace {

/// The tree of a file and of all that it includes.
class Sources {
 public:
  Sources(const LoadOptions& options, base::Diagnostics& diagnostics)
      : options_(options), diagnostics_(diagnostics) {}

  Value load(const std::string& path, const base::Location& from) {
    const base::Result<std::string> text = read(path);
    if (text.ok()) {
      if (options_.seen) options_.seen(path, text.value());
      return parse(text.value(), path);
    }
    diagnostics_.error(from, text.error());
    return make_map({path, 0, 0});
  }

  Value parse(std::string_view text, const std::string& path) {
    seen_.push_back(path);
    open_.push_back(path);
    std::vector<Property> own = parse_file(text, path);
    Value all = make_map({path, 0, 0});
    if (const Property* include = find(own, "include")) {
      for (const Value* one : items_of(&include->value)) add_included(*one, path, all);
    }
    std::erase_if(own, [](const Property& entry) { return entry.name == "include"; });
    for (Property& section : own) merge_section(all, std::move(section), true);
    open_.pop_back();
    return all;
  }

 private:
  static bool is_orocos(const std::string& path) {
    const std::filesystem::path extension = std::filesystem::path(path).extension();
    return extension == ".xml" || extension == ".cpf";
  }

  base::Result<std::string> read(const std::string& path) const {
    if (options_.read) return options_.read(path);
    return platform::read_file(path, options_.limits.file_bytes);
  }

  std::vector<Property> parse_file(std::string_view text, const std::string& path) {
    Value tree = is_orocos(path) ? orocos::parse_xml(text, path, options_.limits, diagnostics_)
                                 : parse_yaml(text, path, options_.limits, diagnostics_);
    return sections_of(std::move(tree), diagnostics_);
  }

  /// Relative to the file that includes it. From an OROCOS file also, if there is none, relative to
  /// the working directory, as OROCOS does it.
  std::string path_of(const std::string& included, const std::string& includer) const {
    const std::filesystem::path folder = std::filesystem::path(includer).parent_path();
    std::string path = (folder / included).lexically_normal().string();
    if (!is_orocos(includer) || is_there(path)) return path;
    std::string here = std::filesystem::path(included).lexically_normal().string();
    return is_there(here) ? here : path;
  }

  bool is_there(const std::string& path) const {
    if (options_.read) return options_.read(path).ok();
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
  }

  void add_included(const Value& name, const std::string& includer, Value& all) {
    if (name.kind != Value::Kind::kText || name.text.empty()) {
      diagnostics_.error(name.where, "include takes the path of a file or a list of them");
      return;
    }
    const std::string path = path_of(name.text, includer);
    if (std::find(open_.begin(), open_.end(), path) != open_.end()) {
      diagnostics_.error(name.where, path_in_quotes(path) + " includes itself",
                         "remove it from include");
      return;
    }
    if (std::find(seen_.begin(), seen_.end(), path) != seen_.end()) return;
    if (seen_.size() >= static_cast<std::size_t>(options_.limits.includes)) {
      diagnostics_.error(name.where, "more than " + std::to_string(options_.limits.includes) +
                                         " files are included");
      return;
    }
    Value included = load(path, name.where);
    for (Property& section : included.entries) merge_section(all, std::move(section), false);
  }

  /// `own` sections replace what was included; two included files must not contradict each other.
  void merge_section(Value& all, Property section, bool own) {
    Property* before = find(all.entries, section.name);
    if (before == nullptr) {
      all.entries.push_back(std::move(section));
    } else if (section.name == "parameters" || section.name == "modes") {
      for (Property& one : section.value.entries) {
        replace(before->value.entries, std::move(one), own);
      }
    } else if (section.name == "grants") {
      merge_grants(before->value, std::move(section), own);
    } else if (section.name == "composites") {
      for (Property& one : section.value.entries) {
        replace(before->value.entries, std::move(one), false);
      }
    } else if (section.name == "libraries") {
      add_libraries(before->value, section.value);
    } else if (before->value.kind == Value::Kind::kMap) {
      for (Property& one : section.value.entries) before->value.entries.push_back(std::move(one));
    } else if (section.name == "connections" || section.name == "accept" ||
               section.name == "operator_inputs") {
      append(before->value, section.value);
    } else {
      replace(all.entries, std::move(section), own);
    }
  }

  /// The last word counts; an empty map takes back all that was granted before.
  void merge_grants(Value& before, Property section, bool own) {
    if (own && section.value.entries.empty()) before.entries.clear();
    for (Property& one : section.value.entries) replace(before.entries, std::move(one), own);
  }

  void replace(std::vector<Property>& entries, Property by, bool allowed) {
    Property* before = find(entries, by.name);
    if (before == nullptr) {
      entries.push_back(std::move(by));
      return;
    }
    const bool same = flow_text(before->value) == flow_text(by.value);
    if (!allowed && !same) {
      diagnostics_.error(by.where, in_quotes(by.name) + " is given twice",
                         "first at " + place_text(before->where));
    }
    *before = std::move(by);
  }

  static void append(Value& list, const Value& more) {
    Value all = make_list(list.where);
    for (const Value* item : items_of(&list)) all.items.push_back(*item);
    for (const Value* item : items_of(&more)) all.items.push_back(*item);
    list = std::move(all);
  }

  static void add_libraries(Value& list, const Value& more) {
    append(list, more);
    std::vector<Value> once;
    for (Value& item : list.items) {
      const bool known = std::any_of(once.begin(), once.end(), [&](const Value& earlier) {
        return earlier.text == item.text && item.kind == Value::Kind::kText;
      });
      if (!known) once.push_back(std::move(item));
    }
    list.items = std::move(once);
  }

  const LoadOptions& options_;
  base::Diagnostics& diagnostics_;
  std::vector<std::string> seen_;
  std::vector<std::string> open_;
};

Document build(const Value& tree, const std::string& path, const LoadOptions& options,
               base::Diagnostics& diagnostics) {
  return internal::build_document(tree, path,
                                  internal::parse_overrides(options.overrides, diagnostics),
                                  options.limits, diagnostics);
}

}  // namespace

Document load_document(const std::string& path, const LoadOptions& options,
                       base::Diagnostics& diagnostics) {
  Sources sources(options, diagnostics);
  const Value tree = sources.load(std::filesystem::path(path).lexically_normal().string(), {});
  return build(tree, path, options, diagnostics);
}

Document parse_document(std::string_view text, const std::string& name, const LoadOptions& options,
                        base::Diagnostics& diagnostics) {
  Sources sources(options, diagnostics);
  const Value tree = sources.parse(text, name);
  return build(tree, name, options, diagnostics);
}

}  // namespace armature::deploy
