// SPDX-License-Identifier: Apache-2.0
#pragma once

// How samples travel where reader and writer do not simply share one place in memory.

#include <cstddef>
#include <cstdint>
#include <memory>

#include "armature/component/lanes.hpp"
#include "armature/component/ports/input_port.hpp"
#include "armature/component/ports/port.hpp"
#include "armature/rt/inbox.hpp"
#include "armature/rt/lane.hpp"

namespace armature::component::internal {

/// One connection from a writer to a reader. As a signal it tells the reader's thread that there is
/// something to read.
class alignas(rt::kCacheLine) Channel : protected rt::Recipient, public rt::Signal {
 public:
  /// @param directly   reader and writer share a thread
  /// @param keeps_all  a FIFO: each value counts, not only the newest
  /// @param lane       for samples that travel in batches
  Channel(InputPortBase& reader, bool directly, bool keeps_all, LaneTo* lane = nullptr)
      : rt::Signal(&Channel::deliver),
        directly_(directly),
        tells_(reader.triggers()),
        keeps_all_(keeps_all),
        reader_(reader),
        lane_(lane) {}
  virtual ~Channel() = default;

  InputPortBase& reader() const { return reader_; }
  bool keeps_all() const { return keeps_all_; }

  /// @param sample  a `Sample` of the ports' type
  /// @thread the writer's
  virtual rt::PushResult push(const void* sample) = 0;
  /// The next sample to read, nullptr if there is none.
  /// @thread the reader's
  virtual const void* pop() = 0;
  /// The number of the newest sample that is certain to be there; 0: of those written so far only
  /// one is kept.
  /// @thread any
  virtual std::uint64_t newest() const { return 0; }
  /// There will be a sample to read in the next cycle.
  virtual bool ripens() const { return false; }

  /// Pushes and has the reader's handler run, if it has one: at once if the writer is in the same
  /// thread.
  /// @thread the writer's
  virtual rt::PushResult send(const void* sample) {
    const rt::PushResult result = push(sample);
    if (tells_) tell_reader();
    return result;
  }

  const void* writer = nullptr;  ///< the port at the other end

 protected:
  LaneTo& lane() const { return *lane_; }
  void tell_reader();
  std::size_t receive(const std::byte*) override { return 0; }

 private:
  static void deliver(rt::Message& message);

  bool directly_;
  bool tells_;
  bool keeps_all_;
  InputPortBase& reader_;
  LaneTo* lane_;

 public:
  /// That the reader took. From here on the reader writes; at what is above both only look, as long
  /// as no signal is needed. On one cache line each would wait for the other at every sample.
  alignas(rt::kCacheLine) std::uint64_t last_sequence = 0;
};

class SampleForm;

/// What a channel is to carry, and between whom.
struct Line {
  ExecutionContext& writing;  ///< the writer's thread
  InputPortBase& reader;
  const ConnectionPolicy& policy;
  const SampleForm& form;
  bool is_small;       ///< see internal::is_small
  const void* sample;  ///< gives what the channel holds its shape

  bool same_thread() const { return &Inside::context(reader.owner()) == &writing; }
};

std::unique_ptr<Channel> make_channel(const Line& line);

}  // namespace armature::component::internal
