// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "armature/base/time.hpp"

namespace armature::platform {

inline constexpr int kStandardInput = 0;
inline constexpr int kStandardOutput = 1;
inline constexpr int kStandardError = 2;

bool is_terminal(int descriptor);

/// Columns of the terminal at `descriptor`; `otherwise` if it is none, or does not know.
int terminal_width(int descriptor, int otherwise);

/// Waits until something can be read, the end included, at most `limit`; false if nothing came, or
/// a signal did.
bool wait_readable(int descriptor, base::Duration limit);

/// Reads what is there, at most `most` bytes; empty: nothing will come any more. Nothing if a
/// signal came in between.
std::optional<std::string> read_some(int descriptor, std::size_t most);

/// While it exists Ctrl-C sets a flag and nothing else, and Ctrl-Z nothing at all. A terminal that
/// goes away is an input that ends, not the end of the process. One at a time.
class InterruptSignal {
 public:
  InterruptSignal();
  InterruptSignal(const InterruptSignal&) = delete;
  InterruptSignal& operator=(const InterruptSignal&) = delete;
  ~InterruptSignal();

  bool received() const;
  /// The same, and forgets it.
  bool take();
};

/// While it exists the terminal hands over each key at once and does not show it.
class SingleKeys {
 public:
  explicit SingleKeys(int descriptor);
  SingleKeys(const SingleKeys&) = delete;
  SingleKeys& operator=(const SingleKeys&) = delete;
  ~SingleKeys();

 private:
  struct Settings;
  int descriptor_;
  std::unique_ptr<Settings> before_;  ///< none if it is no terminal
};

}  // namespace armature::platform
