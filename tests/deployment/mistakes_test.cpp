// SPDX-License-Identifier: Apache-2.0
// Every deployment in mistakes/ is refused, with exactly the text in the .expected file beside it.
// A comment `# armature check --set A.b=c` in it gives the options. UPDATE_EXPECTED=1 in the
// environment writes the .expected files anew; read the difference then.
#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/registry.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/deploy/loader.hpp"

namespace armature::deploy {
namespace {

namespace fs = std::filesystem;

bool is_deployment(const fs::path& file) {
  return file.extension() == ".yaml" || file.extension() == ".xml";
}

std::vector<std::string> all_mistakes() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(MISTAKES)) {
    if (is_deployment(entry.path())) names.push_back(entry.path().filename());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string content_of(const fs::path& file) {
  std::stringstream content;
  content << std::ifstream(file).rdbuf();
  return content.str();
}

DeploymentOptions options_in(const std::string& file) {
  DeploymentOptions options;
  options.library_folders = {LIBRARIES, BAD_LIBRARIES};
  options.cpus = 2;
  std::istringstream lines(content_of(file));
  for (std::string line; std::getline(lines, line);) {
    constexpr std::string_view kCommand = "# armature check ";
    if (!line.starts_with(kCommand)) continue;
    std::istringstream words(line.substr(kCommand.size()));
    for (std::string option, value; words >> option >> value;) {
      if (option == "--set") options.document.overrides.push_back(value);
      if (option == "--mode") options.mode = value;
      if (option == "--times") options.times_file = value;
    }
  }
  return options;
}

void replace_all(std::string& text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what)) {
    text.replace(at, what.size(), by);
  }
}

/// Folders and compiler differ from machine to machine.
std::string without_machine(std::string text) {
  replace_all(text, LIBRARIES, "LIBRARIES");
  replace_all(text, BAD_LIBRARIES, "BAD_LIBRARIES");
  replace_all(text, library_folders({}, "").front(), "PRODUCT");
  replace_all(text, component::abi_tag(), "THIS_ABI");
  return text;
}

std::string answer_to(const std::string& file) {
  const Deployment deployment = load_deployment(file, options_in(file));
  EXPECT_FALSE(deployment.ok()) << file << " has no mistake";
  return without_machine(deployment.diagnostics.to_text());
}

class Mistake : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    ::unsetenv("ARMATURE_LIBRARY_PATH");
    fs::current_path(MISTAKES);
  }
};

TEST_P(Mistake, IsAnsweredByItsOwnTextWithItsPlace) {
  const fs::path expected = fs::path(GetParam()).replace_extension(".expected");
  const std::string answer = answer_to(GetParam());
  if (std::getenv("UPDATE_EXPECTED") != nullptr) std::ofstream(expected) << answer;
  EXPECT_EQ(answer, content_of(expected));
  std::istringstream lines(answer);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_THAT(line, ::testing::ContainsRegex("^([^:]+:[0-9]+:[0-9]+|<command line>): error: "));
  }
}

INSTANTIATE_TEST_SUITE_P(Files, Mistake, ::testing::ValuesIn(all_mistakes()), [](const auto& file) {
  std::string name = file.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
});

TEST(Mistakes, EveryExpectedTextHasItsDeployment) {
  for (const auto& entry : fs::directory_iterator(MISTAKES)) {
    if (entry.path().extension() != ".expected") continue;
    const bool yaml = fs::exists(fs::path(entry.path()).replace_extension(".yaml"));
    const bool xml = fs::exists(fs::path(entry.path()).replace_extension(".xml"));
    EXPECT_TRUE(yaml != xml) << entry.path() << " belongs to one deployment";
  }
}

}  // namespace
}  // namespace armature::deploy
