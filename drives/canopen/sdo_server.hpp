// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/can/frame.hpp"
#include "drives/canopen/cob_id.hpp"
#include "drives/canopen/object_dictionary.hpp"

namespace armature::canopen {

/// Serves a dictionary to one client at a time, expedited and in segments. Block transfers are
/// refused with `kUnknownCommand`, after which clients use segments.
class SdoServer {
 public:
  static constexpr base::Duration kPatience = std::chrono::seconds(1);

  SdoServer(NodeId node, ObjectDictionary& dictionary) : node_(node), dictionary_(dictionary) {}

  /// The answer to a request, if it has one; other frames have none.
  std::optional<can::Frame> take(const can::Frame& frame, base::Time now);
  /// The abort of a transfer whose client has been silent for `kPatience`.
  std::optional<can::Frame> check(base::Time now);
  /// The object that was asked for last.
  Address address() const { return address_; }
  /// Forgets the transfer under way.
  void reset() { phase_ = Phase::kIdle; }

 private:
  enum class Phase : std::uint8_t { kIdle, kUpload, kDownload };

  can::Frame begin_download(const can::Frame& request);
  can::Frame begin_upload(const can::Frame& request);
  can::Frame take_segment(const can::Frame& request);
  can::Frame give_segment(const can::Frame& request);
  can::Frame answer(const can::Frame& request);
  can::Frame abort(AbortCode code);
  std::uint32_t id() const { return cob_id::sdo_response(node_); }

  const NodeId node_;
  ObjectDictionary& dictionary_;
  Phase phase_ = Phase::kIdle;
  Address address_;
  std::vector<std::uint8_t> bytes_;  ///< of the transfer
  std::size_t given_ = 0;
  std::optional<std::size_t> announced_;
  bool toggle_ = false;
  base::Time heard_{};
};

}  // namespace armature::canopen
