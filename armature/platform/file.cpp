// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "armature/platform/confinement.hpp"
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

const char* kind_of(mode_t mode) {
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

base::Error no_file(const std::string& path, mode_t mode) {
  if (S_ISDIR(mode)) return failure("cannot read", path, EISDIR);
  return base::Error{"cannot read '" + path + "': it is " + kind_of(mode) +
                     ", and a file is expected"};
}

std::string without_links(const std::string& path) {
  const std::unique_ptr<char, decltype(&std::free)> target(::realpath(path.c_str(), nullptr),
                                                           &std::free);
  return target != nullptr ? target.get() : path;
}

}  // namespace

base::Result<void> expect_file(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return failure("cannot read", path, errno);
  if (!S_ISREG(status.st_mode)) return no_file(path, status.st_mode);
  return {};
}

base::Result<std::string> read_file(const std::string& path, std::size_t limit_bytes) {
  // Opening a pipe would wait for whoever writes it.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (file.get() < 0) return failure("cannot read", path, errno);
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) return failure("cannot read", path, errno);
  if (!S_ISREG(status.st_mode)) return no_file(path, status.st_mode);
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

bool is_same_file(const std::string& one, const std::string& other) {
  struct stat first {};
  struct stat second {};
  return ::stat(one.c_str(), &first) == 0 && ::stat(other.c_str(), &second) == 0 &&
         first.st_dev == second.st_dev && first.st_ino == second.st_ino;
}

FolderLock::FolderLock(int fd, std::string path) : fd_(fd), path_(std::move(path)) {}
FolderLock::FolderLock(FolderLock&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)), path_(std::move(other.path_)) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
  std::swap(fd_, other.fd_);
  std::swap(path_, other.path_);
  return *this;
}

/// Who comes next makes the file anew, or finds that the one it has opened is no more.
FolderLock::~FolderLock() {
  if (fd_ < 0) return;
  ::unlink(path_.c_str());
  ::close(fd_);
}

base::Result<FolderLock> FolderLock::take(const std::string& folder) {
  const std::string path = folder + "/.armature.lock";
  while (true) {
    Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, kNewFile));
    if (file.get() < 0) return failure("cannot lock", path, errno);
    if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK) return failure("cannot lock", path, errno);
      char pid[32] = "";
      const ssize_t size = ::read(file.get(), pid, sizeof pid - 1);
      return base::Error{"the folder '" + folder + "' is used by another run, process " +
                         (size > 0 ? std::string(pid) : std::string("unknown"))};
    }
    struct stat mine {};
    struct stat present {};
    const bool there = ::fstat(file.get(), &mine) == 0 && ::stat(path.c_str(), &present) == 0;
    if (!there || mine.st_ino != present.st_ino) continue;  // It went with the run before.
    const std::string pid = std::to_string(::getpid());
    if (::ftruncate(file.get(), 0) != 0 || !write_all(file.get(), pid)) {
      return failure("cannot lock", path, errno);
    }
    return FolderLock(file.release(), path);
  }
}

base::Result<void> expect_writable(const std::string& path) {
  if (auto inside = expect_inside(path); !inside) return inside;
  const std::size_t slash = path.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
  struct stat present {};
  if (::stat(path.c_str(), &present) == 0) {
    if (S_ISDIR(present.st_mode)) return failure("cannot write", path, EISDIR);
    if (::access(path.c_str(), W_OK) != 0) return failure("cannot write", path, errno);
  } else if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    return failure("cannot write", path, errno);
  }
  return {};
}

base::Result<void> write_file(const std::string& path, std::string_view content) {
  if (auto inside = expect_inside(path); !inside) return inside;
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
