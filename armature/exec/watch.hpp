// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/component/ports/port.hpp"
#include "armature/component/properties/property.hpp"
#include "armature/types/number_place.hpp"

namespace armature::exec {

/// A number of a component that is looked at again and again.
struct WatchedNumber {
  component::Component* component = nullptr;
  const component::PortBase* port = nullptr;  ///< else of the property
  const component::PropertyBase* property = nullptr;
  types::NumberPlace place;
};

/// What the watched numbers of one thread were after one of its cycles.
struct WatchSample {
  std::vector<double> values;  ///< in the order asked for; NaN: nobody wrote the port yet, or none
  /// When the port of each was written; of a property, when it was looked at.
  std::vector<base::Time> times;
  /// Samples that newer ones replaced before they were taken, of all threads.
  std::uint64_t replaced = 0;
};

}  // namespace armature::exec
