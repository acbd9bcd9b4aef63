// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "armature/record/recording.hpp"

namespace armature::general {

/// Where a recording goes: one file, or the console. What cannot be written is counted, and the
/// first reason is kept until somebody tells it.
class Sink {
 public:
  using Open = std::function<base::Result<std::unique_ptr<record::Writer>>(const std::string&)>;

  /// An error names the file.
  static base::Result<Sink> open(const std::string& path, const Open& open,
                                 const std::vector<record::Channel>& channels);

  void write(const record::Sample& sample);
  void flush();
  void close();

  const std::string& path() const { return path_; }
  std::uint64_t not_written() const { return not_written_; }
  /// Why, if that was not asked before; empty if there is nothing to tell.
  std::string take_complaint();

 private:
  Sink(std::string path, std::unique_ptr<record::Writer> writer)
      : path_(std::move(path)), writer_(std::move(writer)) {}

  /// @param lost  samples that were to be written
  void note(const base::Result<void>& done, std::uint64_t lost);

  std::string path_;
  std::unique_ptr<record::Writer> writer_;
  std::uint64_t not_written_ = 0;
  std::string complaint_;
  bool complained_of_sample_ = false;
  bool given_up_ = false;
};

}  // namespace armature::general
