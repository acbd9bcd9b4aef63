// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/base/checked_gains.hpp"

#include "armature/base/seconds.hpp"

namespace armature::controllers {

void CheckedGains::check(component::Check& check) const {
  joints_ = find_(check);
  const double period = base::to_seconds(owner_.period());
  if (joints_.empty()) return;
  if (owner_.pace().ambiguous()) {
    return check.error("its gains cannot be checked: '" + owner_.pace().owner->name() + "' and '" +
                           owner_.pace().other_owner->name() + "' run it with different periods",
                       "have one of them run it");
  }
  if (period <= 0.0) {
    return check.warning("its gains are not checked: no periodic component runs it");
  }
  if (std::string wrong = judge_(joints_, period, {}); !wrong.empty()) check.error(wrong);
}

std::string CheckedGains::objection_to(const component::PropertyBase& property,
                                       const types::Value& value) const {
  const double period = base::to_seconds(owner_.period());
  if (joints_.empty() || period <= 0.0) return {};
  return judge_(joints_, period, {.property = &property, .data = value.data()});
}

}  // namespace armature::controllers
