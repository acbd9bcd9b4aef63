// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/can/frame.hpp"
#include "drives/canopen/abort_code.hpp"
#include "drives/canopen/cob_id.hpp"
#include "drives/canopen/object.hpp"

namespace armature::canopen {

/// Reads and writes objects of one device, one after the other, expedited and in segments. It never
/// waits: its user sends what it returns, and gives it what comes in and the time.
class SdoClient {
 public:
  static constexpr base::Duration kPatience = std::chrono::milliseconds(500);

  enum class Status : std::uint8_t {
    kIdle,     ///< nothing was begun yet
    kBusy,     ///< the device has to answer
    kDone,     ///< what was read is in `bytes`
    kAborted,  ///< by either side: see `abort_code`
  };

  static constexpr std::size_t kMostBytes = 64 * 1024;
  /// As many as one frame carries: a client that never has more allocates nothing.
  static constexpr std::size_t kNumberBytes = 4;

  /// @param patience    with each answer of the device
  /// @param most_bytes  that may be read; more is refused
  explicit SdoClient(NodeId node, base::Duration patience = kPatience,
                     std::size_t most_bytes = kMostBytes)
      : node_(node), patience_(patience), most_bytes_(most_bytes) {
    bytes_.reserve(kNumberBytes);
  }

  /// Begins to read; what was under way is forgotten.
  can::Frame begin_upload(Address address, base::Time now);
  /// Begins to write.
  /// @param bytes  at most 64 KiB
  can::Frame begin_download(Address address, std::span<const std::uint8_t> bytes, base::Time now);

  /// The next request, or an abort, if an answer calls for one; other frames do nothing.
  std::optional<can::Frame> take(const can::Frame& frame, base::Time now);
  /// The abort if the device has not answered in time.
  std::optional<can::Frame> check(base::Time now);

  Status status() const { return status_; }
  AbortCode abort_code() const { return code_; }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }
  Address address() const { return address_; }
  NodeId node() const { return node_; }
  /// When `check` has something to do if no answer comes.
  base::Time deadline() const { return heard_ + patience_; }

 private:
  void begin(Address address, bool upload, base::Time now);
  std::optional<can::Frame> answer(const can::Frame& frame);
  std::optional<can::Frame> take_first(const can::Frame& frame);
  std::optional<can::Frame> take_segment(const can::Frame& frame);
  std::optional<can::Frame> give_segment(const can::Frame& frame);
  can::Frame segment_request() const;
  can::Frame abort(AbortCode code);
  std::uint32_t id() const { return cob_id::sdo_request(node_); }

  const NodeId node_;
  const base::Duration patience_;
  const std::size_t most_bytes_;
  Status status_ = Status::kIdle;
  AbortCode code_ = AbortCode::kNone;
  Address address_;
  bool upload_ = false;
  bool in_segments_ = false;
  bool toggle_ = false;
  std::vector<std::uint8_t> bytes_;
  std::size_t given_ = 0;
  std::optional<std::size_t> announced_;
  base::Time heard_{};
};

}  // namespace armature::canopen
