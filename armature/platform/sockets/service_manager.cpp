// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/sockets/service_manager.hpp"

#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <cstring>

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace armature::platform {
namespace {

std::string from_environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

/// Of WATCHDOG_USEC; not for this process if WATCHDOG_PID names another.
base::Duration watchdog() {
  const std::string process = from_environment("WATCHDOG_PID");
  if (!process.empty() && process != std::to_string(::getpid())) return {};
  return std::chrono::microseconds(
      std::strtoll(from_environment("WATCHDOG_USEC").c_str(), nullptr, 10));
}

}  // namespace

ServiceManager::ServiceManager() : address_(from_environment("NOTIFY_SOCKET")) {
  if (address_.size() < 2 || address_.size() >= sizeof(sockaddr_un::sun_path)) return;
  if (address_[0] != '/' && address_[0] != '@') return;
  socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  interval_ = watchdog() / 2;
}

ServiceManager::~ServiceManager() {
  if (socket_ >= 0) ::close(socket_);
}

void ServiceManager::ready() { say("READY=1"); }

void ServiceManager::is_alive(base::Time now) {
  if (interval_ <= base::Duration{} || now < next_) return;
  next_ = now + interval_;
  say("WATCHDOG=1");
}

void ServiceManager::is_stopping() { say("STOPPING=1"); }

void ServiceManager::say(const char* words) {
  if (socket_ < 0) return;
  sockaddr_un to{};
  to.sun_family = AF_UNIX;
  address_.copy(to.sun_path, address_.size());
  if (to.sun_path[0] == '@') to.sun_path[0] = '\0';  // a name that is no file
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + address_.size());
  static_cast<void>(::sendto(socket_, words, std::strlen(words), MSG_NOSIGNAL,
                             reinterpret_cast<const sockaddr*>(&to), length));
}

}  // namespace armature::platform
