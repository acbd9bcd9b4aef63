// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "armature/component/library.hpp"
#include "armature/runner/assembly.hpp"

namespace armature::runner {

/// A component library that a program is linked with.
struct LinkedLibrary {
  std::string name;
  component::LibraryEntry entry;
};

/// A program that runs one application, as `armature generate` writes it.
struct Program {
  std::string name;
  std::vector<LinkedLibrary> libraries;
  void (*assemble)(Assembly& to);  ///< puts the application together
  /// Of the application that was checked when the program was generated: it runs no other.
  std::uint64_t fingerprint = 0;
};

/// Runs it as `armature run` would run its deployment, without tools: the same real-time set-up,
/// start, stop by signals and exit codes (docs/generate.md). Refuses to run if what is put together
/// is not what was checked.
/// @return the exit code, see exit_code.hpp
/// @thread the main thread
int run_program(const Program& program, int argc, char** argv);

}  // namespace armature::runner
