// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/can/bus.hpp"
#include "armature/can/link.hpp"
#include "drives/canopen/object.hpp"
#include "drives/canopen/pdo.hpp"
#include "drives/canopen/sdo_client.hpp"

namespace armature::canopen {

/// A number of a device, as it was written or has to be.
struct SdoStep {
  Address address;
  std::uint8_t bytes = 4;  ///< 1 to 4
  std::uint32_t value = 0;
  bool is_written = true;  ///< else it is read and compared
};

/// Reads and writes a device's objects while its host configures it: waits for each answer.
/// Errors name device, object and the device's reason.
/// @thread the host's, and not in its cycle
class SdoChannel {
 public:
  using Listener = std::function<void(const can::Arrival&)>;

  /// @param link      open
  /// @param listener  has every frame that comes meanwhile, the device's answers too
  SdoChannel(can::Link& link, NodeId node, Listener listener = {},
             base::Duration patience = SdoClient::kPatience)
      : link_(link), client_(node, patience), listener_(std::move(listener)) {}

  base::Result<std::vector<std::uint8_t>> upload(Address address);
  base::Result<void> download(Address address, std::span<const std::uint8_t> bytes);

  /// Reads a number and checks that it has as many bytes as its type.
  /// @return its value; of a real number, its bits
  base::Result<std::int64_t> read(Address address, DataType type);
  /// Keeps what is written from now on, to be written again to the device after it lost its power.
  void record(std::vector<SdoStep>& steps) { record_ = &steps; }
  /// @param value  in the type's range; its lowest bits are sent
  base::Result<void> write(Address address, DataType type, std::int64_t value);

 private:
  base::Result<void> exchange(const can::Frame& first, const char* what);
  base::Result<void> send(const can::Frame& frame);

  can::Link& link_;
  SdoClient client_;
  Listener listener_;
  std::vector<SdoStep>* record_ = nullptr;
};

/// How a device describes one of its PDOs.
/// @param number  from 1
base::Result<Pdo> read_pdo(SdoChannel& channel, PdoDirection direction, unsigned number);

/// Makes a PDO of the device as `pdo` has it, in the order of CiA 301: switched off, mapping
/// emptied, filled, its length set, parameters, switched on as the last. A mapping that is so
/// already is not written, since many devices have fixed ones; nor are an inhibit time or event
/// timer of 0, since not every device has them.
base::Result<void> write_pdo(SdoChannel& channel, PdoDirection direction, unsigned number,
                             const Pdo& pdo);

/// Where a device has the parameters of a PDO.
/// @param number  from 1
constexpr std::uint16_t communication_index(PdoDirection direction, unsigned number) {
  return static_cast<std::uint16_t>((direction == PdoDirection::kReceive ? 0x1400u : 0x1800u) +
                                    number - 1);
}
constexpr std::uint16_t mapping_index(PdoDirection direction, unsigned number) {
  return static_cast<std::uint16_t>((direction == PdoDirection::kReceive ? 0x1600u : 0x1a00u) +
                                    number - 1);
}
/// The bit of a PDO's or SYNC's COB-ID that says what it is not.
constexpr std::uint32_t kCobIdInvalid = 0x8000'0000;
constexpr std::uint32_t kCobIdMask = 0x1fff'ffff;

}  // namespace armature::canopen
