// SPDX-License-Identifier: Apache-2.0
#pragma once

// Names of what threads exchange, for headers that only refer to it.

namespace armature::rt {

class Distribution;
class LogQueue;
class Outbox;
struct FutexParker;
struct StdAtomics;
template <typename Atomics>
class BasicInbox;
template <typename Atomics>
class BasicMessage;
template <typename Atomics>
class BasicSignal;
template <typename Parker>
class BasicWakeup;

using Inbox = BasicInbox<StdAtomics>;
using Message = BasicMessage<StdAtomics>;
using Signal = BasicSignal<StdAtomics>;
using Wakeup = BasicWakeup<FutexParker>;

}  // namespace armature::rt
