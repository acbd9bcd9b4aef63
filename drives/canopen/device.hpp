// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/can/bus.hpp"
#include "drives/canopen/emergency.hpp"
#include "drives/canopen/heartbeat.hpp"
#include "drives/canopen/nmt.hpp"
#include "drives/canopen/object_dictionary.hpp"
#include "drives/canopen/pdo.hpp"
#include "drives/canopen/sdo_server.hpp"
#include "drives/canopen/sync.hpp"

namespace armature::canopen {

/// Who a device is, object 0x1018.
struct Identity {
  std::uint32_t vendor = 0;
  std::uint32_t product = 0;
  std::uint32_t revision = 0;
  std::uint32_t serial = 0;

  friend bool operator==(const Identity&, const Identity&) = default;
};

/// A device on the bus by CiA 301: NMT, SDO server, up to four PDOs each way, SYNC, heartbeats both
/// ways, EMCY. What it is beyond that are the objects that its maker adds to its dictionary.
class Device {
 public:
  static constexpr unsigned kPdos = 4;

  struct Config {
    NodeId node = 1;
    std::uint32_t device_type = 0;
    Identity identity;
    std::string name;
  };
  /// What the maker does; all but `on_reset` may be left out.
  struct Hooks {
    /// Values are to be what they were at power-on.
    std::function<void()> on_reset{};
    /// A SYNC has come; before PDOs that it sends are packed.
    std::function<void(base::Time)> on_sync{};
    /// A receive PDO has been stored in the dictionary.
    std::function<void(unsigned number, base::Time)> on_pdo{};
  };

  /// @param bus  open, and lives as long
  Device(Config config, can::Bus& bus);

  ObjectDictionary& dictionary() { return dictionary_; }
  const ObjectDictionary& dictionary() const { return dictionary_; }
  void set_hooks(Hooks hooks) { hooks_ = std::move(hooks); }

  /// Maps objects to a PDO as it is at power-on, at its identifier of the predefined set.
  /// @param number  1 to 4
  void map(PdoDirection direction, unsigned number, std::uint8_t transmission,
           const std::vector<MappedObject>& objects);

  /// Says that it has started, and is pre-operational.
  void boot(base::Time now);
  /// As at power-on: communication parameters, the maker's `on_reset`, boot-up.
  void reset(base::Time now);
  void take(const can::Arrival& arrival);
  /// Heartbeats, event-driven PDOs, timeouts; at least once a millisecond.
  void step(base::Time now);
  /// Sends an EMCY, unless stopped, and keeps its code in 0x1003.
  void report(std::uint16_t code, std::uint8_t error_register);
  /// The error is gone: EMCY with code 0.
  void clear_error();

  NmtState state() const { return nmt_.state(); }
  NodeId node() const { return config_.node; }
  bool sync_missing(base::Time now) const { return sync_.missing(now); }
  void set_sync_timeout(base::Duration timeout) { sync_.set_timeout(timeout); }
  /// The first node whose heartbeat 0x1016 awaits and that is lost.
  std::optional<NodeId> lost_node() const;

  /// Faults on demand: neither transmit PDOs nor heartbeats are sent, as long as it is set.
  void set_stuck_pdos(bool stuck) { stuck_pdos_ = stuck; }
  void set_silent_heartbeat(bool silent) { silent_heartbeat_ = silent; }

 private:
  struct Channel {
    Pdo pdo;
    std::vector<ObjectDictionary::Entry*> entries;
    std::vector<std::uint64_t> values;  ///< as they were sent last, or came in
    PdoTimer timer;
    bool sent = false;
    bool fresh = false;  ///< came in and waits for SYNC
    std::uint8_t syncs = 0;
  };

  void add_pdo_objects(PdoDirection direction, unsigned number);
  AbortCode check_entry(PdoDirection direction, std::uint64_t entry) const;
  AbortCode check_count(PdoDirection direction, unsigned number, std::uint64_t count) const;
  void keep_power_on_values();
  void restore_communication();
  void read_communication(base::Time now);
  void read_sync();
  void read_pdos();
  void read_pdo(PdoDirection direction, unsigned number);
  void take_command(NmtCommand command, base::Time now);
  void take_sync(base::Time now);
  void take_pdo(const can::Arrival& arrival);
  void use(Channel& channel, unsigned number, base::Time now);
  static bool differs(const Channel& channel);
  void send_pdo(Channel& channel);

  const Config config_;
  can::Bus& bus_;
  ObjectDictionary dictionary_;
  Hooks hooks_;
  SdoServer server_;
  NmtSlave nmt_;
  HeartbeatProducer heartbeat_;
  HeartbeatConsumer heartbeats_;
  SyncConsumer sync_;
  std::int64_t sync_cob_id_ = cob_id::kSync;
  std::int64_t sync_overflow_ = 0;
  std::vector<Channel> receive_;
  std::vector<Channel> transmit_;
  std::vector<std::pair<Address, std::uint64_t>> power_on_;
  bool stale_ = true;  ///< communication parameters were written
  bool stuck_pdos_ = false;
  bool silent_heartbeat_ = false;
};

}  // namespace armature::canopen
