// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/confinement.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <system_error>

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "armature/platform/internal/descriptor.hpp"

namespace armature::platform {
namespace {

namespace fs = std::filesystem;

/// Written once, before there are threads that read it.
std::optional<fs::path>& confined_to() {
  static std::optional<fs::path> folder;
  return folder;
}

constexpr std::uint64_t kTruncate = 1u << 14;  // Linux 6.2, whose headers not everybody has

/// All by which a file or folder is made, changed or removed, as far as the kernel knows it.
std::uint64_t writing(long version) {
  std::uint64_t rights = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR |
                         LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR |
                         LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG |
                         LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO |
                         LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;
  if (version >= 2) rights |= LANDLOCK_ACCESS_FS_REFER;
  if (version >= 3) rights |= kTruncate;
  return rights;
}

void allow(int rules, const char* path, std::uint64_t rights) {
  const internal::Descriptor place(::open(path, O_PATH | O_CLOEXEC));
  if (place.get() < 0) return;
  landlock_path_beneath_attr rule{};
  rule.allowed_access = rights;
  rule.parent_fd = place.get();
  ::syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
}

void confine_by_the_kernel(const std::string& folder) {
  const long version =
      ::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  if (version < 1) return;
  landlock_ruleset_attr handled{};
  handled.handled_access_fs = writing(version);
  const internal::Descriptor rules(static_cast<int>(
      ::syscall(SYS_landlock_create_ruleset, &handled, sizeof handled.handled_access_fs, 0)));
  if (rules.get() < 0) return;
  allow(rules.get(), folder.c_str(), writing(version));
  const std::uint64_t on_a_file = writing(version) & (LANDLOCK_ACCESS_FS_WRITE_FILE | kTruncate);
  for (const char* const device : {"/dev/null", "/dev/tty"}) allow(rules.get(), device, on_a_file);
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return;
  ::syscall(SYS_landlock_restrict_self, rules.get(), 0);
}

}  // namespace

bool lies_in(const std::string& path, const std::string& folder) {
  std::error_code failure;
  const fs::path whole = fs::weakly_canonical(fs::absolute(path, failure), failure);
  if (failure) return false;
  const fs::path around = fs::weakly_canonical(folder, failure);
  const auto first = std::mismatch(around.begin(), around.end(), whole.begin(), whole.end()).first;
  return !failure && first == around.end();
}

base::Result<void> write_only_in(const std::string& folder) {
  std::error_code failure;
  fs::path whole = fs::canonical(folder, failure);
  if (failure) return base::Error{"'" + folder + "': " + failure.message()};
  confine_by_the_kernel(whole.string());
  confined_to() = std::move(whole);
  return {};
}

base::Result<void> expect_inside(const std::string& path) {
  const auto& folder = confined_to();
  if (!folder || lies_in(path, folder->string())) return {};
  const bool device = path == "/dev/null" || path == "/dev/tty";
  if (device) return {};
  return base::Error{"cannot write '" + path + "': what runs now may change files in '" +
                     folder->string() + "' alone"};
}

}  // namespace armature::platform
