// SPDX-License-Identifier: Apache-2.0
// Brings a model that good_library.cpp has too.
#include "armature/component/author.hpp"

namespace {

class Thing final : public armature::component::Component {
 public:
  using Component::Component;
};

}  // namespace

ARMATURE_COMPONENT_LIBRARY(duplicate, registry) {
  registry.add<Thing>("Thing", "does nothing, again");
  registry.add<Thing>("Other", "is new");
}
