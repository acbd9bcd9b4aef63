// SPDX-License-Identifier: Apache-2.0
#include "armature/component/check.hpp"

#include "armature/component/host.hpp"

namespace armature::component {

Checked::Checked(Component* owner) { Host::declare(*owner).checked.push_back(this); }

}  // namespace armature::component
