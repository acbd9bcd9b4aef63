// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/ticket_pool.hpp"

#include <algorithm>

namespace armature::exec::internal {
namespace {

constexpr auto is_under_way = [](const auto& ticket) {
  const component::CommandStage stage = ticket->stage();
  return stage == component::CommandStage::kAccepted || stage == component::CommandStage::kWaiting;
};

}  // namespace

ToolTicket& TicketPool::claim(component::CommandBase& command, std::uint32_t number) {
  auto free =
      std::ranges::find_if(tickets_, [](const auto& ticket) { return ticket->try_claim(); });
  if (free == tickets_.end()) {
    free = tickets_.emplace(tickets_.end(), new ToolTicket);
    static_cast<void>((*free)->try_claim());  // it is new: nobody else has it
  }
  (*free)->belong_to(command, number);
  return **free;
}

std::vector<std::uint32_t> TicketPool::take_cancelled() {
  std::vector<std::uint32_t> numbers;
  for (const auto& ticket : tickets_) {
    if (const std::uint32_t number = ticket->take_cancelled(); number != 0) {
      numbers.push_back(number);
    }
  }
  return numbers;
}

bool TicketPool::cancel_all() {
  bool any = false;
  for (const auto& ticket : tickets_) {
    if (!is_under_way(ticket)) continue;
    ticket->request_cancel();
    any = true;
  }
  return any;
}

bool TicketPool::any_under_way() const { return std::ranges::any_of(tickets_, is_under_way); }

}  // namespace armature::exec::internal
