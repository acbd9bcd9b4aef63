// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/elf/shared_object.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::platform {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(SharedObject, FindsItsFunctionsAndNoOthers) {
  const base::Result<SharedObject> library = SharedObject::load("libm.so.6");
  ASSERT_TRUE(library.ok()) << library.error();
  EXPECT_NE(library.value().symbol("cos"), nullptr);
  EXPECT_EQ(library.value().symbol("armature_component_library"), nullptr);
}

TEST(SharedObject, AMissingFileIsNamed) {
  EXPECT_THAT(SharedObject::load("/nowhere/libarm.so").error(),
              AllOf(HasSubstr("/nowhere/libarm.so"), HasSubstr("No such file or directory")));
}

TEST(SharedObject, AFileThatIsNoLibraryIsNamed) {
  EXPECT_THAT(SharedObject::load("/etc/passwd").error(),
              AllOf(HasSubstr("/etc/passwd"), HasSubstr("invalid ELF header")));
}

TEST(SharedObject, ALibraryWithAnUnresolvedFunctionIsRefusedAtOnce) {
  EXPECT_THAT(SharedObject::load(UNRESOLVED_LIBRARY).error(),
              AllOf(HasSubstr(UNRESOLVED_LIBRARY), HasSubstr("undefined symbol"),
                    HasSubstr("function_that_nobody_has")));
}

TEST(SharedObject, TellsWhatALibraryWasLinkedWith) {
  const std::string runtime = file_of(reinterpret_cast<const void*>(&needed_libraries));
  EXPECT_THAT(needed_libraries(runtime), Contains("libc.so.6")) << runtime;
}

TEST(SharedObject, WhatIsNoLibraryNeedsNone) {
  EXPECT_THAT(needed_libraries("/nowhere/libarm.so"), IsEmpty());
  EXPECT_THAT(needed_libraries("/etc/passwd"), IsEmpty());
  EXPECT_THAT(needed_libraries("/etc"), IsEmpty());
}

}  // namespace
}  // namespace armature::platform
