// SPDX-License-Identifier: Apache-2.0
#include "armature/script/internal/listing.hpp"

#include <cstdio>
#include <vector>

#include "armature/base/seconds.hpp"
#include "armature/platform/clock.hpp"
#include "armature/script/internal/items.hpp"

namespace armature::script::internal {
namespace {

using component::Component;
using component::State;

Ink ink_of(State state) {
  switch (state) {
    case State::kRunning:
      return Ink::kGood;
    case State::kException:
    case State::kRunTimeError:
      return Ink::kBad;
    default:
      return Ink::kFaint;
  }
}

std::string state_text(const Paper& paper, const Component& component) {
  return inked(paper, ink_of(component.state()), component::name_of(component.state()));
}

std::string number_text(const char* format, double number) {
  char text[40];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

std::string microseconds(double ns) { return number_text("%.1f us", ns / 1000.0); }

std::string counted(std::uint64_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string period_text(const exec::Activity& activity) {
  if (activity.kind != exec::Activity::Kind::kPeriodic) {
    return std::string(exec::name_of(activity.kind));
  }
  return "every " + number_text("%g ms", 1000.0 * base::to_seconds(activity.period));
}

std::string statistics_text(const exec::ThreadStatistics& thread, const exec::Activity& activity) {
  std::string text = counted(thread.cycles_run, "cycle") + ", " +
                     std::to_string(thread.cycles_skipped) + " skipped";
  if (thread.cycles_run == 0) return text;
  const double tick_ns = platform::tick_period_ns();
  const auto cycle_ns = [&](double share) {
    return static_cast<double>(thread.cycle_ticks.percentile(share)) * tick_ns;
  };
  text += "; a cycle takes " + microseconds(cycle_ns(0.5)) + " (median), " +
          microseconds(cycle_ns(0.999)) + " (99.9 %), " +
          microseconds(static_cast<double>(thread.cycle_ticks.most) * tick_ns) + " at most";
  if (activity.period > base::Duration::zero()) {
    const double mean = thread.cycle_ticks.mean() * tick_ns;
    text += "; load " +
            number_text("%.2g %%", 100.0 * mean / static_cast<double>(activity.period.count()));
  }
  if (thread.latency_ns.most > 0) {
    text += "; wakes " + microseconds(static_cast<double>(thread.latency_ns.percentile(0.5))) +
            " late (median), " + microseconds(static_cast<double>(thread.latency_ns.most)) +
            " at most";
  }
  if (thread.log_lines_dropped > 0) {
    text += "; " + counted(thread.log_lines_dropped, "log line") + " dropped";
  }
  return text;
}

struct Row {
  Member member;
  const char* kind;
};

std::vector<Row> rows_of(const Component& component) {
  std::vector<Row> rows;
  for (const auto* one : component.interface().properties) {
    rows.push_back({{&component, one}, one->persistent() ? "property" : "attribute"});
  }
  for (const auto* one : component.interface().inputs) {
    rows.push_back({{&component, nullptr, one}, "input"});
  }
  for (const auto* one : component.interface().outputs) {
    rows.push_back({{&component, nullptr, nullptr, one}, "output"});
  }
  return rows;
}

std::string names_line(const Paper& paper, const char* label, const auto& items, auto chosen) {
  std::string names;
  for (const auto* one : items) {
    if (chosen(*one)) names += (names.empty() ? "" : ", ") + std::string(one->name());
  }
  if (names.empty()) return names;
  return "\n" + std::string(label) + "  " + wrapped(paper, names, 12, 12);
}

}  // namespace

std::string list_components(const Paper& paper, exec::Application& application) {
  std::vector<std::vector<std::string>> rows{{inked(paper, Ink::kHeading, "component"),
                                              inked(paper, Ink::kHeading, "model"),
                                              inked(paper, Ink::kHeading, "state"), "thread"}};
  for (const exec::ComponentEntry& entry : application.blueprint().components) {
    const Component& component = *entry.component;
    rows.push_back({inked(paper, Ink::kName, component.name()), entry.model,
                    state_text(paper, component), thread_of(application, component).name});
  }
  return table(paper, rows);
}

std::string list_machines(const Paper& paper, const Machines& machines) {
  std::vector<std::vector<std::string>> rows{
      {inked(paper, Ink::kHeading, "machine"), inked(paper, Ink::kHeading, "state")}};
  for (const auto& machine : machines.all()) {
    const std::string state(machine->state().empty() ? "not running" : machine->state());
    rows.push_back({inked(paper, Ink::kName, machine->name()), state});
  }
  return table(paper, rows);
}

std::string list_members(const Paper& paper, exec::Application& application, Component& component) {
  const exec::ComponentEntry& entry = entry_of(application, component);
  const exec::ThreadPlan& thread = thread_of(application, component);
  const std::string head = inked(paper, Ink::kHeading, component.name()) + ": " + entry.model +
                           ", " + state_text(paper, component) + ", in thread " + thread.name +
                           " (" + period_text(thread.activity) + ")";
  std::string text = wrapped(paper, head, 2, 0);
  if (component.state() != State::kRunning) {
    const std::string reason = reason_of(application, component);
    if (!reason.empty()) text += "\n" + wrapped(paper, reason, 0, 0);
  }
  const std::vector<Row> rows = rows_of(component);
  std::vector<Member> members;
  for (const Row& row : rows) members.push_back(row.member);
  const auto readings = read_members(application, members);
  if (!readings) return text + "\nits thread does not answer";
  std::vector<std::vector<std::string>> cells;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Member& member = members[i];
    const std::string_view name =
        member.property != nullptr ? member.property->name() : member.port()->name();
    const Reading& reading = (*readings)[i];
    cells.push_back({rows[i].kind, inked(paper, Ink::kName, name),
                     reading.written
                         ? value_text(member.type(), reading.whole.data(), member.unit())
                         : "not yet written"});
  }
  for (const auto* machine : component.interface().machines) {
    const std::string_view path = machine->path();
    cells.push_back({"machine", inked(paper, Ink::kName, machine->name()),
                     path.empty() ? "in no state" : "in " + std::string(path)});
  }
  if (!cells.empty()) text += "\n" + table(paper, cells);
  const component::Interface& interface = component.interface();
  text += names_line(paper, "operations", interface.operations,
                     [](const auto& one) { return !one.is_command(); });
  text += names_line(paper, "commands  ", interface.operations,
                     [](const auto& one) { return one.is_command(); });
  text += names_line(paper, "events    ", interface.events, [](const auto&) { return true; });
  return text;
}

std::string list_threads(const Paper& paper, const exec::Application& application) {
  std::string text;
  const auto statistics = application.thread_statistics();
  for (std::size_t i = 0; i < statistics.size(); ++i) {
    const exec::ThreadPlan& plan = application.plan().threads[i];
    if (plan.members.empty()) continue;
    text += (text.empty() ? "" : "\n") + inked(paper, Ink::kName, plan.name) + ", " +
            period_text(plan.activity) + ", " + counted(plan.members.size(), "component") + "\n  " +
            wrapped(paper, statistics_text(statistics[i], plan.activity), 2, 2);
  }
  return text;
}

std::string list_faults(const Paper& paper, exec::Application& application) {
  std::vector<std::vector<std::string>> rows;
  for (const exec::ComponentEntry& entry : application.blueprint().components) {
    Component& component = *entry.component;
    if (component.state() == State::kRunning) continue;
    rows.push_back({inked(paper, Ink::kName, component.name()), state_text(paper, component),
                    reason_of(application, component)});
  }
  const std::string counts = counted(application.faults(), "fault") + " and " +
                             counted(application.reactions(), "declared reaction") +
                             " since the start";
  return rows.empty() ? "all components run; " + counts : table(paper, rows) + "\n" + counts;
}

}  // namespace armature::script::internal
