// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include <sys/types.h>

namespace armature::benchmarks {

/// Copies of this process that do the same work, each for itself, and end with the scope. This
/// process has one thread when it makes them.
class Crew {
 public:
  /// @param work  what each of them does, until it is ended
  Crew(std::size_t size, const std::function<void()>& work);
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;
  ~Crew();

 private:
  std::vector<pid_t> members_;
};

}  // namespace armature::benchmarks
