// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402_components/bus_plan.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "armature/base/seconds.hpp"
#include "armature/controllers/base/driven_joint.hpp"
#include "armature/controllers/base/sampling_period.hpp"
#include "drives/cia402/bus_time.hpp"
#include "drives/cia402_components/cia402_drive.hpp"

namespace armature::cia402 {
namespace {

using KnownDrives = std::map<int, const Cia402Drive*>;

KnownDrives drives_on(const Cia402Host& host, component::Check& check) {
  KnownDrives known;
  for (const component::Component* const each : check.components()) {
    const auto* const drive = dynamic_cast<const Cia402Drive*>(each);
    if (drive == nullptr || !drive->is_on(host, check)) continue;
    const auto [first, is_new] = known.emplace(drive->node(), drive);
    if (is_new) continue;
    check.error("drives '" + first->second->name() + "' and '" + drive->name() +
                    "' both have node " + std::to_string(drive->node()),
                "give each drive its own number");
  }
  return known;
}

/// Joints whose answers act by what `robot` says at least so late.
std::size_t joints_as_late(const controllers::DescribesRobot& robot, double delay_s) {
  std::size_t count = 0;
  for (std::size_t number = 1;; ++number) {
    const auto joint = robot.joint(number, controllers::JointCommand::kTorque);
    if (!joint) return count;
    if (joint.value().lightest.delay_s >= 0.999 * delay_s) ++count;
  }
}

std::string milliseconds_text(base::Duration duration) {
  component::Reason text;
  return std::string(controllers::append_duration(text, duration).view());
}

}  // namespace

void check_nodes(const std::vector<int>& nodes, int host_node, component::Check& check) {
  if (nodes.empty()) check.error("nodes is empty", "name the numbers of the drives");
  std::set<int> seen;
  for (const int node : nodes) {
    const std::string has = "nodes has " + std::to_string(node);
    if (node < 1 || node > canopen::kLastNode) check.error(has, "numbers of drives are 1 to 127");
    if (!seen.insert(node).second) check.error(has + " twice", "name each drive once");
    if (node != host_node) continue;
    check.error(has + ", which is host_node, too",
                "give the host another number for its heartbeat");
  }
}

void refine_plans(const Cia402Host& host, std::span<DrivePlan> plans, component::Check& check) {
  const KnownDrives known = drives_on(host, check);
  base::Diagnostics diagnostics;
  for (DrivePlan& plan : plans) {
    if (const auto found = known.find(plan.wish.node); found != known.end()) {
      found->second->refine(plan);
    }
    plan.read_eds(diagnostics);
  }
  for (const base::Diagnostic& each : diagnostics.all()) {
    const std::string place = each.where.file.empty() ? "" : each.where.file + ": ";
    check.error(place + each.message, each.hint);
  }
}

void check_bus_time(std::span<const DrivePlan> plans, std::uint32_t bit_rate, base::Duration period,
                    component::Check& check) {
  if (period <= base::Duration{}) return;
  std::vector<DriveWish> wishes;
  for (const DrivePlan& plan : plans) wishes.push_back(plan.wish);
  const base::Duration needed = cycle_bus_time(wishes, bit_rate);
  if (needed <= period) return;
  check.error("the frames of a cycle of " + std::to_string(wishes.size()) + " drives take up to " +
                  milliseconds_text(needed) + " at " + std::to_string(bit_rate) +
                  " bit/s, and a cycle has " + milliseconds_text(period),
              "raise bit_rate, lengthen the period, or put drives on another bus");
}

void check_answer_time(std::span<const DrivePlan> plans, base::Duration period,
                       component::Check& check) {
  const auto drives = static_cast<std::size_t>(std::ranges::count_if(
      plans, [](const DrivePlan& plan) { return plan.mode != CyclicMode::kPosition; }));
  const base::Duration late = 2 * period;
  bool is_described = false;
  std::size_t joints = 0;
  for (const component::Component* const each : check.components()) {
    const auto* const robot = dynamic_cast<const controllers::DescribesRobot*>(each);
    if (robot == nullptr) continue;
    is_described = true;
    joints += joints_as_late(*robot, base::to_seconds(late));
  }
  if (!is_described || joints >= drives) return;
  check.error("an answer to a sample acts two cycles later, " + milliseconds_text(late) +
                  ", and effort_delay of the Robot says so of " + std::to_string(joints) +
                  " joints, expected " + std::to_string(drives),
              "set effort_delay of the Robot to two periods");
}

}  // namespace armature::cia402
