// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/base/result.hpp"

namespace armature::platform {

/// What the system's loader reads of a program or a shared library, of whatever machine.
struct LinkedFile {
  int bits = 0;                      ///< of an address: 32 or 64
  unsigned machine = 0;              ///< as ELF numbers them: 62 is x86-64, 183 is AArch64
  std::vector<std::string> needed;   ///< what it was linked with, such as `libm.so.6`
  std::vector<std::string> folders;  ///< where it looks for that, as written: `$ORIGIN/../lib`
};

/// Loads nothing. The error names the file and what it is instead.
base::Result<LinkedFile> read_linked_file(const std::string& path);

}  // namespace armature::platform
