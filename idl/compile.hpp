// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "idl/load.hpp"

namespace armature::idl {

/// What the program `rcidl` is asked to do.
struct CompileOptions {
  std::string file;
  std::string output_folder;
  std::optional<std::string> name_space;  ///< none: each file's name is its namespace
  bool json = false;
  bool typescript = false;  ///< beside the C++
  std::string depends;      ///< a file that make and ninja read; empty: none
};

/// Reads a definition and writes what is generated from it.
/// @return what is wrong, for the user; empty if all is written. No file is touched otherwise
std::string compile(const CompileOptions& options, const ReadFile& read = read_file);

}  // namespace armature::idl
