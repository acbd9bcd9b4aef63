// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/sockets/service_manager.hpp"

#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace armature::platform {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Listens where a service manager would.
class Manager {
 public:
  explicit Manager(const std::string& name)
      : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    name.copy(address.sun_path + 1, name.size());
    const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
    EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&address), length), 0);
    ::setenv("NOTIFY_SOCKET", ("@" + name).c_str(), 1);
  }
  ~Manager() {
    ::close(socket_);
    for (const char* each : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) ::unsetenv(each);
  }
  std::vector<std::string> heard() {
    std::vector<std::string> all;
    char words[64];
    for (ssize_t n = 0; (n = ::recv(socket_, words, sizeof words, 0)) >= 0;) {
      all.emplace_back(words, static_cast<std::size_t>(n));
    }
    return all;
  }

 private:
  int socket_;
};

TEST(ServiceManager, HearsOfTheStartOfSignsOfLifeAndOfTheStop) {
  Manager manager("armature-test-" + std::to_string(::getpid()));
  ::setenv("WATCHDOG_USEC", "2000000", 1);
  ServiceManager service;
  service.ready();
  for (auto passed = 0ms; passed <= 2s; passed += 10ms) service.is_alive(base::Time(passed) + 5s);
  service.is_stopping();
  EXPECT_THAT(manager.heard(),
              ElementsAre("READY=1", "WATCHDOG=1", "WATCHDOG=1", "WATCHDOG=1", "STOPPING=1"));
}

TEST(ServiceManager, ThatWantsNoSignsOfLifeGetsNone) {
  Manager manager("armature-test-" + std::to_string(::getpid()));
  ServiceManager service;
  service.is_alive(base::Time(5s));
  EXPECT_THAT(manager.heard(), IsEmpty());
  ::setenv("WATCHDOG_USEC", "2000000", 1);
  ::setenv("WATCHDOG_PID", "1", 1);
  ServiceManager of_another;
  of_another.is_alive(base::Time(5s));
  EXPECT_THAT(manager.heard(), IsEmpty());
}

TEST(ServiceManager, WhereThereIsNoneOrItHasGoneNothingHappens) {
  ServiceManager nobody;
  nobody.ready();
  std::optional<Manager> manager("armature-test-" + std::to_string(::getpid()));
  ServiceManager service;
  manager.reset();
  service.ready();
  service.is_stopping();
}

}  // namespace
}  // namespace armature::platform
