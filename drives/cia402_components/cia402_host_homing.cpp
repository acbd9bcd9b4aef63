// SPDX-License-Identifier: Apache-2.0
// Drives that home by themselves, in mode HM.
#include "drives/canopen/nmt.hpp"
#include "drives/cia402/homing.hpp"
#include "drives/cia402_components/cia402_host.hpp"

namespace armature::cia402 {

void Cia402Host::find_homing() {
  for (std::size_t i = 0; i < plans_.size(); ++i) {
    const DriveWish& wish = plans_[i].wish;
    if (!wish.homing) continue;
    const auto method = find_homing_method(wish.homing->method);
    accounts_[i].homing.emplace(wish.mode, !method || method->mark != HomingMark::kHere);
  }
}

bool Cia402Host::home_drive(int node, control::DrivePermit permit) {
  const auto place = place_of(node);
  if (!permit || !place || state() != component::State::kRunning) return false;
  if (is_unprepared(*place)) return false;
  auto& homing = accounts_[*place].homing;
  return homing && homing->begin();
}

/// A drive that is in its cyclic mode is told so, too: nobody else has it in another.
void Cia402Host::step_homing() {
  for (std::size_t i = 0; i < group_->size(); ++i) {
    Account& account = accounts_[i];
    if (!account.homing) continue;
    stop_silent(i);
    const DriveState& drive = group_->state(i);
    const auto order =
        account.homing->step({.power = drive.power,
                              .status = drive.status,
                              .mode = background_->number(i, group_->config(i).slow.size() - 1)});
    group_->set_mode(i, order.mode, order.starts);
    if (order.enables) group_->set_goal(i, PowerGoal::kEnabled);
  }
}

/// A drive that homes plans its motion itself, and its control words come with SYNC: one that hears
/// no SYNC would move on. NMT reaches it, and it stops as its object 0x6007 has it.
void Cia402Host::stop_silent(std::size_t place) {
  Account& account = accounts_[place];
  const DriveState& drive = group_->state(place);
  const bool is_gone = drive.silent_cycles > group_->config(place).most_silent_cycles ||
                       drive.presence == canopen::Presence::kLost;
  if (account.is_started_again && !is_gone) {
    account.is_started_again = account.is_nmt_stopped = false;
  }
  if (!is_gone || account.is_nmt_stopped || account.homing->stage() == HomingStage::kIdle) return;
  account.homing->leave();
  account.is_nmt_stopped = true;
  const canopen::NodeId node = group_->config(place).node;
  link_->bus().send(canopen::nmt_frame(canopen::NmtCommand::kStop, node));
}

}  // namespace armature::cia402
