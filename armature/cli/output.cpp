// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/output.hpp"

#include <set>

#include "armature/cli/arguments.hpp"
#include "armature/platform/file.hpp"

namespace armature::cli {

using rt::LogLevel;

int print(const base::Result<std::string>& text, const Console& console) {
  if (!text) {
    console.say(LogLevel::kError, text.error());
    return kFailed;
  }
  console.print(text.value());
  return kDone;
}

int write(const std::string& path, const std::string& content, const Console& console) {
  if (const auto written = platform::write_file(path, content); !written) {
    console.say(LogLevel::kError, written.error());
    return kFailed;
  }
  console.say(LogLevel::kInfo, "wrote " + path);
  return kDone;
}

bool is_no_source(const std::string& path, const document::Document& document,
                  const Console& console) {
  std::set<std::string> sources{document.file};
  for (const auto& each : document.components) sources.insert(each.where.file);
  for (const auto& each : document.connections) sources.insert(each.where.file);
  for (const auto& each : document.libraries) sources.insert(each.where.file);
  for (const std::string& source : sources) {
    if (!platform::is_same_file(path, source)) continue;
    console.say(LogLevel::kError, "'" + path + "' is the file that is read ('" + source +
                                      "'): name another file to write");
    return false;
  }
  return true;
}

}  // namespace armature::cli
