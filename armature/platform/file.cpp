// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "armature/platform/internal/descriptor.hpp"

namespace armature::platform {
namespace {

using internal::Descriptor;

base::Error failure(const std::string& what, const std::string& path, int error) {
  return base::Error{what + " '" + path + "': " + std::generic_category().message(error)};
}

bool write_all(int fd, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(fd, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

constexpr mode_t kPermissions = 07777;
constexpr mode_t kNewFile = S_IRUSR | S_IWUSR | S_IRGRP | S_IROTH;

/// Leaves the reason in errno.
bool write_draft(const std::string& draft, mode_t mode, std::string_view content) {
  const Descriptor file(::open(draft.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, mode));
  return file.get() >= 0 && (mode == kNewFile || ::fchmod(file.get(), mode) == 0) &&
         write_all(file.get(), content) && ::fsync(file.get()) == 0;
}

/// For devices, pipes and sockets, which must not be replaced by a file.
base::Result<void> write_in_place(const std::string& path, std::string_view content) {
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC));
  if (file.get() < 0 || !write_all(file.get(), content)) {
    return failure("cannot write", path, errno);
  }
  return {};
}

std::string without_links(const std::string& path) {
  const std::unique_ptr<char, decltype(&std::free)> target(::realpath(path.c_str(), nullptr),
                                                           &std::free);
  return target != nullptr ? target.get() : path;
}

}  // namespace

base::Result<std::string> read_file(const std::string& path, std::size_t limit_bytes) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) return failure("cannot read", path, errno);
  struct stat status {};
  if (::fstat(file.get(), &status) == 0 && S_ISDIR(status.st_mode)) {
    return failure("cannot read", path, EISDIR);
  }
  std::string content;
  char block[16384];
  while (true) {
    const ssize_t got = ::read(file.get(), block, sizeof block);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return failure("cannot read", path, errno);
    if (got == 0) return content;
    content.append(block, static_cast<std::size_t>(got));
    if (content.size() > limit_bytes) {
      return base::Error{"cannot read '" + path + "': it is larger than " +
                         std::to_string(limit_bytes) + " bytes"};
    }
  }
}

base::Result<void> write_file(const std::string& path, std::string_view content) {
  struct stat present {};
  const bool exists = ::stat(path.c_str(), &present) == 0;
  if (exists && !S_ISREG(present.st_mode)) return write_in_place(path, content);
  const std::string target = exists ? without_links(path) : path;
  const std::string draft = target + ".new";
  const mode_t mode = exists ? present.st_mode & kPermissions : kNewFile;
  if (write_draft(draft, mode, content) && std::rename(draft.c_str(), target.c_str()) == 0) {
    return {};
  }
  const int error = errno;
  ::unlink(draft.c_str());
  return failure("cannot write", path, error);
}

}  // namespace armature::platform
