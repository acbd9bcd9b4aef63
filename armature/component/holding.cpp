// SPDX-License-Identifier: Apache-2.0
#include "armature/component/holding.hpp"

#include "armature/component/events/event.hpp"
#include "armature/component/host.hpp"

namespace armature::component {

Holding::Holding(Component& owner, Held function, const EventHandlerBase* kept_by)
    : owner_(owner), held_(function), kept_by_(kept_by) {
  Host::declare(owner).holdings.push_back(this);
}

Reason Holding::held() const {
  const bool runs = owner_.state() == State::kRunning || owner_.state() == State::kRunTimeError;
  return runs ? held_(owner_) : Reason();
}

const Component* Holding::kept_by() const {
  const bool known = kept_by_ != nullptr && kept_by_->bound();
  return known ? &kept_by_->source()->owner() : nullptr;
}

}  // namespace armature::component
