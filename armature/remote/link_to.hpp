// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "armature/ride/placeholder.hpp"

namespace armature::remote {

/// A component at a peer, used by numbers and descriptions that are known at run time only.
class LinkTo final : public ride::Placeholder {
 public:
  using ride::Placeholder::ask;
  using ride::Placeholder::call;
  using ride::Placeholder::Placeholder;
  using ride::Placeholder::send;
  using ride::Placeholder::subscribe;
};

}  // namespace armature::remote
