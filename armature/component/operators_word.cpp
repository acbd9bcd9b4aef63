// SPDX-License-Identifier: Apache-2.0
#include "armature/component/operators_word.hpp"

#include "armature/component/host.hpp"

namespace armature::component {

OperatorsWord::OperatorsWord(Component* owner, std::string_view name, std::string_view doc) noexcept
    : Property(*owner, name, false, doc, {}, false) {
  apply(changeable_while_running);
  apply(by_operator);
}

bool OperatorsWord::said() const {
  return get() && (!said_at_ || owner().time() - *said_at_ <= kLasts);
}

bool OperatorsWord::take() {
  const bool counts = said();
  withdraw();
  return counts;
}

void OperatorsWord::withdraw() {
  said_at_.reset();
  if (get()) assign(false);
}

void OperatorsWord::swap(types::Value& value) {
  Property::swap(value);
  said_at_.reset();
  const bool dated = Host::context(owner()).supervisor != nullptr;  // before, no time passes
  if (get() && dated) said_at_ = owner().time();
}

}  // namespace armature::component
