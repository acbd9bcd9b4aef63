// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/pdo.hpp"

#include "drives/canopen/little_endian.hpp"

namespace armature::canopen {

const char* to_text(PdoDirection direction) noexcept {
  return direction == PdoDirection::kReceive ? "RPDO" : "TPDO";
}

unsigned mapped_bits(std::span<const MappedObject> objects) noexcept {
  unsigned bits = 0;
  for (const MappedObject& object : objects) bits += object.bits;
  return bits;
}

base::Result<void> check_mapping(std::span<const MappedObject> objects) {
  for (const MappedObject& object : objects) {
    if (object.bits == 0 || object.bits > kMostPdoBits) {
      return base::Error{"object " + to_text(object.address) + " is mapped with " +
                         std::to_string(object.bits) + " bits, expected 1 to 64"};
    }
  }
  const unsigned bits = mapped_bits(objects);
  if (bits <= kMostPdoBits) return {};
  return base::Error{"the mapped objects have " + std::to_string(bits) +
                     " bits, and a PDO has 64 (spread them over several PDOs)"};
}

can::Frame pack(const Pdo& pdo, std::span<const std::uint64_t> values) noexcept {
  std::uint64_t content = 0;
  unsigned position = 0;
  for (std::size_t i = 0; i < pdo.objects.size() && position < kMostPdoBits; ++i) {
    const unsigned bits = pdo.objects[i].bits;
    if (i < values.size()) content |= (values[i] & low_bits(bits)) << position;
    position += bits;
  }
  can::Frame frame;
  frame.id = pdo.cob_id;
  frame.size = static_cast<std::uint8_t>(bytes_of_bits(std::min(position, kMostPdoBits)));
  store(std::span(frame.data).first(frame.size), content);
  return frame;
}

bool unpack(const Pdo& pdo, const can::Frame& frame, std::span<std::uint64_t> values) noexcept {
  if (frame.kind != can::FrameKind::kData || frame.extended || frame.id != pdo.cob_id) return false;
  const unsigned bits = mapped_bits(pdo.objects);
  if (bits > kMostPdoBits || frame.bytes().size() * 8 < bits) return false;
  std::uint64_t content = load(frame.bytes());
  for (std::size_t i = 0; i < std::min(pdo.objects.size(), values.size()); ++i) {
    const unsigned width = pdo.objects[i].bits;
    values[i] = content & low_bits(width);
    content = width >= 64 ? 0 : content >> width;
  }
  return true;
}

bool PdoTimer::step(bool changed, base::Time now) noexcept {
  const bool may = !sent_ || now >= *sent_ + inhibit_;
  const bool must = event_ > base::Duration{} && (!sent_ || now >= *sent_ + event_);
  if (!may || !(changed || must)) return false;
  sent_ = now;
  return true;
}

}  // namespace armature::canopen
