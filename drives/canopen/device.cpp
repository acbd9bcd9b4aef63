// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/device.hpp"

#include <utility>

#include "drives/canopen/internal/device_objects.hpp"
#include "drives/canopen/internal/sdo_frames.hpp"
#include "drives/canopen/sdo_channel.hpp"

namespace armature::canopen {
namespace {

constexpr std::uint16_t kFirstOfProfile = 0x2000;

base::Duration milliseconds_of(std::int64_t ms) { return base::Duration(ms * 1'000'000); }

}  // namespace

Device::Device(Config config, can::Bus& bus)
    : config_(std::move(config)),
      bus_(bus),
      server_(config_.node, dictionary_),
      heartbeat_(config_.node),
      receive_(kPdos),
      transmit_(kPdos) {
  internal::add_device_objects(dictionary_, config_.node, config_.device_type, config_.identity,
                               config_.name);
  for (unsigned number = 1; number <= kPdos; ++number) {
    add_pdo_objects(PdoDirection::kReceive, number);
    add_pdo_objects(PdoDirection::kTransmit, number);
  }
}

void Device::add_pdo_objects(PdoDirection direction, unsigned number) {
  internal::add_pdo_objects(dictionary_, config_.node, direction, number);
  const std::uint16_t mapping = mapping_index(direction, number);
  for (std::uint8_t i = 1; i <= internal::kMostEntries; ++i) {
    dictionary_.set_check({mapping, i}, [this, direction, mapping](std::uint64_t entry) {
      // CiA 301 wants the mapping emptied before it is changed.
      if (dictionary_.number({mapping, 0}) != 0) return AbortCode::kUnsupportedAccess;
      return check_entry(direction, entry);
    });
  }
  dictionary_.set_check({mapping, 0}, [this, direction, number](std::uint64_t count) {
    return check_count(direction, number, count);
  });
}

AbortCode Device::check_entry(PdoDirection direction, std::uint64_t entry) const {
  const MappedObject object = mapped_object(static_cast<std::uint32_t>(entry));
  const ObjectDictionary::Entry* const found = dictionary_.find(object.address);
  if (found == nullptr) return AbortCode::kNoObject;
  const bool reaches = direction == PdoDirection::kReceive ? may_write(found->info.access)
                                                           : may_read(found->info.access);
  if (!found->info.mappable || !reaches || bits_of(found->info.type) != object.bits) {
    return AbortCode::kNotMappable;
  }
  return AbortCode::kNone;
}

AbortCode Device::check_count(PdoDirection direction, unsigned number, std::uint64_t count) const {
  if (count > internal::kMostEntries) return AbortCode::kPdoTooLong;
  unsigned bits = 0;
  for (std::uint8_t i = 1; i <= count; ++i) {
    const auto entry =
        static_cast<std::uint64_t>(dictionary_.number({mapping_index(direction, number), i}));
    if (const AbortCode code = check_entry(direction, entry); code != AbortCode::kNone) return code;
    bits += mapped_object(static_cast<std::uint32_t>(entry)).bits;
  }
  return bits <= kMostPdoBits ? AbortCode::kNone : AbortCode::kPdoTooLong;
}

void Device::map(PdoDirection direction, unsigned number, std::uint8_t transmission,
                 const std::vector<MappedObject>& objects) {
  const std::uint16_t communication = communication_index(direction, number);
  const std::uint16_t mapping = mapping_index(direction, number);
  const std::int64_t cob_id = dictionary_.number({communication, 1});
  dictionary_.set_number({communication, 1}, cob_id & kCobIdMask);
  dictionary_.set_number({communication, 2}, transmission);
  std::uint8_t count = 0;
  for (const MappedObject& object : objects) {
    dictionary_.set_number({mapping, ++count}, mapping_entry(object));
  }
  dictionary_.set_number({mapping, 0}, count);
}

void Device::boot(base::Time now) {
  if (power_on_.empty()) keep_power_on_values();
  bus_.send(heartbeat_frame(config_.node, NmtState::kBootUp));
  nmt_.booted();
  server_.reset();
  sync_.forget();
  read_communication(now);
}

void Device::keep_power_on_values() {
  for (const auto& [address, entry] : dictionary_.entries()) {
    if (bits_of(entry.info.type) > 0) power_on_.emplace_back(address, entry.raw);
  }
}

void Device::restore_communication() {
  for (const auto& [address, raw] : power_on_) {
    if (address.index < kFirstOfProfile) dictionary_.find(address)->raw = raw;
  }
}

void Device::reset(base::Time now) {
  for (const auto& [address, raw] : power_on_) dictionary_.find(address)->raw = raw;
  if (hooks_.on_reset) hooks_.on_reset();
  boot(now);
}

void Device::read_communication(base::Time now) {
  stale_ = false;
  heartbeat_.set_period(milliseconds_of(dictionary_.number({0x1017, 0})), now);
  const std::int64_t consumed = dictionary_.number({0x1016, 1});
  const auto watched = static_cast<NodeId>(consumed >> 16 & kLastNode);
  heartbeats_ = {};
  if (is_node(watched)) heartbeats_.watch(watched, milliseconds_of(consumed & 0xffff));
  read_sync();
  read_pdos();
}

void Device::read_sync() {
  const std::int64_t cob_id = dictionary_.number({0x1005, 0}) & can::Frame::kMostStandard;
  const std::int64_t overflow = dictionary_.number({0x1019, 0});
  if (cob_id == sync_cob_id_ && overflow == sync_overflow_) return;
  sync_cob_id_ = cob_id;
  sync_overflow_ = overflow;
  sync_ = SyncConsumer(static_cast<std::uint8_t>(overflow), static_cast<std::uint32_t>(cob_id));
}

void Device::read_pdos() {
  for (unsigned number = 1; number <= kPdos; ++number) {
    read_pdo(PdoDirection::kReceive, number);
    read_pdo(PdoDirection::kTransmit, number);
  }
}

void Device::read_pdo(PdoDirection direction, unsigned number) {
  const std::uint16_t communication = communication_index(direction, number);
  const std::uint16_t mapping = mapping_index(direction, number);
  const std::int64_t cob_id = dictionary_.number({communication, 1});
  Channel channel;
  channel.pdo.cob_id = static_cast<std::uint32_t>(cob_id) & kCobIdMask;
  channel.pdo.valid = (cob_id & kCobIdInvalid) == 0;
  channel.pdo.transmission = static_cast<std::uint8_t>(dictionary_.number({communication, 2}));
  channel.pdo.inhibit_100us = static_cast<std::uint16_t>(dictionary_.number({communication, 3}));
  channel.pdo.event_ms = static_cast<std::uint16_t>(dictionary_.number({communication, 5}));
  const std::int64_t count = dictionary_.number({mapping, 0});
  for (std::uint8_t i = 1; i <= count; ++i) {
    const auto object = mapped_object(static_cast<std::uint32_t>(dictionary_.number({mapping, i})));
    channel.pdo.objects.push_back(object);
    channel.entries.push_back(dictionary_.find(object.address));
  }
  channel.values.resize(channel.entries.size());
  channel.timer = PdoTimer(channel.pdo);
  auto& channels = direction == PdoDirection::kReceive ? receive_ : transmit_;
  channels[number - 1] = std::move(channel);
}

void Device::take(const can::Arrival& arrival) {
  const can::Frame& frame = arrival.frame;
  if (const auto command = parse_nmt(frame, config_.node)) {
    take_command(*command, arrival.time);
    return;
  }
  heartbeats_.take(frame, arrival.time);
  if (state() == NmtState::kStopped || state() == NmtState::kBootUp) return;
  if (const auto answer = server_.take(frame, arrival.time)) {
    bus_.send(*answer);
    const std::uint8_t said = internal::specifier_of(*answer);
    const bool written =
        said == internal::response::kDownload || said == internal::response::kDownloadSegment;
    // PDO parameters and heartbeats count as soon as they are written.
    if (written && server_.address().index < kFirstOfProfile) stale_ = true;
  }
  if (stale_) read_communication(arrival.time);
  switch (sync_.take(frame, arrival.time)) {
    case SyncConsumer::Heard::kSync:
      take_sync(arrival.time);
      break;
    case SyncConsumer::Heard::kWrongLength:
      report(emergency_code::kSyncLength, error_register::kCommunication);
      break;
    case SyncConsumer::Heard::kOtherFrame:
      take_pdo(arrival);
      break;
  }
}

void Device::take_command(NmtCommand command, base::Time now) {
  switch (nmt_.take(command)) {
    case NmtSlave::Reset::kNone:
      sync_.forget();
      break;
    case NmtSlave::Reset::kNode:
      reset(now);
      break;
    case NmtSlave::Reset::kCommunication:
      restore_communication();
      boot(now);
      break;
  }
}

void Device::take_sync(base::Time now) {
  if (state() != NmtState::kOperational) return;
  for (unsigned i = 0; i < kPdos; ++i) {
    if (receive_[i].fresh) use(receive_[i], i + 1, now);
  }
  if (hooks_.on_sync) hooks_.on_sync(now);
  for (Channel& channel : transmit_) {
    const std::uint8_t type = channel.pdo.transmission;
    if (!channel.pdo.valid || !transmission::is_synchronous(type)) continue;
    if (type == transmission::kAtSyncWhenChanged) {
      if (differs(channel)) send_pdo(channel);
    } else if (++channel.syncs >= type) {
      channel.syncs = 0;
      send_pdo(channel);
    }
  }
}

void Device::take_pdo(const can::Arrival& arrival) {
  if (state() != NmtState::kOperational) return;
  for (unsigned i = 0; i < kPdos; ++i) {
    Channel& channel = receive_[i];
    if (!channel.pdo.valid || arrival.frame.id != channel.pdo.cob_id) continue;
    if (!unpack(channel.pdo, arrival.frame, channel.values)) {
      report(emergency_code::kPdoTooShort, error_register::kCommunication);
    } else if (transmission::is_synchronous(channel.pdo.transmission)) {
      channel.fresh = true;
    } else {
      use(channel, i + 1, arrival.time);
    }
  }
}

void Device::use(Channel& channel, unsigned number, base::Time now) {
  channel.fresh = false;
  for (std::size_t i = 0; i < channel.entries.size(); ++i) {
    channel.entries[i]->raw = channel.values[i];
  }
  if (hooks_.on_pdo) hooks_.on_pdo(number, now);
}

bool Device::differs(const Channel& channel) {
  if (!channel.sent) return true;
  for (std::size_t i = 0; i < channel.entries.size(); ++i) {
    if (channel.values[i] != channel.entries[i]->raw) return true;
  }
  return false;
}

void Device::send_pdo(Channel& channel) {
  channel.sent = true;
  for (std::size_t i = 0; i < channel.entries.size(); ++i) {
    channel.values[i] = channel.entries[i]->raw;
  }
  if (!stuck_pdos_) bus_.send(pack(channel.pdo, channel.values));
}

void Device::step(base::Time now) {
  if (const auto frame = heartbeat_.step(state(), now); frame && !silent_heartbeat_) {
    bus_.send(*frame);
  }
  if (const auto abort = server_.check(now)) bus_.send(*abort);
  heartbeats_.check(now);
  if (state() != NmtState::kOperational) return;
  for (Channel& channel : transmit_) {
    if (!channel.pdo.valid || !transmission::is_event(channel.pdo.transmission)) continue;
    const bool changed = differs(channel);
    if (!channel.timer.step(changed, now)) continue;
    send_pdo(channel);
  }
}

void Device::report(std::uint16_t code, std::uint8_t error_register) {
  dictionary_.set_number({0x1001, 0}, error_register | error_register::kGeneric);
  dictionary_.set_number({0x1003, 0}, 1);
  dictionary_.set_number({0x1003, 1}, code);
  if (state() == NmtState::kStopped) return;
  bus_.send(emergency_frame(
      {.node = config_.node,
       .code = code,
       .error_register = static_cast<std::uint8_t>(error_register | error_register::kGeneric)}));
}

void Device::clear_error() {
  dictionary_.set_number({0x1001, 0}, 0);
  if (state() != NmtState::kStopped) bus_.send(emergency_frame({.node = config_.node}));
}

std::optional<NodeId> Device::lost_node() const {
  for (NodeId node = 1; node <= kLastNode; ++node) {
    if (heartbeats_.node(node).presence == Presence::kLost) return node;
  }
  return std::nullopt;
}

}  // namespace armature::canopen
