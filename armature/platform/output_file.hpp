// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "armature/base/result.hpp"

namespace armature::platform {

/// A file that grows while it is written; `write_file` is for contents that are there at once.
/// What was written is in the file at once, though not yet safe from a loss of power.
/// @thread one at a time, and none that is real-time
class OutputFile {
 public:
  /// Makes the file, or empties the one that is there; devices and pipes are just opened. One that
  /// another OutputFile writes, of whatever process, is refused and left alone. Errors here and
  /// below name the file and the system's reason.
  static base::Result<OutputFile> create(const std::string& path);

  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;
  ~OutputFile();

  /// Appends all of `content`; after an error the file may end with a part of it.
  base::Result<void> write(std::string_view content);
  /// Bytes that were written, also of what ended with an error.
  std::uint64_t size() const { return size_; }
  /// Takes back what was written behind the first `size` bytes; devices and pipes keep it.
  void truncate(std::uint64_t size);

  /// Some file systems tell of a full disk only now. The second time does nothing.
  base::Result<void> close();

  const std::string& path() const { return path_; }

 private:
  OutputFile(std::string path, int fd);

  std::string path_;
  int fd_;
  std::uint64_t size_ = 0;
};

}  // namespace armature::platform
