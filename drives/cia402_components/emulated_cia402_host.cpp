// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402_components/emulated_cia402_host.hpp"

#include <algorithm>
#include <utility>

#include "armature/platform/clock.hpp"

namespace armature::cia402 {

base::Result<std::unique_ptr<can::Link>> EmulatedCia402Host::make_link() {
  const auto [least, most] = std::minmax_element(nodes().begin(), nodes().end());
  EmulatedBus::Config config;
  config.bit_rate = bit_rate();
  config.first_node = static_cast<canopen::NodeId>(*least);
  config.drives = static_cast<std::size_t>(*most - *least + 1);
  if (const auto added = add_load(config); !added) return base::Error{added.error()};
  const bool simulated = is_simulated();
  auto made = EmulatedLink::make(
      config, simulated ? EmulatedLink::Time::kSimulated : EmulatedLink::Time::kReal,
      simulated ? time() : platform::monotonic_now());
  if (!made) return base::Error{made.error()};
  link_ = made.value().get();
  return std::unique_ptr<can::Link>(std::move(made).value());
}

}  // namespace armature::cia402
