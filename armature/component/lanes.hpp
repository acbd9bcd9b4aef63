// SPDX-License-Identifier: Apache-2.0
#pragma once

// What a thread that runs components exchanges with other threads; for who runs them.

#include "armature/component/context.hpp"
#include "armature/rt/inbox.hpp"
#include "armature/rt/lane.hpp"
#include "armature/rt/outbox.hpp"
#include "armature/rt/wakeup.hpp"

namespace armature::component {

/// The way of data to another thread.
struct LaneTo {
  LaneTo(rt::Outbox& writers_outbox, ExecutionContext& reading);
  rt::Outbox& outbox;  ///< of the writer
  ExecutionContext& reader;
  rt::Lane lane;
};

}  // namespace armature::component
