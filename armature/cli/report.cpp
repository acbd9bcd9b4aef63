// SPDX-License-Identifier: Apache-2.0
// What needs the library `report`.
#include "armature/report/report.hpp"

#include "armature/cli/loaded.hpp"
#include "armature/cli/report.hpp"
#include "armature/report/moment_kind.hpp"

namespace armature::cli {
namespace {

constexpr std::size_t kMostLines = 1000;

void keep(const rt::LogRecord& record, std::vector<rt::LogRecord>& kept, std::size_t& left_out) {
  if (kept.size() < kMostLines) {
    kept.push_back(record);
  } else {
    ++left_out;
  }
}

}  // namespace

void* function_of_report(const char* name, const Console& console) {
  base::Diagnostics diagnostics;
  void* const function = load_function("libarmature_report.so", name, "reports need", diagnostics);
  console.show(diagnostics);
  return function;
}

void note_for_summary(report::RunFacts& facts, const rt::LogRecord& record) {
  if (record.level >= rt::LogLevel::kWarning) {
    keep(record, facts.complaints, facts.complaints_left_out);
  }
  if (report::moment_told_by(record.message())) {
    keep(record, facts.moments, facts.moments_left_out);
  }
}

bool write_run_summary(const std::string& folder, const report::RunFacts& facts,
                       const exec::Application& application, const Console& console) {
  void* const function = function_of_report(report::kWriteRunSummary, console);
  if (function == nullptr) return false;
  std::string error;
  reinterpret_cast<report::WriteRunSummary>(function)(folder, facts, application, error);
  if (!error.empty()) console.say(rt::LogLevel::kError, error);
  return error.empty();
}

}  // namespace armature::cli
