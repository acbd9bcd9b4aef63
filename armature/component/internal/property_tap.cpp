// SPDX-License-Identifier: Apache-2.0
#include "armature/component/internal/property_tap.hpp"

#include <algorithm>

namespace armature::component::internal {

PropertyTap::PropertyTap(const PropertyBase& property, std::size_t capacity)
    : property_(property),
      last_(note_with_room(property)),
      scratch_(last_.bytes.size()),
      ring_(capacity, rt::WhenFull::kDropOldest, last_) {
  PropertyTap::follow();
}

/// Texts and lists may become longer, to a degree: real-time code cannot make room.
PropertyTap::Note PropertyTap::note_with_room(const PropertyBase& property) {
  constexpr std::size_t kRoom = 256;
  const std::size_t size = types::encoded_size(property.type(), property.data());
  Note note;
  note.bytes.resize(property.type().fixed_size() ? size : std::max(kRoom, 2 * size));
  return note;
}

void PropertyTap::follow() {
  const types::Type& type = property_.type();
  const std::size_t size = types::encoded_size(type, property_.data());
  if (size > scratch_.size()) {
    ++last_.sequence;
    last_.size = scratch_.size() + 1;  // equal to nothing that fits
    count_dropped();
    return;
  }
  types::encode_to(type, property_.data(), scratch_.data());
  if (is_last(size)) return;
  last_.time = property_.owner().time();
  ++last_.sequence;
  last_.size = size;
  last_.bytes.swap(scratch_);
  if (ring_.push(last_) != rt::PushResult::kTaken) count_dropped();
}

bool PropertyTap::is_last(std::size_t size) const {
  return last_.sequence != 0 && size == last_.size &&
         std::equal(scratch_.begin(), scratch_.begin() + static_cast<std::ptrdiff_t>(size),
                    last_.bytes.begin());
}

bool PropertyTap::take(TappedSample& to) {
  const Note* const note = ring_.pop();
  if (note == nullptr) return false;
  to.time = note->time;
  to.sequence = note->sequence;
  to.value.assign(note->bytes.begin(),
                  note->bytes.begin() + static_cast<std::ptrdiff_t>(note->size));
  return true;
}

}  // namespace armature::component::internal
