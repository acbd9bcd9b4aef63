// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "armature/platform/internal/elf.hpp"

namespace armature::platform {

/// `Pid::on_update()` for the `_ZN3Pid9on_updateEv` of the linker; other names stay as they are.
std::string demangled(const char* name);

/// The name of a function without allocators, and with `...` for long arguments.
std::string shortened(std::string_view name);

/// Names the functions of the process, static and hidden ones too, from the symbol tables of the
/// files that it was loaded from. Takes none of the loader's locks, so any thread may ask.
class Symbols {
 public:
  /// Of the process as it is now.
  Symbols();

  /// A function by name and by place.
  struct Function {
    std::string name;   ///< as people write it; empty if the file does not say
    std::string place;  ///< file and offset: `libmotion.so+0x1a2b`, as addr2line takes it
  };
  /// The function that `return_address` returns into.
  Function at(const void* return_address);

 private:
  struct Mapping {
    std::uintptr_t begin;
    std::uintptr_t end;
    std::uintptr_t offset;  ///< of `begin` in the file
    std::string file;
  };
  /// What a file says: where its parts go, and its functions in the order of their addresses.
  class File {
   public:
    explicit File(const std::string& path);
    std::uintptr_t address_of(std::uintptr_t offset) const;
    const char* function_at(std::uintptr_t address) const;

   private:
    struct Symbol {
      std::uintptr_t begin;
      std::uintptr_t size;
      const char* name;
    };
    Elf elf_;
    std::vector<Symbol> functions_;
  };

  const File& file(const std::string& path);

  std::vector<Mapping> mappings_;
  std::map<std::string, File> files_;
};

}  // namespace armature::platform
