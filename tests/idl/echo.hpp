// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "everything_service.hpp"

namespace armature::idl {

/// Gives everything back.
class Echo final : public everything::EchoService {
 public:
  bool echo_bool(bool value) override { return value; }
  std::int8_t echo_char(std::int8_t value) override { return value; }
  std::uint8_t echo_byte(std::uint8_t value) override { return value; }
  std::int16_t echo_short(std::int16_t value) override { return value; }
  std::uint16_t echo_unsigned_short(std::uint16_t value) override { return value; }
  std::int32_t echo_int(std::int32_t value) override { return value; }
  std::uint32_t echo_unsigned_int(std::uint32_t value) override { return value; }
  std::int64_t echo_long(std::int64_t value) override { return value; }
  std::uint64_t echo_unsigned_long(std::uint64_t value) override { return value; }
  float echo_float(float value) override { return value; }
  double echo_double(double value) override { return value; }
  std::string echo_string(const std::string& value) override { return value; }
  everything::Singles echo_singles(const everything::Singles& value) override { return value; }
  everything::Lists echo_lists(const everything::Lists& value) override { return value; }
  everything::Fixed echo_fixed(const everything::Fixed& value) override { return value; }
  everything::Ranges echo_ranges(const everything::Ranges& value) override { return value; }
  ride::Flags echo_flags(const ride::Flags& value) override { return value; }
  std::array<bool, 2> echo_two_flags(const std::array<bool, 2>& value) override { return value; }
  std::vector<std::string> echo_strings(const std::vector<std::string>& value) override {
    return value;
  }
  std::vector<everything::Inner> echo_inners(const std::vector<everything::Inner>& value) override {
    return value;
  }
  std::vector<everything::Ranges> echo_ranged(const std::vector<everything::Ranges>& value,
                                              const std::vector<std::uint8_t>& small) override {
    return {value.begin(), value.begin() + static_cast<std::ptrdiff_t>(small.size())};
  }
  everything::Mode echo_mode(everything::Mode value) override { return value; }
  geometry::Frame echo_frame(geometry::Frame frame) override {
    return answered_frame.value_or(frame);
  }
  everything::Choices echo_choices(const everything::Choices& value) override { return value; }
  std::vector<everything::Mode> echo_modes(const std::vector<everything::Mode>& value) override {
    return value;
  }
  std::array<everything::Small, 2> echo_two(const std::array<everything::Small, 2>& v) override {
    return v;
  }
  using EchoService::raise;
  void change_mode(everything::Mode mode) override { raise(everything::ModeChanged{mode, {}}); }
  std::int32_t delete_(std::int32_t priority_, std::int32_t options_, std::int32_t operation_,
                       std::int32_t d, std::int32_t delete_, std::int32_t a) override {
    return ((((priority_ * 10 + options_) * 10 + operation_) * 10 + d) * 10 + delete_) * 10 + a;
  }
  void request_(const std::string& name, float part) override {
    requested.set_value(name + " " + std::to_string(part));
  }
  void nothing() override { raise(everything::Everything{}); }

  std::optional<geometry::Frame> answered_frame;  ///< instead of the one that is asked about
  std::promise<std::string> requested;
};

}  // namespace armature::idl
