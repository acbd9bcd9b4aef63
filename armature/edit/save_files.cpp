// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/save_files.hpp"

#include <filesystem>
#include <string>

#include "armature/platform/file.hpp"

namespace armature::edit {
namespace {

base::Result<void> expect_unchanged(const FileChange& file) {
  if (file.before.empty() && !std::filesystem::exists(file.file)) {
    return platform::expect_writable(file.file);
  }
  const auto now = platform::read_file(file.file);
  if (!now) return base::Error{now.error()};
  if (now.value() == file.before) return platform::expect_writable(file.file);
  return base::Error{"'" + file.file +
                     "' has changed while it was edited; nothing is written: edit it again"};
}

}  // namespace

base::Result<void> save_files(const std::vector<FileChange>& files) {
  for (const FileChange& file : files) {
    if (auto unchanged = expect_unchanged(file); !unchanged) return unchanged;
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto written = platform::write_file(files[i].file, files[i].after);
    if (written) continue;
    std::string error = written.error();
    while (i-- > 0) {
      const auto restored = platform::write_file(files[i].file, files[i].before);
      if (!restored) error += "; '" + files[i].file + "' keeps the edit: " + restored.error();
    }
    return base::Error{error};
  }
  return {};
}

}  // namespace armature::edit
