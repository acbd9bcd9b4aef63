// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "armature/platform/output_file.hpp"
#include "armature/record/internal/channel_list.hpp"
#include "armature/record/recording.hpp"

namespace armature::record {

/// Writes a table that `numpy.genfromtxt(file, delimiter=",", names=True)` loads.
///
///     time_s,PID1_Out,Head_q_0,Head_q_1
///     # time_s: time_s [s]
///     # PID1_Out: PID1.Out [rad], what it says
///     # Head_q_0: Head.q[0] [rad]
///     ...
///     0.001000000,0.5,nan,nan
///
/// A row has all samples of one time, nan for channels that have none. Names are those that numpy
/// leaves as they are: letters, digits and underscores; the lines below say which value each
/// column is. Bools are 0 and 1, texts are left out. A vector has the columns of its shape, and a
/// sample of another size is refused.
/// Channels come before samples, samples in the order of time; of two samples of one channel at
/// one time the last stays, and `replaced` counts.
class CsvWriter final : public Writer {
 public:
  static base::Result<std::unique_ptr<CsvWriter>> create(const std::string& path);
  ~CsvWriter() override;

  base::Result<ChannelId> add_channel(Channel channel) override;
  base::Result<void> write(const Sample& sample) override;
  /// All rows but the last, to which samples may still come.
  base::Result<void> flush() override;
  base::Result<void> close() override;
  bool given_up() const override { return failure_.has_value(); }
  std::uint64_t unsaved() const override { return unsaved_; }

  std::uint64_t replaced() const { return replaced_; }

 private:
  /// The columns of a channel, and which of its leaves they are.
  struct Columns {
    std::size_t first = 0;
    std::vector<std::string> paths;
    bool in_row = false;
  };

  explicit CsvWriter(platform::OutputFile file);

  void add_column(const std::string& full_name, const std::string& unit, const std::string& doc);
  void begin_row(base::Time time);
  void end_row();
  base::Result<void> write_text();
  base::Result<void> check_usable() const;

  platform::OutputFile file_;
  internal::ChannelList channels_;
  std::vector<Columns> columns_;  // of each channel
  std::string names_;
  std::string comments_;
  std::unordered_set<std::string> taken_names_;

  std::optional<base::Time> time_;  // of the row to which samples still come
  std::vector<std::string> row_;
  std::string text_;  // not yet in the file
  std::uint64_t unsaved_ = 0;
  std::uint64_t replaced_ = 0;
  std::optional<base::Error> failure_;
  bool closed_ = false;
};

}  // namespace armature::record
