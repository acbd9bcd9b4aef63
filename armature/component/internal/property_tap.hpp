// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "armature/component/observing/tap.hpp"
#include "armature/component/properties/property.hpp"
#include "armature/rt/ring.hpp"

namespace armature::component::internal {

/// What a property is and becomes. Its changes are made in its component's thread, so they are
/// noted there; of too many at once the newest stay.
class PropertyTap final : public Tap, public PropertyFollower {
 public:
  PropertyTap(const PropertyBase& property, std::size_t capacity);

  bool take(TappedSample& sample) override;
  /// @rt nonblocking, no allocation
  void follow() override;
  std::string objection() const override { return {}; }

 private:
  struct Note {
    base::Time time{};
    std::uint64_t sequence = 0;
    std::size_t size = 0;  ///< of `bytes`, which have room for longer values
    std::vector<std::byte> bytes;
  };
  static Note note_with_room(const PropertyBase& property);

  bool is_last(std::size_t size) const;

  const PropertyBase& property_;
  Note last_;
  std::vector<std::byte> scratch_;
  rt::Ring<Note> ring_;
};

}  // namespace armature::component::internal
