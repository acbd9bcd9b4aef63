// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/internal/socket_file.hpp"

#include <cerrno>
#include <system_error>

#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "armature/platform/internal/descriptor.hpp"

namespace armature::platform::internal {
namespace {

base::Error failed(const std::string& path, const std::string& what, int error) {
  return base::Error{"'" + path + "': " + what + ": " + std::generic_category().message(error)};
}

bool somebody_serves(const sockaddr_un& address, int type) {
  const Descriptor probe(::socket(AF_UNIX, type | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const auto* const raw = reinterpret_cast<const sockaddr*>(&address);
  return ::connect(probe.get(), raw, sizeof address) == 0 || errno != ECONNREFUSED;
}

}  // namespace

std::optional<sockaddr_un> address_of(const std::string& path) {
  sockaddr_un address{};
  if (path.empty() || path.size() >= sizeof address.sun_path) return std::nullopt;
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  return address;
}

base::Error no_address(const std::string& path) {
  return base::Error{"'" + path + "': the path of a socket file is expected to have 1 to " +
                     std::to_string(sizeof(sockaddr_un::sun_path) - 1) + " letters, but has " +
                     std::to_string(path.size())};
}

base::Result<void> make_room(const std::string& path, int type) {
  const auto address = address_of(path);
  if (!address) return no_address(path);
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0) return {};
  if (!S_ISSOCK(status.st_mode)) return failed(path, "is not a socket file", EEXIST);
  if (somebody_serves(*address, type)) {
    return failed(path, "another process serves there", EADDRINUSE);
  }
  ::unlink(path.c_str());
  return {};
}

}  // namespace armature::platform::internal
