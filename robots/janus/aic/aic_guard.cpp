// SPDX-License-Identifier: Apache-2.0
#include "robots/janus/aic/aic_guard.hpp"

#include "robots/janus/aic/aic_protocol.hpp"

namespace armature::janus {
namespace {

/// Every state but kOn, which is the only one in which motor values are applied.
constexpr AicState kIdleStates[] = {AicState::kStarted, AicState::kOff, AicState::kWatchdog,
                                    AicState::kFault};

}  // namespace

guardian::Orders guard_orders(const std::vector<int>& cards, const std::string& bus,
                              std::uint32_t bit_rate, base::Duration period) {
  constexpr std::uint32_t kAnyCard = 0x780;  // the mask
  guardian::Orders orders;
  orders.bus = bus;
  orders.bit_rate = bit_rate;
  orders.period = period;
  for (std::size_t device = 0; device < cards.size(); ++device) {
    const int card = cards[device];
    orders.safe.push_back(command_frame(card, AicCommand::kBrakeApply));
    orders.safe.push_back(command_frame(card, AicCommand::kActuatorOff));
    orders.questions.push_back(command_frame(card, AicCommand::kIdentify));
    for (const AicState state : kIdleStates) {
      orders.answers.push_back({.device = device,
                                .frame = heartbeat_frame(card, {.state = state}),
                                .mask = {0xff}});  // the state alone
    }
  }
  orders.answers_filter = {.id = identifier(AicFunction::kHeartbeat, 0), .mask = kAnyCard};
  return orders;
}

}  // namespace armature::janus
