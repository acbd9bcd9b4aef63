// SPDX-License-Identifier: Apache-2.0
#include "armature/bundle/internal/staging.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <system_error>
#include <utility>

#include "armature/platform/output_file.hpp"

namespace armature::bundle::internal {
namespace {

namespace fs = std::filesystem;

/// Whatever the mask of this account: who installs a bundle is another one.
constexpr fs::perms kFolderMode = fs::perms(0755);
constexpr fs::perms kProgramMode = fs::perms(0755);
constexpr fs::perms kFileMode = fs::perms(0644);

base::Error problem(const std::string& path, const std::error_code& failure) {
  return base::Error{"'" + path + "' cannot be written: " + failure.message()};
}

std::error_code make_folders(const fs::path& folder) {
  std::error_code failure;
  if (fs::is_directory(folder, failure)) return {};
  if (const std::error_code above = make_folders(folder.parent_path())) return above;
  if (fs::create_directory(folder, failure)) fs::permissions(folder, kFolderMode, failure);
  return failure;
}

/// Without waiting for the disk, file by file: a loss of power is seen by the hashes.
base::Result<void> write_all(const std::string& path, std::string_view content) {
  auto file = platform::OutputFile::create(path);
  if (!file) return base::Error{file.error()};
  if (auto written = file.value().write(content); !written) return written;
  return file.value().close();
}

}  // namespace

Staging::Staging(std::string target)
    : target_(std::move(target)),
      folder_((fs::path(target_).parent_path() /
               ("." + fs::path(target_).filename().string() + ".part"))
                  .string()) {}

Staging::~Staging() {
  std::error_code ignored;
  if (made_) fs::remove_all(folder_, ignored);
}

base::Result<void> Staging::make() {
  const std::string beside = fs::path(target_).parent_path().string();
  std::error_code failure;
  made_ = fs::create_directory(folder_, failure);
  if (made_) fs::permissions(folder_, kFolderMode, failure);
  if (failure) return problem(beside, failure);
  if (made_) return {};
  return base::Error{"'" + folder_ +
                     "' is there: another bundle is being made, or was killed while it was; "
                     "remove the folder if none is"};
}

base::Result<void> Staging::write(const std::string& place, std::string_view content,
                                  bool executable) {
  const fs::path path = fs::path(folder_) / place;
  std::error_code failure = make_folders(path.parent_path());
  if (failure) return problem(path.parent_path().string(), failure);
  if (auto written = write_all(path.string(), content); !written) return written;
  fs::permissions(path, executable ? kProgramMode : kFileMode, failure);
  if (failure) return problem(path.string(), failure);
  return {};
}

std::vector<std::string> Staging::places() const {
  std::vector<std::string> places;
  for (const auto& each : fs::recursive_directory_iterator(folder_)) {
    if (each.is_regular_file()) places.push_back(each.path().lexically_relative(folder_).string());
  }
  std::ranges::sort(places);
  return places;
}

std::uint64_t Staging::size() const {
  std::uint64_t bytes = 0;
  for (const std::string& place : places()) bytes += fs::file_size(fs::path(folder_) / place);
  return bytes;
}

void Staging::set_times(std::int64_t seconds) const {
  const std::chrono::sys_seconds time{std::chrono::seconds(seconds)};
  const auto file_time = std::chrono::file_clock::from_sys(time);
  std::error_code ignored;
  for (const auto& each : fs::recursive_directory_iterator(folder_)) {
    fs::last_write_time(each.path(), file_time, ignored);
  }
  fs::last_write_time(folder_, file_time, ignored);
}

base::Result<void> Staging::hand_over(const std::string& made) {
  const std::string before = folder_ + ".before";
  std::error_code failure;
  const bool replaces = fs::exists(target_, failure);
  if (replaces) fs::rename(target_, before, failure);
  if (failure) return problem(target_, failure);
  fs::rename(made, target_, failure);
  std::error_code ignored;
  if (failure && replaces) fs::rename(before, target_, ignored);
  if (failure) return problem(target_, failure);
  fs::remove_all(before, ignored);
  return {};
}

}  // namespace armature::bundle::internal
