// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/listing.hpp"

#include <array>
#include <cstdio>
#include <optional>
#include <vector>

#include "armature/base/seconds.hpp"
#include "armature/browser/internal/spelled_view.hpp"
#include "armature/component/component.hpp"

namespace armature::browser::internal {
namespace {

using component::State;
using inspect::ComponentDescription;
using inspect::ComponentStatus;
using inspect::ThreadStatus;
using Rows = std::vector<std::vector<std::string>>;

Ink ink_of(const std::optional<State>& state) {
  if (state == State::kRunning) return Ink::kGood;
  const bool bad = state == State::kException || state == State::kRunTimeError;
  return bad ? Ink::kBad : Ink::kFaint;
}

std::string state_text(const Paper& paper, const ComponentStatus& component) {
  return inked(paper, ink_of(component.state), state_name(component));
}

std::string microseconds(double us) { return number_text("%.1f us", us); }

std::string counted(std::uint64_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string statistics_text(const ThreadStatus& thread) {
  std::string text =
      counted(thread.cycles, "cycle") + ", " + std::to_string(thread.skipped) + " skipped";
  if (thread.cycles == 0) return text;
  text += "; a cycle takes " + microseconds(thread.cycle_median_us) + " (median), " +
          microseconds(thread.cycle_high_us) + " (99.9 %), " + microseconds(thread.cycle_most_us) +
          " at most";
  if (thread.load_percent > 0.0) text += "; load " + number_text("%.2g %%", thread.load_percent);
  if (thread.latency_most_us > 0.0) {
    text += "; wakes " + microseconds(thread.latency_median_us) + " late (median), " +
            microseconds(thread.latency_most_us) + " at most";
  }
  if (thread.log_lines_dropped > 0) {
    text += "; " + counted(thread.log_lines_dropped, "log line") + " dropped";
  }
  return text;
}

/// `operations  sum, twice` of those that are chosen.
std::string names_line(const Paper& paper, const char* label, const auto& items, auto chosen) {
  std::string names;
  for (const auto& one : items) {
    if (chosen(one)) names += (names.empty() ? "" : ", ") + one.name;
  }
  if (names.empty()) return names;
  return "\n" + std::string(label) + "  " + wrapped(paper, names, 12, 12);
}

void add_ports(const Paper& paper, const char* kind, const auto& ports, Rows& rows) {
  for (const inspect::PortDescription& port : ports) {
    rows.push_back({kind, inked(paper, Ink::kName, port.name),
                    port.written ? with_unit(port.value, port.unit) : "not yet written"});
  }
}

Rows rows_of(const Paper& paper, const ComponentDescription& component) {
  Rows rows;
  for (const inspect::PropertyDescription& property : component.properties) {
    rows.push_back({property.persistent ? "property" : "attribute",
                    inked(paper, Ink::kName, property.name),
                    with_unit(property.value, property.unit)});
  }
  add_ports(paper, "input", component.inputs, rows);
  add_ports(paper, "output", component.outputs, rows);
  for (const inspect::MachineDescription& machine : component.machines) {
    rows.push_back({"machine", inked(paper, Ink::kName, machine.name),
                    machine.current.empty() ? "in no state" : "in " + machine.current});
  }
  return rows;
}

}  // namespace

std::string list_components(const Paper& paper, const std::vector<ComponentStatus>& components) {
  Rows rows{{inked(paper, Ink::kHeading, "component"), inked(paper, Ink::kHeading, "model"),
             inked(paper, Ink::kHeading, "state"), "thread"}};
  for (const ComponentStatus& component : components) {
    rows.push_back({inked(paper, Ink::kName, component.name), component.model,
                    state_text(paper, component), component.thread});
  }
  return table(paper, rows);
}

std::string list_machines(const Paper& paper, const std::vector<lua::MachineStatus>& machines) {
  Rows rows{{inked(paper, Ink::kHeading, "machine"), inked(paper, Ink::kHeading, "state")}};
  for (const lua::MachineStatus& machine : machines) {
    rows.push_back({inked(paper, Ink::kName, machine.name),
                    machine.state.empty() ? "not running" : machine.state});
  }
  return table(paper, rows);
}

std::string list_members(const Paper& paper, const ComponentDescription& component) {
  const std::string head = inked(paper, Ink::kHeading, component.name) + ": " + component.model +
                           ", " + state_text(paper, component) + ", in thread " + component.thread +
                           " (" + component.activity + ")";
  std::string text = wrapped(paper, head, 2, 0);
  if (!component.reason.empty()) text += "\n" + wrapped(paper, component.reason, 0, 0);
  if (!component.answered) return text + "\nits thread does not answer";
  const Rows rows = rows_of(paper, component);
  if (!rows.empty()) text += "\n" + table(paper, rows);
  text += names_line(paper, "operations", component.operations,
                     [](const auto& one) { return !one.command; });
  text += names_line(paper, "commands  ", component.operations,
                     [](const auto& one) { return one.command; });
  text += names_line(paper, "events    ", component.events, [](const auto&) { return true; });
  return text;
}

std::string list_threads(const Paper& paper, const std::vector<ThreadStatus>& threads) {
  std::string text;
  for (const ThreadStatus& thread : threads) {
    text += (text.empty() ? "" : "\n") + inked(paper, Ink::kName, thread.name) + ", " +
            thread.activity + ", " + counted(thread.components, "component") + "\n  " +
            wrapped(paper, statistics_text(thread), 2, 2);
  }
  return text;
}

std::string list_log(const Paper& paper, std::span<const exec::LogLine> lines) {
  std::string text;
  for (const exec::LogLine& line : lines) {
    std::array<char, 32> time{};
    std::snprintf(time.data(), time.size(), "%.6f ", base::to_seconds(line.time - base::Time{}));
    text += (text.empty() ? "" : "\n") + std::string(time.data()) +
            std::string(rt::name_of(line.level)) + " " + inked(paper, Ink::kName, line.component) +
            ": " + line.text;
  }
  return text.empty() ? "the log has no line yet" : text;
}

std::string list_faults(const Paper& paper, const inspect::Faults& faults) {
  Rows rows;
  for (const ComponentStatus& component : faults.components) {
    rows.push_back(
        {inked(paper, Ink::kName, component.name), state_text(paper, component), component.reason});
  }
  const std::string counts = counted(faults.faults, "fault") + " and " +
                             counted(faults.reactions, "declared reaction") + " since the start";
  return rows.empty() ? "all components run; " + counts : table(paper, rows) + "\n" + counts;
}

}  // namespace armature::browser::internal
