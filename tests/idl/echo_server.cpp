// SPDX-License-Identifier: Apache-2.0
// Gives everything back over TCP, until its input ends.
#include <cstdio>
#include <string>

#include "armature/ride/node.hpp"
#include "tests/idl/echo.hpp"

int main() {
  armature::idl::Echo echo;
  armature::ride::Node node;
  const auto address = node.listen("tcp://127.0.0.1:0");
  if (!address || !node.add("echo", echo)) return 1;
  std::puts(address.value().text().c_str());
  std::fflush(stdout);
  while (std::getchar() != EOF) {
  }
  return 0;
}
