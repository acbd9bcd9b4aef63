// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "armature/base/result.hpp"
#include "armature/exec/timeline.hpp"

namespace armature::record {

/// Writes a timeline to a file that Perfetto (https://ui.perfetto.dev) and chrome://tracing open: a
/// JSON array of trace events, in which a file that ends anywhere may be read up to there.
///
/// Times are those of the application's clock [us]. A cycle (`cat` "cycle") contains its steps
/// (`cat` "step"), which have the component's name. When the file cannot be written it is given up,
/// and what is not in it is counted.
/// @thread one at a time, and none that is real-time: it allocates and waits for the disk
class TimelineWriter {
 public:
  static base::Result<std::unique_ptr<TimelineWriter>> create(const std::string& path);

  TimelineWriter() = default;
  TimelineWriter(const TimelineWriter&) = delete;
  TimelineWriter& operator=(const TimelineWriter&) = delete;
  virtual ~TimelineWriter() = default;

  virtual void add(const exec::TimelineSlice& slice) = 0;
  /// Completes the file. The error says what is not in it, and why.
  virtual base::Result<void> close() = 0;
};

}  // namespace armature::record
