// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/elf/linked_file.hpp"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include <elf.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/platform/elf/shared_object.hpp"

namespace armature::platform {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// What a linker for boards with 32 bits writes, as far as the loader needs it.
struct ArmLibrary {
  Elf32_Ehdr header{};
  Elf32_Shdr sections[2]{};
  Elf32_Dyn dynamic[2]{};
  char texts[32]{};
};

ArmLibrary arm_library() {
  ArmLibrary library;
  std::memcpy(library.header.e_ident, ELFMAG, SELFMAG);
  library.header.e_ident[EI_CLASS] = ELFCLASS32;
  library.header.e_machine = EM_ARM;
  library.header.e_shoff = offsetof(ArmLibrary, sections);
  library.header.e_shnum = 2;
  library.sections[0].sh_type = SHT_DYNAMIC;
  library.sections[0].sh_link = 1;
  library.sections[0].sh_offset = offsetof(ArmLibrary, dynamic);
  library.sections[0].sh_size = sizeof library.dynamic;
  library.sections[1].sh_offset = offsetof(ArmLibrary, texts);
  library.sections[1].sh_size = sizeof library.texts;
  library.dynamic[0] = {DT_NEEDED, {1}};
  library.dynamic[1] = {DT_RUNPATH, {11}};
  std::memcpy(library.texts, "\0libm.so.6\0$ORIGIN:/opt", 24);
  return library;
}

base::Result<LinkedFile> read_back(const void* bytes, std::size_t size) {
  const std::string path = ::testing::TempDir() + "linked_file_test.so";
  std::ofstream(path, std::ios::binary)
      .write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  base::Result<LinkedFile> file = read_linked_file(path);
  std::filesystem::remove(path);
  return file;
}

TEST(LinkedFile, TellsTheMachineAndTheNeedsOfALibraryOfThisOne) {
  const auto file = read_linked_file(file_of(reinterpret_cast<const void*>(&read_linked_file)));
  ASSERT_TRUE(file) << file.error();
  EXPECT_EQ(file.value().bits, static_cast<int>(8 * sizeof(void*)));
  EXPECT_THAT(file.value().needed, Contains("libc.so.6"));
}

TEST(LinkedFile, TellsThoseOfALibraryForBoards) {
  const ArmLibrary library = arm_library();
  const auto file = read_back(&library, sizeof library);
  ASSERT_TRUE(file) << file.error();
  EXPECT_EQ(file.value().bits, 32);
  EXPECT_EQ(file.value().machine, unsigned{EM_ARM});
  EXPECT_THAT(file.value().needed, ElementsAre("libm.so.6"));
  EXPECT_THAT(file.value().folders, ElementsAre("$ORIGIN", "/opt"));
}

TEST(LinkedFile, ReadsNothingBehindTheEndOfABrokenFile) {
  ArmLibrary library = arm_library();
  library.dynamic[0].d_un.d_val = 1000;
  library.sections[0].sh_size = 0xffffffff;
  EXPECT_TRUE(read_back(&library, sizeof library).value().needed.empty());
  library = arm_library();
  library.header.e_shnum = 0xffff;
  EXPECT_TRUE(read_back(&library, sizeof library).value().needed.empty());
  EXPECT_TRUE(read_back(&library, EI_NIDENT).ok());
}

TEST(LinkedFile, NamesWhatIsNone) {
  EXPECT_THAT(read_linked_file("/etc/passwd").error(), HasSubstr("'/etc/passwd' cannot be read"));
  EXPECT_THAT(read_linked_file("/nowhere").error(), HasSubstr("/nowhere"));
}

}  // namespace
}  // namespace armature::platform
