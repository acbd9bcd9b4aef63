// SPDX-License-Identifier: Apache-2.0
#include "armature/bundle/internal/debian.hpp"

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string_view>

#include "armature/bundle/internal/child.hpp"

namespace armature::bundle::internal {
namespace {

constexpr const char* kQuery = "/usr/bin/dpkg-query";
constexpr const char* kBuild = "/usr/bin/dpkg-deb";

/// `libc6:amd64: /lib/x86_64-linux-gnu/libc.so.6`; diversions and what was not found are others.
std::string package_of_line(const std::string& line, const std::string& file) {
  if (!line.ends_with(": " + file) || line.starts_with("diversion ")) return {};
  return line.substr(0, line.find_first_of(":,"));
}

/// Since /lib became a link to /usr/lib, packages name their files either way.
std::string other_name_of(const std::string& file) {
  return file.starts_with("/usr/") ? file.substr(4) : "/usr" + file;
}

}  // namespace

Packages packages_of(const std::map<std::string, std::string>& libraries) {
  Packages packages;
  std::vector<std::string> query{kQuery, "--search"};
  for (const auto& [library, file] : libraries) {
    if (!file.empty()) query.insert(query.end(), {file, other_name_of(file)});
  }
  const std::string answer = run_program(query).output;
  for (const auto& [library, file] : libraries) {
    std::string package;
    std::istringstream lines(answer);
    for (std::string line; std::getline(lines, line) && package.empty();) {
      package = package_of_line(line, file);
      if (package.empty()) package = package_of_line(line, other_name_of(file));
    }
    if (file.empty() || package.empty()) {
      packages.strangers.push_back(library);
    } else {
      packages.names.insert(package);
    }
  }
  return packages;
}

std::string package_in(const std::string& archive) {
  const Ran ran = run_program({kBuild, "--field", archive, "Package"});
  return ran.code == 0 ? ran.output.substr(0, ran.output.find('\n')) : std::string();
}

base::Result<void> build_package(const std::string& folder, const std::string& file) {
  if (!std::filesystem::exists(kBuild)) {
    return base::Error{
        std::string("--deb needs ") + kBuild +
        ", which is not installed: apt install dpkg, or make a folder without --deb"};
  }
  // gzip has one thread, whose bytes are the same on every machine.
  const Ran ran =
      run_program({"/usr/bin/env", "SOURCE_DATE_EPOCH=" + std::to_string(time_of_files()), kBuild,
                   "-Zgzip", "--root-owner-group", "--build", folder, file});
  if (ran.code != 0) return base::Error{"dpkg-deb has failed: " + ran.output};
  return {};
}

std::int64_t time_of_files() {
  constexpr std::int64_t kConstant = 1'577'836'800;  // 2020-01-01
  const char* const said = std::getenv("SOURCE_DATE_EPOCH");
  const std::string_view text = said == nullptr ? "" : said;
  std::int64_t seconds = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  const bool whole = !text.empty() && error == std::errc() && end == text.data() + text.size();
  return whole ? seconds : kConstant;
}

}  // namespace armature::bundle::internal
