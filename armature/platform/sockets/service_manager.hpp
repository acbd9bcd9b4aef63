// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/base/time.hpp"

namespace armature::platform {

/// What systemd wants to hear of a service of `Type=notify`: that it has started, that it lives
/// (`WatchdogSec`), that it stops. Where no service manager has started the process (no
/// NOTIFY_SOCKET), nothing is said. Nothing waits for the manager, and what it does not take is
/// lost.
/// @thread the controlling one
class ServiceManager {
 public:
  ServiceManager();
  ServiceManager(const ServiceManager&) = delete;
  ServiceManager& operator=(const ServiceManager&) = delete;
  ~ServiceManager();

  void ready();
  bool wants_signs_of_life() const { return interval_ > base::Duration{}; }
  /// Called often; says so twice in the time after which the manager takes the process for dead.
  /// @param now  on the monotonic clock
  void is_alive(base::Time now);
  /// From here on the manager counts the time that a stop may take.
  void is_stopping();

 private:
  void say(const char* words);

  int socket_ = -1;
  std::string address_;
  base::Duration interval_{};  ///< between signs of life; 0: none are wanted
  base::Time next_{};
};

}  // namespace armature::platform
