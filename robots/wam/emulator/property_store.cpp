// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/property_store.hpp"

namespace armature::wam {

PropertyStore::PropertyStore(PuckKind kind, int version) : kind_(kind), version_(version) {
  for (std::size_t i = 0; i < kProperties; ++i) {
    const auto property = static_cast<Property>(i);
    const std::optional<int> number = number_of(kind_, version_, property);
    numbers_[i] = static_cast<std::int16_t>(number.value_or(-1));
    wide_[i] = is_wide(kind_, version_, property);
    if (number) properties_[static_cast<std::size_t>(*number)] = property;
  }
}

std::optional<Property> PropertyStore::property(int number) const {
  if (number < 0 || number >= static_cast<int>(properties_.size())) return std::nullopt;
  return properties_[static_cast<std::size_t>(number)];
}

Width PropertyStore::width(Property property) const {
  return wide_[index(property)] ? Width::kFour : Width::kTwo;
}

void PropertyStore::set(Property property, std::int32_t value) {
  const bool wide = width(property) == Width::kFour;
  values_[index(property)] = wide ? value : static_cast<std::int16_t>(value);
}

void PropertyStore::set_default(Property property, std::int32_t value) {
  set(property, value);
  defaults_[index(property)] = get(property);
}

void PropertyStore::power_on() {
  values_ = defaults_;
  for (std::size_t i = 0; i < kProperties; ++i) load(i);
}

bool PropertyStore::execute(Property command, std::int32_t number) {
  const std::optional<Property> which = property(number);
  switch (command) {
    case Property::kSave:
      save(number);
      return true;
    case Property::kLoad:
      if (which) load(index(*which));
      return true;
    case Property::kDef:
      if (which) values_[index(*which)] = defaults_[index(*which)];
      return true;
    default:
      return false;
  }
}

void PropertyStore::load(std::size_t index) {
  if (saved_[index]) values_[index] = *saved_[index];
}

void PropertyStore::save(std::int32_t number) {
  for (std::size_t i = 0; i < kProperties; ++i) {
    if (numbers_[i] >= 0 && (number == -1 || number == numbers_[i])) saved_[i] = values_[i];
  }
}

}  // namespace armature::wam
