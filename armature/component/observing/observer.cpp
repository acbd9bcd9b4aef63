// SPDX-License-Identifier: Apache-2.0
#include "armature/component/observing/observer.hpp"

#include "armature/component/host.hpp"

namespace armature::component {

Observer::Observer(Component* owner) { Host::declare(*owner).observers.push_back(this); }

}  // namespace armature::component
