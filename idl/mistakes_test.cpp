// SPDX-License-Identifier: Apache-2.0
// Every file in testdata/mistakes is refused, with exactly the text in the .expected file beside
// it. UPDATE_EXPECTED=1 in the environment writes these anew; read the difference then.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "idl/compile.hpp"

namespace armature::idl {
namespace {

namespace fs = std::filesystem;

/// Absolute: each test is run there.
const fs::path kMistakes = fs::absolute(TESTDATA "/mistakes");

std::vector<std::string> all_mistakes() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kMistakes)) {
    if (entry.path().extension() == ".idl") names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string content_of(const fs::path& file) {
  std::ifstream opened(file, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(opened), {});
}

class Mistake : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { fs::current_path(kMistakes); }
};

TEST_P(Mistake, IsAnsweredByItsOwnTextWithItsPlace) {
  const fs::path output = fs::path(::testing::TempDir()) / ("rcidl_mistake_" + GetParam());
  fs::remove_all(output);
  CompileOptions options;
  options.file = GetParam() + ".idl";
  options.output_folder = output.string();
  const std::string answer = compile(options);
  const std::string expected = GetParam() + ".expected";
  if (std::getenv("UPDATE_EXPECTED") != nullptr) std::ofstream(expected) << answer;
  EXPECT_EQ(answer, content_of(expected));
  EXPECT_THAT(answer, ::testing::ContainsRegex("^[^:]+:[0-9]+:[0-9]+: error: "));
  EXPECT_FALSE(fs::exists(output)) << "something was written";
}

INSTANTIATE_TEST_SUITE_P(Files, Mistake, ::testing::ValuesIn(all_mistakes()),
                         [](const auto& name) { return name.param; });

TEST(Mistakes, EveryExpectedTextHasItsFile) {
  for (const auto& entry : fs::directory_iterator(kMistakes)) {
    if (entry.path().extension() != ".expected") continue;
    EXPECT_TRUE(fs::exists(fs::path(entry.path()).replace_extension(".idl"))) << entry.path();
  }
}

TEST(Mistakes, AFileThatIsNotThereIsNamed) {
  CompileOptions options;
  options.file = "/nowhere/x.idl";
  EXPECT_EQ(compile(options), "/nowhere/x.idl: error: file '/nowhere/x.idl' does not exist\n");
}

}  // namespace
}  // namespace armature::idl
