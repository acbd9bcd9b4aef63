// SPDX-License-Identifier: Apache-2.0
#include "armature/base/visible_text.hpp"

#include <gtest/gtest.h>

#include "armature/base/diagnostic.hpp"

namespace armature::base {
namespace {

TEST(VisibleText, LeavesOrdinaryTextAlone) {
  const std::string text = "Grüße, 関節\t1\nnext line \\x1b";
  EXPECT_EQ(visible_text(text), text);
  EXPECT_EQ(visible_text(""), "");
}

TEST(VisibleText, WritesOutWhatCommandsATerminal) {
  EXPECT_EQ(visible_text("a\x1b[2Jb"), "a\\x1b[2Jb");
  EXPECT_EQ(visible_text(std::string_view("\0\r\a\x7f", 4)), "\\x00\\x0d\\x07\\x7f");
  EXPECT_EQ(visible_text("\xc2\x9b"), "\\x9b") << "the control sequence introducer of C1";
}

TEST(VisibleText, WritesOutWhatTurnsTheDirectionOfText) {
  EXPECT_EQ(visible_text("a\u202e"
                         "b\u2066"),
            "a\\u202eb\\u2066");
}

TEST(VisibleText, WritesOutBytesThatAreNotUtf8) {
  EXPECT_EQ(visible_text("\x9b"
                         "A\xff\xe2\x82"),
            "\\x9bA\\xff\\xe2\\x82");
}

TEST(VisibleText, IsWhatEveryDiagnosticShows) {
  Diagnostics diagnostics;
  diagnostics.error({"a\x1b[1mb.yaml", 1, 2}, "unknown key '\x1b[2J'", "did you mean '\x07'?");
  const std::string expected =
      "a\\x1b[1mb.yaml:1:2: error: unknown key '\\x1b[2J' (did you mean '\\x07'?)";
  EXPECT_EQ(diagnostics.to_text(), expected + "\n");
  EXPECT_EQ(to_text(diagnostics.all().front()), expected);
}

}  // namespace
}  // namespace armature::base
