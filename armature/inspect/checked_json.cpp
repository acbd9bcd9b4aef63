// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/checked_json.hpp"

#include <cctype>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "armature/base/severity_name.hpp"
#include "armature/inspect/connections.hpp"
#include "armature/inspect/describe.hpp"
#include "armature/inspect/internal/description_json.hpp"

namespace armature::inspect {
namespace {

using base::Diagnostic;
using base::Location;
using internal::Json;

void add_place(const Location& where, Json& to) {
  if (where.file.empty()) return;
  to["file"] = where.file;
  if (where.line > 0) to["line"] = where.line;
  if (where.line > 0 && where.column > 0) to["column"] = where.column;
}

bool is_of_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Where `word` stands alone in `line` from `begin` on; npos if it does not.
std::size_t find_word(std::string_view line, std::string_view word, std::size_t begin) {
  for (std::size_t at = line.find(word, begin); at != std::string_view::npos;
       at = line.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool begins = at == 0 || !is_of_name(line[at - 1]);
    const bool ends = end == line.size() || !is_of_name(line[end]);
    if (begins && ends) return at;
  }
  return std::string_view::npos;
}

std::string_view line_of(std::string_view text, int number) {
  for (int line = 1; line < number; ++line) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  return text.substr(0, text.find('\n'));
}

/// Writes findings; reads each file once.
class Findings {
 public:
  explicit Findings(const CheckedForm& form) : form_(form) {}

  Json json_of(const Diagnostic& found) {
    Json json = {{"severity", base::name_of(found.severity)}, {"message", found.message}};
    if (!found.hint.empty()) json["hint"] = found.hint;
    if (!found.name.empty()) json["name"] = found.name;
    add_place(found.where, json);
    if (found.likewise.count > 0) {
      json["likewise"] = {{"count", found.likewise.count},
                          {"first", found.likewise.first},
                          {"last", found.likewise.last}};
    }
    if (found.unshown > 0) json["not_shown"] = found.unshown;
    if (found.fix) add_fix(*found.fix, found.where, json);
    return json;
  }

 private:
  /// Left out where the file has not what is to be replaced: it came from a range or a parameter.
  void add_fix(const base::Replacement& fix, const Location& where, Json& to) {
    const std::string* const text = text_of(where.file);
    if (text == nullptr || where.line < 1 || where.column < 1 || fix.found.empty()) return;
    const std::string_view line = line_of(*text, where.line);
    const std::size_t at = find_word(line, fix.found, static_cast<std::size_t>(where.column) - 1);
    if (at == std::string_view::npos) return;
    to["fix"] = {{"file", where.file},
                 {"line", where.line},
                 {"column", at + 1},
                 {"found", fix.found},
                 {"by", fix.by}};
  }

  const std::string* text_of(const std::string& file) {
    const auto [place, fresh] = texts_.try_emplace(file);
    if (fresh) {
      if (auto text = form_.read(file)) place->second = std::move(text).value();
    }
    return place->second ? &*place->second : nullptr;
  }

  const CheckedForm& form_;
  std::unordered_map<std::string, std::optional<std::string>> texts_;
};

Json findings(const base::Diagnostics& diagnostics, const CheckedForm& form) {
  Findings writer(form);
  Json json = Json::array();
  for (const Diagnostic& one : diagnostics.all()) json.push_back(writer.json_of(one));
  return json;
}

Json json_of(const exec::Activity& activity) {
  Json json = {{"kind", exec::name_of(activity.kind)}};
  if (!activity.owns_thread()) return json;
  if (activity.kind == exec::Activity::Kind::kPeriodic) {
    json["period_ns"] = activity.period.count();
    json["overrun"] = exec::name_of(activity.overrun);
  }
  json["scheduler"] = exec::name_of(activity.scheduler);
  json["priority"] = activity.priority;
  if (!activity.cpus.empty()) json["cpus"] = activity.cpus;
  if (activity.budget > base::Duration::zero()) json["budget_ns"] = activity.budget.count();
  return json;
}

Json components(const Checked& checked, const CheckedForm& form) {
  const bool planned = checked.diagnostics.ok();
  Json all = Json::array();
  for (exec::Index i = 0; i < checked.blueprint.components.size(); ++i) {
    const exec::ComponentEntry& entry = checked.blueprint.components[i];
    Json json = {{"name", entry.component->name()}, {"model", entry.model}};
    add_place(entry.where, json);
    if (planned) json["thread"] = checked.plan.threads[checked.plan.thread_of[i]].name;
    json["activity"] = json_of(entry.activity);
    if (form.members) {
      internal::add_members(describe(*entry.component, entry.model), "value", json);
    }
    all.push_back(std::move(json));
  }
  return all;
}

/// Without a plan: what the file says, right or wrong.
Json written_connections(const Checked& checked) {
  Json all = Json::array();
  for (const exec::ConnectionEntry& entry : checked.blueprint.connections) {
    Json json = {{"kind", "data"},
                 {"from", entry.from_component + "." + entry.from_port},
                 {"to", entry.to_component + "." + entry.to_port}};
    add_place(entry.where, json);
    all.push_back(std::move(json));
  }
  return all;
}

/// Of the plan's connections those of data come first, in its order: they have places.
Json planned_connections(const exec::Plan& plan) {
  const std::vector<Connection> connections =
      connections_of(plan, [](const std::string&) { return true; });
  Json all = Json::array();
  for (const Connection& one : connections) {
    Json json = internal::connection_json(one);
    if (all.size() < plan.connections.size()) {
      add_place(plan.connections[all.size()].entry->where, json);
    }
    all.push_back(std::move(json));
  }
  return all;
}

Json threads(const Checked& checked) {
  Json all = Json::array();
  for (const exec::ThreadPlan& thread : checked.plan.threads) {
    Json order = Json::array();
    for (const exec::Index member : thread.members) {
      order.push_back(checked.blueprint.components[member].component->name());
    }
    all.push_back({{"name", thread.name},
                   {"activity", json_of(thread.activity)},
                   {"order", std::move(order)}});
  }
  return all;
}

/// The first is the one to start in, unless another is said to be.
Json modes(const exec::Blueprint& blueprint) {
  Json all = Json::array();
  const std::string& initial = blueprint.initial_mode.component;
  for (const exec::ModeEntry& mode : blueprint.modes) {
    const bool first = initial.empty() ? all.empty() : mode.name == initial;
    all.push_back({{"name", mode.name}, {"initial", first}});
  }
  return all;
}

}  // namespace

std::string checked_as_json(const Checked& checked, const CheckedForm& form) {
  const bool ok = checked.diagnostics.ok();
  const Json json = {
      {"format", internal::kCheckedFormat},
      {"file", checked.file},
      {"application", checked.blueprint.name},
      {"ok", ok},
      {"errors", checked.diagnostics.error_count()},
      {"diagnostics", findings(checked.diagnostics, form)},
      {"components", components(checked, form)},
      {"connections", ok ? planned_connections(checked.plan) : written_connections(checked)},
      {"threads", ok ? threads(checked) : Json::array()},
      {"modes", modes(checked.blueprint)}};
  return internal::text_of(json, form.indent);
}

std::string diagnostics_as_json(
    const base::Diagnostics& diagnostics,
    const std::function<base::Result<std::string>(const std::string& file)>& read) {
  CheckedForm form;
  form.read = read;
  return internal::text_of(findings(diagnostics, form), -1);
}

}  // namespace armature::inspect
