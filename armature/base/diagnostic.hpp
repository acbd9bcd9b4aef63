// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace armature::base {

/// A place in a user's file; line and column count from 1, 0 means unknown.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;

  friend bool operator==(const Location&, const Location&) = default;
};

enum class Severity { kNote, kWarning, kError };

/// One finding about something a user wrote: where, what is wrong, what was expected, how to mend
/// it.
struct Diagnostic {
  Severity severity = Severity::kError;
  Location where;
  std::string message;  ///< names the object, what was found and what was expected
  std::string hint;     ///< how to mend it; may be empty
};

/// `file:line:column: error: message (hint)`; parts that are unknown are left out.
std::string to_text(const Diagnostic& diagnostic);

/// Collects every finding of one run, in the order in which they were found.
class Diagnostics {
 public:
  void error(Location where, std::string message, std::string hint = {});
  void warning(Location where, std::string message, std::string hint = {});
  void note(Location where, std::string message, std::string hint = {});
  void add(Diagnostic diagnostic);
  void append(const Diagnostics& others);

  bool ok() const { return errors_ == 0; }
  std::size_t error_count() const { return errors_; }
  bool empty() const { return all_.empty(); }
  const std::vector<Diagnostic>& all() const { return all_; }

  /// One line for each finding, ordered by file, line and column (stable).
  std::string to_text() const;

 private:
  std::vector<Diagnostic> all_;
  std::size_t errors_ = 0;
};

}  // namespace armature::base
