// SPDX-License-Identifier: Apache-2.0
#include "idl/output.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>

namespace armature::idl {
namespace {

namespace fs = std::filesystem;

/// One file on its way: written beside its place, then moved there; both can be taken back.
class Change {
 public:
  Change(const fs::path& place, const std::string& content)
      : place_(place),
        beside_(place.string() + ".rcidl-new"),
        before_(content_of(place)),
        content_(content) {}

  bool is_needed() const { return before_ != content_; }

  base::Result<void> prepare() {
    std::error_code failure;
    if (fs::exists(place_, failure) && !fs::is_regular_file(place_, failure)) {
      return base::Error{"cannot write '" + place_.string() + "': it is not a file"};
    }
    std::ofstream file(beside_, std::ios::binary | std::ios::trunc);
    prepared_ = file.is_open();
    file << content_;
    file.close();
    if (file) return {};
    return base::Error{"cannot write '" + place_.string() + "'"};
  }

  base::Result<void> apply() {
    std::error_code failure;
    fs::rename(beside_, place_, failure);
    if (failure) {
      return base::Error{"cannot write '" + place_.string() + "': " + failure.message()};
    }
    prepared_ = false;
    applied_ = true;
    return {};
  }

  void take_back() {
    std::error_code failure;
    if (prepared_) fs::remove(beside_, failure);
    if (!applied_) return;
    if (before_) {
      std::ofstream(place_, std::ios::binary | std::ios::trunc) << *before_;
    } else {
      fs::remove(place_, failure);
    }
  }

 private:
  static std::optional<std::string> content_of(const fs::path& file) {
    std::error_code failure;
    if (!fs::is_regular_file(file, failure)) return std::nullopt;
    std::ifstream opened(file, std::ios::binary);
    if (!opened) return std::nullopt;
    return std::string(std::istreambuf_iterator<char>(opened), {});
  }

  fs::path place_;
  fs::path beside_;
  std::optional<std::string> before_;
  std::string content_;
  bool prepared_ = false;
  bool applied_ = false;
};

base::Result<void> write_all(std::vector<Change>& changes) {
  for (Change& change : changes) {
    if (const auto prepared = change.prepare(); !prepared) return prepared;
  }
  for (Change& change : changes) {
    if (const auto applied = change.apply(); !applied) return applied;
  }
  return {};
}

}  // namespace

base::Result<void> write_files(const std::string& folder, const std::vector<OutputFile>& files) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) {
    return base::Error{"cannot make the folder '" + folder + "': " + failure.message()};
  }
  std::vector<Change> changes;
  for (const OutputFile& file : files) {
    Change change(fs::path(folder) / file.name, file.content);
    if (change.is_needed()) changes.push_back(std::move(change));
  }
  const base::Result<void> written = write_all(changes);
  if (written) return written;
  for (Change& change : changes) change.take_back();
  return written;
}

}  // namespace armature::idl
