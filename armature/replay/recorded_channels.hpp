// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/record/mcap_reader.hpp"

namespace armature::replay {

/// A channel with all of its samples, in the order of their times.
struct ChannelSamples {
  const record::McapRecording* recording = nullptr;
  std::vector<const record::RecordedSample*> samples{};

  /// Whether no sample is missing: they are counted from 1.
  bool is_complete() const;
  /// When it was written, each time once.
  std::vector<base::Time> times() const;
};

/// What the recorders of a run wrote. Of a channel that several have, one without gaps counts.
class RecordedChannels {
 public:
  /// @param names  of the recorders' files in the folder
  RecordedChannels(const std::string& folder, const std::set<std::string>& names,
                   base::Diagnostics& diagnostics);

  /// nullptr if there is none.
  const ChannelSamples* find(const std::string& name) const;
  /// Names of those in the file of that name.
  std::vector<std::string> in_file(const std::string& name) const;
  /// The first time in them; the begin of time if there is none.
  base::Time begin() const { return begin_; }
  /// The last.
  base::Time end() const { return end_; }

 private:
  void add(const record::McapRecording& recording);

  std::vector<std::unique_ptr<record::McapRecording>> recordings_;  ///< which the others point to
  std::map<std::string, ChannelSamples> channels_;
  base::Time begin_{};
  base::Time end_ = base::Time::min();
};

}  // namespace armature::replay
