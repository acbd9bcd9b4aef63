// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "robots/wam/protocol/puck_properties.hpp"
#include "robots/wam/protocol/puck_protocol.hpp"

namespace armature::wam {

/// The properties that an emulated device keeps: in memory, in its EEPROM, and as its firmware has
/// them by default. Only `PropertyStore` itself takes long; nothing allocates.
class PropertyStore {
 public:
  /// All are 0 by default, and the EEPROM is empty.
  PropertyStore(PuckKind kind, int version);

  std::optional<Property> property(int number) const;
  /// -1 if this firmware has no such property.
  int number(Property property) const { return numbers_[index(property)]; }
  Width width(Property property) const;

  std::int32_t get(Property property) const { return values_[index(property)]; }
  /// In memory; of 16-bit properties the lower 16 bits.
  void set(Property property, std::int32_t value);
  /// The firmware's default, and what is in memory.
  void set_default(Property property, std::int32_t value);

  /// What memory has after power-up: from the EEPROM what is there, else the default.
  void power_on();
  /// A SET of SAVE, LOAD or DEF with the number of a property; -1 saves all.
  /// @return false if it is none of the three
  bool execute(Property command, std::int32_t number);

 private:
  static std::size_t index(Property property) { return static_cast<std::size_t>(property); }
  void load(std::size_t index);
  void save(std::int32_t number);

  const PuckKind kind_;
  const int version_;
  std::array<std::int16_t, kProperties> numbers_{};
  std::array<bool, kProperties> wide_{};
  std::array<std::optional<Property>, 128> properties_;
  std::array<std::int32_t, kProperties> values_{};
  std::array<std::int32_t, kProperties> defaults_{};
  std::array<std::optional<std::int32_t>, kProperties> saved_;
};

}  // namespace armature::wam
