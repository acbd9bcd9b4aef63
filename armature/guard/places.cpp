// SPDX-License-Identifier: Apache-2.0
#include "armature/guard/internal/places.hpp"

#include "armature/base/hash.hpp"

namespace armature::guard {

std::uint64_t Sighting::key() const {
  std::uint64_t hash = base::fnv1a(component.view());
  const auto mix = [&hash](const void* pointer) {
    hash = (hash ^ reinterpret_cast<std::uintptr_t>(pointer)) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  };
  mix(call);
  for (std::size_t i = 0; i < frame_count; ++i) mix(frames[i]);
  return hash == 0 ? 1 : hash;
}

Place* Places::find_or_claim(std::uint64_t key, bool& claimed) {
  for (std::size_t tried = 0; tried < kCapacity; ++tried) {
    Place& place = places_[(key + tried) % kCapacity];
    std::uint64_t found = 0;
    claimed = place.key.compare_exchange_strong(found, key, std::memory_order_acq_rel);
    if (claimed || found == key) return &place;
  }
  return nullptr;
}

bool Places::add(const Sighting& sighting) {
  bool claimed = false;
  Place* const place = find_or_claim(sighting.key(), claimed);
  if (place == nullptr) {
    elsewhere_.fetch_add(1, std::memory_order_relaxed);
  } else {
    place->count.fetch_add(1, std::memory_order_relaxed);
  }
  if (claimed) {
    place->first = sighting;
    place->complete.store(true, std::memory_order_release);
  }
  violations_.fetch_add(1, std::memory_order_release);
  return claimed;
}

void Places::clear() {
  violations_ = 0;
  elsewhere_ = 0;
  for (Place& place : places_) {
    place.complete = false;
    place.count = 0;
    place.printed = false;
    place.key = 0;
  }
}

}  // namespace armature::guard
