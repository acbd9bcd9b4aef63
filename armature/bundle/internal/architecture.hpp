// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "armature/platform/elf/linked_file.hpp"

namespace armature::bundle::internal {

/// A kind of machine that a bundle may be for.
struct Architecture {
  std::string_view name;      ///< as Debian calls it
  int bits;                   ///< of an address
  unsigned machine;           ///< as ELF numbers it
  std::string_view folder;    ///< of its libraries, below /lib and /usr/lib
  std::string_view emulator;  ///< runs its programs here, if it is installed
};

inline constexpr std::array<Architecture, 3> kArchitectures = {
    {{"amd64", 64, 62, "x86_64-linux-gnu", "/usr/bin/qemu-x86_64"},
     {"arm64", 64, 183, "aarch64-linux-gnu", "/usr/bin/qemu-aarch64"},
     {"armhf", 32, 40, "arm-linux-gnueabihf", "/usr/bin/qemu-arm"}}};

/// nullptr if none has that name.
const Architecture* find_architecture(std::string_view name);

/// The one that a program or library is for; nullptr if it is none of them.
const Architecture* architecture_of(const platform::LinkedFile& file);

/// What a program or library is for, for messages: `arm64`, `machine 243`.
std::string machine_name(const platform::LinkedFile& file);

}  // namespace armature::bundle::internal
