// SPDX-License-Identifier: Apache-2.0
#include "armature/component/input_port.hpp"

namespace armature::component::internal {

void ChannelBase::tell_reader() {
  if (directly_) {
    reader_.drain(*this);
  } else {
    reader_.owner().context().raise_soon(*this);
  }
}

void ChannelBase::deliver(rt::Message& message) {
  auto& self = static_cast<ChannelBase&>(message);
  self.lower();
  self.reader_.drain(self);
  if (self.ripens()) {
    static_cast<rt::Signal&>(self).raise(self.reader_.owner().context().next_cycle);
  }
}

}  // namespace armature::component::internal
