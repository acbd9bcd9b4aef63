// SPDX-License-Identifier: Apache-2.0
#include "armature/base/near_name.hpp"

extern "C" __attribute__((visibility("default"))) int greeter() {
  return static_cast<int>(armature::base::near_name("Joimt", {"Joint"}).size());
}
