// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/count_devices.hpp"

#include "drives/canopen/sdo_client.hpp"

namespace armature::canopen {

int count_devices(can::Link& link, NodeId node, base::Duration patience) {
  SdoClient client(node, patience);
  const base::Time until = link.now() + patience;
  if (link.bus().send(client.begin_upload({0x1000, 0}, link.now())) != can::SendStatus::kSent) {
    return 0;
  }
  int answers = 0;
  while (link.now() < until) {
    link.wait_for_news(until);
    can::Arrival arrival;
    while (link.bus().receive(arrival) == can::ReceiveStatus::kReceived) {
      const Origin origin = origin_of(arrival.frame);
      if (origin.service == Service::kSdoResponse && origin.node == node) ++answers;
    }
  }
  return answers;
}

}  // namespace armature::canopen
