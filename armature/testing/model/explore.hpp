// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace armature::testing::model {

class Execution;

/// What the function that `explore` examines uses to describe itself.
class Program {
 public:
  explicit Program(Execution& execution) : execution_(execution) {}

  /// Adds a thread; it starts with `join`. At most four.
  void thread(std::string name, std::function<void()> body);
  /// Runs all threads to their ends; what follows sees everything they wrote.
  void join();
  /// Ends the exploration with a failure, unless `condition` holds.
  void expect(bool condition, const std::string& what);

 private:
  Execution& execution_;
};

struct Result {
  std::uint64_t executions = 0;
  std::string failure;  ///< what went wrong and the steps that lead there; empty if nothing did

  bool ok() const { return failure.empty(); }
};

/// Runs `body` again and again, until it has seen every outcome that C++'s memory model allows
/// for its atomic operations, or a failure: an expectation that does not hold, a data race, a
/// thread that sleeps for ever, an endless loop, an exception.
///
/// `body` makes the shared objects, adds threads, joins them and says what it expects. Threads
/// may share only `Atomic` and `Data` (atomics.hpp), and do nothing that depends on time, chance or
/// addresses. Not explored: fences, and outcomes in which a load sees a store that depends on it or
/// comes later in its own thread (load buffering). Operations in memory_order_seq_cst are taken a
/// little weaker than they are.
Result explore(const std::function<void(Program&)>& body);

}  // namespace armature::testing::model
