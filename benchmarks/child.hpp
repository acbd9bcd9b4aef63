// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

namespace armature::benchmarks {

/// A program that runs beside this one, without output.
class Child {
 public:
  /// @param command  the program, found as by a shell, and its arguments
  explicit Child(const std::vector<std::string>& command);
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child();

  /// Waits for its end; throws if it was not a success.
  void wait();
  /// Bytes of physical memory that it occupies; throws if it has ended.
  double resident_bytes() const;

 private:
  std::string name_;
  pid_t process_ = 0;
};

}  // namespace armature::benchmarks
