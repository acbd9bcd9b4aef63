// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/internal/node/access_control.hpp"

namespace armature::ride::internal {

std::string not_allowed(const AccessQuestion& question) {
  return who(question) + " may not " + std::string(name_of(question.access)) + " '" +
         std::string(question.component) + "'";
}

}  // namespace armature::ride::internal
