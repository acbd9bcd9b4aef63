// SPDX-License-Identifier: Apache-2.0
// What is generated from the files in testdata is exactly what is in testdata/golden.
// UPDATE_EXPECTED=1 in the environment writes these anew; read the difference then.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "idl/compile.hpp"

namespace armature::idl {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
  std::ifstream opened(file, std::ios::binary);
  EXPECT_TRUE(opened) << file;
  return std::string(std::istreambuf_iterator<char>(opened), {});
}

class Golden : public ::testing::TestWithParam<std::string> {};

TEST_P(Golden, IsWhatIsGenerated) {
  const fs::path golden = TESTDATA "/golden";
  const bool update = std::getenv("UPDATE_EXPECTED") != nullptr;
  const fs::path output =
      update ? golden : fs::path(::testing::TempDir()) / ("rcidl_" + GetParam());
  CompileOptions options;
  options.file = TESTDATA "/" + GetParam() + ".idl";
  options.output_folder = output.string();
  options.json = true;
  options.typescript = true;
  ASSERT_EQ(compile(options), "");
  for (const std::string end : {"_types.hpp", "_client.hpp", "_client.cpp", "_service.hpp",
                                "_service.cpp", ".json", ".ts", "_service.ts"}) {
    EXPECT_EQ(content_of(output / (GetParam() + end)), content_of(golden / (GetParam() + end)));
  }
  if (!update) fs::remove_all(output);
}

INSTANTIATE_TEST_SUITE_P(Files, Golden,
                         ::testing::Values("vision", "geometry", "chassis", "everything",
                                           "directory", "odd_names"),
                         [](const auto& name) { return name.param; });

}  // namespace
}  // namespace armature::idl
