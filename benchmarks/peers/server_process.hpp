// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <sys/types.h>

namespace armature::benchmarks::peers {

/// This program once more, as `--serve NAME`, until the scope ends.
class ServerProcess {
 public:
  ServerProcess(const std::string& name, int cpu);
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;
  ~ServerProcess();

  const std::string& address() const { return address_; }

 private:
  pid_t process_ = 0;
  std::string address_;
};

}  // namespace armature::benchmarks::peers
