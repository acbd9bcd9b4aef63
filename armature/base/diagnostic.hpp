// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "armature/base/hint.hpp"

namespace armature::base {

/// A place in a user's file; line and column count from 1, 0 means unknown.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;

  friend bool operator==(const Location&, const Location&) = default;
};

/// How grave a finding is: only an error keeps what was asked from happening.
enum class Severity { kNote, kWarning, kError };

/// Findings that differ from another one at the same place in numbers only, as `'G2'` from `'G1'`.
struct Likewise {
  std::size_t count = 0;
  std::string first;  ///< the name in quotes that differs; empty if none does
  std::string last;
};

/// One finding about something a user wrote: where, what is wrong, what was expected, how to mend
/// it.
struct Diagnostic {
  Severity severity = Severity::kError;
  Location where;
  std::string message;                  ///< names the object, what was found and what was expected
  std::string hint;                     ///< how to mend it; may be empty
  Likewise likewise = {};               ///< for which others it stands
  std::size_t unshown = 0;              ///< how many more there are that are not kept
  std::string name = {};                ///< of a warning that may be accepted: `priority_inversion`
  std::optional<Replacement> fix = {};  ///< what the hint says, for tools
};

/// `file:line:column: warning: message [name] (hint)`; parts that are unknown are left out.
std::string to_text(const Diagnostic& diagnostic);

/// Collects the findings of one run, in the order in which they were found. What a range meets many
/// times at one place is kept once. Of one kind of finding the first `kMostOfAKind` are kept, of
/// all the first `kMost`, so that no file fills the memory or the screen; all of them are counted.
class Diagnostics {
 public:
  static constexpr std::size_t kMostOfAKind = 100;
  static constexpr std::size_t kMost = 1000;

  void error(Location where, std::string message, Hint hint = {});
  void warning(Location where, std::string message, Hint hint = {});
  /// A warning that a deployment may accept by its name, for what it means to do.
  void named_warning(std::string_view name, Location where, std::string message, Hint hint = {});
  void note(Location where, std::string message, Hint hint = {});
  void add(Diagnostic diagnostic);
  void append(const Diagnostics& others);
  /// Adds it if one at its place differs in numbers only; else it is left out.
  void add_likewise(const Diagnostic& diagnostic);

  /// Makes notes of the warnings of that name, which is not empty; errors stay what they are.
  /// @return whether there was one
  bool accept(std::string_view name);

  bool ok() const { return errors_ == 0; }
  std::size_t error_count() const { return errors_; }
  bool empty() const { return all_.empty(); }
  const std::vector<Diagnostic>& all() const { return all_; }

  /// One line for each finding, ordered by file, line and column (stable).
  std::string to_text() const;

 private:
  struct Kind {
    std::size_t kept = 0;
    std::size_t last = 0;  ///< index of the last one that is kept
  };

  void put(Diagnostic diagnostic);
  Diagnostic* find_like(const Diagnostic& diagnostic);

  std::vector<Diagnostic> all_;
  std::size_t errors_ = 0;
  std::unordered_map<std::string, std::size_t> by_place_;  ///< indices, by place and shape
  std::unordered_map<std::string, Kind> kinds_;
};

}  // namespace armature::base
