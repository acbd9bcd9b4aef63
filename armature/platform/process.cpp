// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/process.hpp"

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include <sys/utsname.h>
#include <unistd.h>

namespace armature::platform {

std::string kernel_version() {
  utsname names{};
  if (::uname(&names) != 0) return {};
  return std::string(names.release) + " " + names.version;
}

std::string machine_text() {
  utsname names{};
  if (::uname(&names) != 0) return {};
  return std::string(names.nodename) + ", " + names.sysname + " " + names.release + " " +
         names.machine;
}

void exit_now(int status) { ::_exit(status); }

base::Error start_again(const std::vector<std::string>& arguments,
                        const std::vector<std::pair<std::string, std::string>>& environment) {
  for (const auto& [name, value] : environment) ::setenv(name.c_str(), value.c_str(), 1);
  std::vector<char*> pointers;
  for (const std::string& argument : arguments) {
    pointers.push_back(const_cast<char*>(argument.c_str()));  // execv does not write to them
  }
  pointers.push_back(nullptr);
  ::execv("/proc/self/exe", pointers.data());
  return {"cannot start the program again: " + std::generic_category().message(errno)};
}

}  // namespace armature::platform
