// SPDX-License-Identifier: Apache-2.0
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
  const auto written = report::write_run_summary(folder, facts, application);
  if (!written) console.say(rt::LogLevel::kError, written.error());
  return written.ok();
}

}  // namespace armature::cli
