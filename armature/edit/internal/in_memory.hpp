// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "armature/edit/edit.hpp"

/// For tests: edits of files in memory.
namespace armature::edit::internal {

using Files = std::map<std::string, std::string>;

inline Outcome outcome_of(const Files& files, const std::vector<Edit>& edits,
                          const std::string& file = "robot.yaml") {
  return apply_edits(file, edits, [&](const std::string& path) -> base::Result<std::string> {
    const auto found = files.find(path);
    if (found == files.end()) return base::Error{"file '" + path + "' does not exist"};
    return found->second;
  });
}

inline Outcome outcome_of(const std::string& text, const std::vector<Edit>& edits) {
  return outcome_of(Files{{"robot.yaml", text}}, edits);
}

/// What becomes of the only file that the edit changes; taking it back gives the file again.
inline std::string edited(const Files& files, const Edit& edit,
                          const std::string& file = "robot.yaml") {
  const Outcome outcome = outcome_of(files, {edit});
  EXPECT_TRUE(outcome.ok()) << outcome.diagnostics.to_text();
  if (outcome.files.size() != 1)
    return "so many files changed: " + std::to_string(outcome.files.size());
  const FileChange& change = outcome.files.front();
  EXPECT_EQ(change.file, file);
  EXPECT_EQ(replaced(change.before, change.replacements), change.after);
  EXPECT_EQ(replaced(change.after, change.inverse), files.at(file));
  return change.after;
}

inline std::string edited(const std::string& text, Edit edit) {
  return edited(Files{{"robot.yaml", text}}, edit);
}

inline std::string edited(const std::string& text, Change change) {
  return edited(text, Edit{std::move(change)});
}

/// Why the edit is not made.
inline std::string refusal(const Files& files, const Edit& edit) {
  const Outcome outcome = outcome_of(files, {edit});
  EXPECT_FALSE(outcome.ok());
  EXPECT_TRUE(outcome.files.empty());
  return outcome.diagnostics.to_text();
}

inline std::string refusal(const Files& files, Change change) {
  return refusal(files, Edit{std::move(change)});
}

inline std::string refusal(const std::string& text, Change change) {
  return refusal(Files{{"robot.yaml", text}}, Edit{std::move(change)});
}

}  // namespace armature::edit::internal
