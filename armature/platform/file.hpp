// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "armature/base/result.hpp"

namespace armature::platform {

/// Nothing if `path` is a file, or a link to one; otherwise what it is instead, such as "is a named
/// pipe, not a file", or the system's reason. Never waits.
base::Result<void> expect_file(const std::string& path);

/// The whole content of a file; the error names the file and the system's reason. Refuses what is
/// no file (a directory, a named pipe, a device: to read those could wait for ever) and files above
/// `limit_bytes`.
base::Result<std::string> read_file(const std::string& path, std::size_t limit_bytes = 64u << 20);

/// Whether `write_file` could write there as things are: for what is written at the end of
/// something long. Writes nothing.
base::Result<void> expect_writable(const std::string& path);

/// Replaces a file as a whole: after a failure or a crash it holds either the old or the new
/// content. Follows links, keeps the permissions; a device or a pipe is written to, not replaced.
base::Result<void> write_file(const std::string& path, std::string_view content);

/// True if both names lead to the same file, by whatever links; false if one of them is not there.
bool is_same_file(const std::string& one, const std::string& other);

/// A folder that one process at a time writes to.
/// @thread one at a time
class FolderLock {
 public:
  /// Locks `folder`, which has to be there. The lock ends with this object, or its process.
  /// @return the error names the folder and the process that has it, or the system's reason
  static base::Result<FolderLock> take(const std::string& folder);

  FolderLock() = default;
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;
  ~FolderLock();

 private:
  FolderLock(int fd, std::string path);
  int fd_ = -1;
  std::string path_;
};

}  // namespace armature::platform
