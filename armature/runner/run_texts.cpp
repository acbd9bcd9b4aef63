// SPDX-License-Identifier: Apache-2.0
#include "armature/runner/run_texts.hpp"

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "armature/platform/clock.hpp"
#include "armature/platform/printer.hpp"

namespace armature::runner {

using rt::LogLevel;

namespace {

std::string microseconds(double ns) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f us", ns / 1000.0);
  return text;
}

}  // namespace

void tell_verdict(const exec::Application& application, const Console& console) {
  for (const exec::Verdict::Line& line : application.verdict().lines) {
    const bool granted = line.refusals.empty();
    console.say(granted ? LogLevel::kInfo : LogLevel::kWarning,
                line.subject + ": asked for " + line.requested + ", got " + line.granted);
    for (const std::string& refusal : line.refusals) {
      console.say(LogLevel::kWarning, "  refused: " + refusal);
    }
  }
}

void tell_grants(const std::vector<exec::Grant>& grants, const Console& console) {
  const auto tell = [&](const char* who, exec::Caller caller) {
    std::string all;
    for (const exec::Grant& grant : grants) {
      if (grant.caller != caller) continue;
      all += (all.empty() ? "" : ", ") + grant.component + "." + grant.operation;
    }
    if (!all.empty()) console.say(LogLevel::kInfo, std::string(who) + " may do " + all);
  };
  tell("scripts", exec::Caller::kScript);
  tell("other processes", exec::Caller::kRemote);
}

void tell_statistics(const exec::Application& application, bool all, const Console& console) {
  const double tick_ns = platform::tick_period_ns();
  for (const exec::ThreadStatistics& thread : application.thread_statistics()) {
    if (thread.cycles_run == 0) continue;
    const bool lossy = thread.cycles_skipped > 0 || thread.log_lines_dropped > 0;
    if (!all && !lossy) continue;
    std::string text = "thread " + thread.name + ": " + std::to_string(thread.cycles_run) +
                       " cycles run, " + std::to_string(thread.cycles_skipped) + " skipped";
    const auto in_ns = [&](std::uint64_t ticks) { return static_cast<double>(ticks) * tick_ns; };
    text += "; a cycle took " + microseconds(in_ns(thread.cycle_ticks.percentile(0.5))) +
            " (median), " + microseconds(in_ns(thread.cycle_ticks.most)) + " at most";
    if (thread.latency_ns.count > 0) {
      text += "; woke " + microseconds(static_cast<double>(thread.latency_ns.percentile(0.5))) +
              " late (median), " + microseconds(static_cast<double>(thread.latency_ns.most)) +
              " at most";
    }
    if (thread.log_lines_dropped > 0) {
      text += "; " + std::to_string(thread.log_lines_dropped) + " log lines dropped";
    }
    console.say(lossy ? LogLevel::kWarning : LogLevel::kInfo, text);
  }
}

void tell_lost_lines(const Console& console) {
  const std::uint64_t lost = platform::lost_lines();
  if (lost == 0) return;
  console.say(LogLevel::kWarning,
              std::to_string(lost) +
                  " lines of output were lost: their reader has ended, or reads too slowly");
}

void tell_casualties(const exec::Application& application, const Console& console) {
  for (const exec::ComponentEntry& entry : application.blueprint().components) {
    const component::Component& component = *entry.component;
    if (component.reason().empty()) continue;
    console.say(LogLevel::kWarning, component.name() + " (" +
                                        std::string(component::name_of(component.state())) +
                                        "): " + std::string(component.reason()));
  }
}

}  // namespace armature::runner
