// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402_components/prepare_bus.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include "armature/base/as_reason.hpp"
#include "drives/canopen/count_devices.hpp"
#include "drives/canopen/nmt.hpp"
#include "drives/canopen/sdo_channel.hpp"
#include "drives/cia402/compare_eds.hpp"
#include "drives/cia402/drive_settings.hpp"
#include "drives/cia402/objects.hpp"
#include "drives/cia402/prepare_drive.hpp"

namespace armature::cia402 {
namespace {

/// In which a drive takes a command of NMT.
constexpr base::Duration kNmtTime = std::chrono::milliseconds(5);

std::optional<DriveConfig> prepare_planned(can::Link& link, const DrivePlan& plan, bool asks_slowly,
                                           base::Diagnostics& diagnostics) {
  const DriveWish& wish = plan.wish;
  if (const int devices = canopen::count_devices(link, wish.node); devices > 1) {
    diagnostics.error({},
                      "drive '" + wish.name + "', node " + std::to_string(wish.node) + ": " +
                          std::to_string(devices) + " devices answer as this node, expected one",
                      std::string("give each device on the bus its own number"));
    return std::nullopt;
  }
  canopen::SdoChannel channel(link, wish.node);
  const bool is_described =
      !plan.eds || compare_with_eds(channel, *plan.eds, plan.eds_file, wish, diagnostics);
  if (!is_described) return std::nullopt;
  auto config = prepare_drive(channel, wish, diagnostics);
  if (!config || !asks_slowly) return config;
  config->slow = {object::kCurrent};
  if (plan.temperature) config->slow.push_back(*plan.temperature);
  if (wish.homing) config->slow.push_back(object::kModeDisplay);
  return config;
}

void tell_all(can::Link& link, canopen::NmtCommand command) {
  link.bus().send(canopen::nmt_frame(command, canopen::kEveryNode));
  pass_time(link, kNmtTime);
}

}  // namespace

void pass_time(can::Link& link, base::Duration time) {
  const base::Time until = link.now() + time;
  while (link.now() < until) link.wait_for_news(until);
}

base::Result<DriveGroup> prepare_bus(can::Link& link, const std::vector<DrivePlan>& plans,
                                     bool asks_slowly) {
  tell_all(link, canopen::NmtCommand::kEnterPreOperational);
  base::Diagnostics diagnostics;
  std::vector<DriveConfig> configs;
  for (const DrivePlan& plan : plans) {
    auto config = prepare_planned(link, plan, asks_slowly, diagnostics);
    if (config) configs.push_back(*std::move(config));
  }
  if (!diagnostics.ok()) return base::Error{base::as_reason(diagnostics)};
  auto group = DriveGroup::make(std::move(configs));
  if (group) tell_all(link, canopen::NmtCommand::kStart);
  return group;
}

void announce_heartbeat(can::Link& link, const std::vector<DrivePlan>& plans) {
  for (const DrivePlan& plan : plans) {
    canopen::SdoChannel channel(link, plan.wish.node);
    const auto settings = settings_of(plan.wish);
    for (const Setting& setting : settings.value()) {
      if (setting.address != kConsumedHeartbeat) continue;
      static_cast<void>(channel.write(setting.address, setting.type, setting.value));
    }
  }
}

}  // namespace armature::cia402
