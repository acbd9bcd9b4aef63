// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/types/type.hpp"

namespace armature::record {

/// A recording is a list of channels and, for each, samples in the order in which they were taken.
struct Channel {
  std::string name;    ///< such as `PID1.Out`: UTF-8, not empty, once in a recording
  types::Value shape;  ///< of the channel's type; its vectors have the sizes of those to come
  std::string unit{};  ///< empty for a plain number; the fields of a struct have their own
  std::string doc{};
};

/// Counts from 0 in the order of `add_channel`.
using ChannelId = std::uint16_t;

/// One value of a channel.
struct Sample {
  ChannelId channel = 0;
  base::Time time{};
  std::uint32_t sequence = 0;        ///< counts the channel's samples, those lost included
  std::span<const std::byte> value;  ///< as types::encode has it
};

/// Writes a recording to a file. Errors name the file, what was expected and what happened.
///
/// A sample that does not fit (channel, value or time) is refused, and the recording continues.
/// When the file itself cannot be written (disk full), it is given up: each later call answers the
/// same error at once, so a recorder can count what it loses. The same calls give the same bytes.
/// @thread one at a time, and none that is real-time: it allocates and waits for the disk
class Writer {
 public:
  Writer() = default;
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  virtual ~Writer() = default;

  virtual base::Result<ChannelId> add_channel(Channel channel) = 0;
  virtual base::Result<void> write(const Sample& sample) = 0;

  /// Hands over to the system what is complete, so that it survives this process.
  virtual base::Result<void> flush() = 0;

  /// The file could not be written and was given up.
  virtual bool given_up() const = 0;

  /// Samples that were accepted and are not yet handed over; once the file is given up, no reader
  /// may count on them.
  virtual std::uint64_t unsaved() const = 0;

  /// Completes the file; without it, destruction does so and nobody hears of errors.
  virtual base::Result<void> close() = 0;
};

}  // namespace armature::record
