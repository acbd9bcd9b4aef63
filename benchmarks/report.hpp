// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace armature::benchmarks {

/// Prints a line for each entry, and writes all of them to a file.
class Report final : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;

  /// Everything ran, and what was compared computed the same.
  bool complete() const { return failures_ == 0; }
  /// The entries as a JSON array of {name, value, unit, reference, ratio, allocations}; false if
  /// the file cannot be written, which it says.
  bool write_json(const std::string& path) const;

 private:
  void report(const Run& run);

  std::vector<Run> entries_;
  int failures_ = 0;
};

}  // namespace armature::benchmarks
