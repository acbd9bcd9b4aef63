// SPDX-License-Identifier: Apache-2.0
#include "armature/component/author.hpp"

namespace {

class Thing final : public armature::component::Component {
 public:
  using Component::Component;
};

}  // namespace

ARMATURE_COMPONENT_LIBRARY(good, registry) { registry.add<Thing>("Thing", "does nothing"); }
