// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/exec/act.hpp"
#include "armature/platform/thread.hpp"

namespace armature::replay {

/// Its name in the folder of a run.
inline constexpr const char* kActsFile = "acts.jsonl";

/// Whether who tells of an act waits until it is in the file, where it outlives the process.
enum class ActsWait : std::uint8_t {
  kForTheFile,  ///< a disk that hangs holds up nobody for more than a second, once
  kNot,         ///< in real time
};

/// Writes the acts of a run, a line of JSON each. A thread writes, so that nobody waits for a disk
/// that hangs.
class ActsWriter {
 public:
  /// Makes the file, or empties the one that is there.
  static base::Result<std::unique_ptr<ActsWriter>> create(const std::string& folder,
                                                          ActsWait wait = ActsWait::kForTheFile);
  ActsWriter(const ActsWriter&) = delete;
  ActsWriter& operator=(const ActsWriter&) = delete;
  /// Gives what is left a second to be written.
  ~ActsWriter();

  /// Also what became of an act.
  /// @thread one at a time
  void add(const exec::Act& act);
  /// Completes the file; the error says what is missing in it.
  base::Result<void> close();

 private:
  struct State;
  explicit ActsWriter(std::shared_ptr<State> state);

  std::shared_ptr<State> state_;
  std::unique_ptr<platform::Thread> thread_;
};

/// An act as it was read; who knows the types of its values reads them.
struct RecordedAct {
  exec::Act act;                         ///< without values
  std::vector<std::string> values;       ///< as record::to_json has them
  std::optional<std::string> refused{};  ///< why, if it was
};

/// As `load_acts`, of the text of the file.
/// @param path  for errors
base::Result<std::vector<RecordedAct>> parse_acts(std::string_view text, const std::string& path);

/// Reads what ActsWriter wrote. A last line that is cut off is left out.
base::Result<std::vector<RecordedAct>> load_acts(const std::string& folder);

}  // namespace armature::replay
