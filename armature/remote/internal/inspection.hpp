// SPDX-License-Identifier: Apache-2.0
#pragma once

// What inspect/ has of an application in the structs of inspection.idl, and back. What a peer says
// may be anything: names that this program does not know and numbers that make no sense become
// "not told".

#include <string>
#include <type_traits>
#include <vector>

#include "armature/inspect/view.hpp"
#include "inspection_types.hpp"

namespace armature::remote::internal {

ApplicationStatus to_wire(const inspect::ApplicationStatus& from);
ComponentStatus to_wire(const inspect::ComponentStatus& from);
Faults to_wire(const inspect::Faults& from);
ComponentDetails to_wire(const inspect::ComponentDescription& from);
ConnectionDetails to_wire(const inspect::Connection& from);
ItemValue to_wire(const inspect::ItemValue& from);
CallResult to_wire(const inspect::CallResult& from);
CommandStatus to_wire(const inspect::CommandStatus& from);
Watch to_wire(const inspect::Watch& from);
WatchedValues to_wire(const inspect::WatchedValues& from);
Cycle to_wire(const inspect::Cycle& from);
LogLines to_wire(const inspect::LogLines& from);
Pace to_wire(const exec::Pace& from);

inspect::ApplicationStatus from_wire(const ApplicationStatus& from);
inspect::ComponentStatus from_wire(const ComponentStatus& from);
inspect::Faults from_wire(const Faults& from);
inspect::ComponentDescription from_wire(const ComponentDetails& from);
inspect::Connection from_wire(const ConnectionDetails& from);
inspect::ItemValue from_wire(const ItemValue& from);
inspect::CallResult from_wire(const CallResult& from);
inspect::CommandStatus from_wire(const CommandStatus& from);
inspect::Watch from_wire(const Watch& from);
inspect::WatchedValues from_wire(const WatchedValues& from);
inspect::Cycle from_wire(const Cycle& from);
inspect::LogLines from_wire(const LogLines& from);
exec::Pace from_wire(const Pace& from);

/// `all`, each by `convert`.
template <typename From, typename Convert>
auto each(const std::vector<From>& all, Convert convert) {
  std::vector<std::invoke_result_t<Convert, const From&>> converted;
  converted.reserve(all.size());
  for (const From& one : all) converted.push_back(convert(one));
  return converted;
}

}  // namespace armature::remote::internal
