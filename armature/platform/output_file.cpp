// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/output_file.hpp"

#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "armature/platform/confinement.hpp"

namespace armature::platform {
namespace {

constexpr int kClosed = -1;

base::Error cannot_write(const std::string& path, int error) {
  return base::Error{"cannot write '" + path + "': " + std::generic_category().message(error)};
}

}  // namespace

OutputFile::OutputFile(std::string path, int fd) : path_(std::move(path)), fd_(fd) {}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)), fd_(std::exchange(other.fd_, kClosed)), size_(other.size_) {}

OutputFile::~OutputFile() {
  if (fd_ != kClosed) ::close(fd_);
}

base::Result<OutputFile> OutputFile::create(const std::string& path) {
  if (const auto inside = expect_inside(path); !inside) return base::Error{inside.error()};
  const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_NOCTTY | O_CLOEXEC,
                        S_IRUSR | S_IWUSR | S_IRGRP | S_IROTH);
  if (fd < 0) return cannot_write(path, errno);
  OutputFile file(path, fd);
  struct stat status {};
  if (::fstat(fd, &status) != 0 || !S_ISREG(status.st_mode)) return file;
  if (::flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    return base::Error{"cannot write '" + path + "': another process writes it"};
  }
  if (::ftruncate(fd, 0) != 0) return cannot_write(path, errno);
  return file;
}

base::Result<void> OutputFile::write(std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(fd_, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return cannot_write(path_, errno);
    size_ += static_cast<std::uint64_t>(written);
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

void OutputFile::truncate(std::uint64_t size) {
  if (size >= size_ || ::ftruncate(fd_, static_cast<off_t>(size)) != 0) return;
  ::lseek(fd_, static_cast<off_t>(size), SEEK_SET);
  size_ = size;
}

base::Result<void> OutputFile::close() {
  const int fd = std::exchange(fd_, kClosed);
  if (fd != kClosed && ::close(fd) != 0) return cannot_write(path_, errno);
  return {};
}

}  // namespace armature::platform
