// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/cycle_pdos.hpp"

#include <array>
#include <cstdio>
#include <utility>

#include "drives/cia402/drive_settings.hpp"
#include "drives/cia402/objects.hpp"

namespace armature::cia402 {
namespace {

using canopen::Pdo;
using canopen::PdoDirection;

/// The errors of one drive against its EDS.
class EdsCheck {
 public:
  EdsCheck(const canopen::Eds& eds, const std::string& file, const DriveWish& wish,
           base::Diagnostics& diagnostics)
      : eds_(eds), file_(file), wish_(wish), diagnostics_(diagnostics) {}

  void compare_identity() {
    if (!wish_.identity) return;
    compare("vendor", wish_.identity->vendor, eds_.identity.vendor);
    compare("product", wish_.identity->product, eds_.identity.product);
    compare("revision", wish_.identity->revision, eds_.identity.revision);
  }

  void compare_mode() {
    const canopen::EdsObject* const supported = eds_.find(object::kSupportedModes);
    // Many files leave it to the drive.
    if (supported == nullptr || !supported->value || *supported->value == 0) return;
    const auto modes = static_cast<std::uint32_t>(*supported->value);
    compare_mode(modes, wish_.mode);
    if (wish_.homing) compare_mode(modes, Mode::kHoming);
  }

  /// What is written at the start has to be within the limits that the file has.
  void compare_settings() {
    const auto settings = settings_of(wish_);
    if (!settings) return error(settings.error(), "");
    for (const Setting& setting : settings.value()) {
      const canopen::EdsObject* const found = eds_.find(setting.address);
      if (found == nullptr) continue;
      const bool low = found->low && setting.value < *found->low;
      const bool high = found->high && setting.value > *found->high;
      if (!low && !high) continue;
      error("object " + to_text(setting.address) + " '" + found->name + "' would be " +
                std::to_string(setting.value) + ", and its " + (low ? "least" : "greatest") +
                " value is " + std::to_string(low ? *found->low : *found->high),
            "choose another period, heartbeat or mode");
    }
  }

  void compare_objects(const std::vector<Pdo>& pdos, PdoDirection direction) {
    for (const Pdo& pdo : pdos) {
      for (const canopen::MappedObject& mapped : pdo.objects) compare_object(mapped, direction);
    }
  }

 private:
  void compare_mode(std::uint32_t modes, Mode wanted) {
    if ((modes & supported_bit(wanted)) != 0) return;
    error("object 0x6502:00 has no mode " + std::string(to_text(wanted)),
          "it has: " + supported_text(modes));
  }
  void error(const std::string& what, const std::string& hint) {
    diagnostics_.error({file_, 0, 0}, "drive '" + wish_.name + "': " + what, hint);
  }

  void compare(const char* what, std::uint32_t wanted, std::uint32_t found) {
    if (wanted == 0 || found == 0 || wanted == found) return;
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "%s is 0x%X, expected 0x%X", what, found, wanted);
    error(text.data(), "give the EDS of this drive");
  }

  void compare_object(const canopen::MappedObject& mapped, PdoDirection direction) {
    const canopen::EdsObject* const found = eds_.find(mapped.address);
    const std::string name = "object " + to_text(mapped.address);
    if (found == nullptr) {
      error(name + " is missing, and each cycle needs it", "choose another mode");
      return;
    }
    if (canopen::bits_of(found->type) != mapped.bits) {
      error(name + " is " + to_text(found->type) + ", expected " + std::to_string(mapped.bits) +
                " bits",
            "compare the file with the drive's manual");
    }
    const bool reaches =
        direction == PdoDirection::kReceive ? may_write(found->access) : may_read(found->access);
    if (found->mappable && reaches) return;
    error(name + " cannot be mapped to a " + to_text(direction), "choose another mode");
  }

  const canopen::Eds& eds_;
  const std::string& file_;
  const DriveWish& wish_;
  base::Diagnostics& diagnostics_;
};

}  // namespace

std::vector<Pdo> receive_pdos(const DriveWish& wish) {
  Pdo pdo{.cob_id = canopen::cob_id::receive_pdo(1, wish.node),
          .valid = true,
          .transmission = canopen::transmission::kAtEverySync,
          .objects = {{object::kControlWord, 16}}};
  switch (wish.mode) {
    case Mode::kCyclicVelocity:
      pdo.objects.push_back({object::kTargetVelocity, 32});
      break;
    case Mode::kCyclicTorque:
      pdo.objects.push_back({object::kTargetTorque, 16});
      break;
    default:
      pdo.objects.push_back({object::kTargetPosition, 32});
      break;
  }
  if (wish.homing) pdo.objects.push_back({object::kMode, 8});
  return {pdo};
}

std::vector<Pdo> transmit_pdos(const DriveWish& wish) {
  std::vector<Pdo> pdos = {
      {.cob_id = canopen::cob_id::transmit_pdo(1, wish.node),
       .valid = true,
       .transmission = canopen::transmission::kAtEverySync,
       .objects = {{object::kStatusWord, 16}, {object::kPosition, 32}, {object::kTorque, 16}}}};
  if (wish.with_velocity) {
    pdos.push_back({.cob_id = canopen::cob_id::transmit_pdo(2, wish.node),
                    .valid = true,
                    .transmission = canopen::transmission::kAtEverySync,
                    .objects = {{object::kVelocity, 32}, {object::kErrorCode, 16}}});
  }
  return pdos;
}

bool check_eds(const canopen::Eds& eds, const std::string& file, const DriveWish& wish,
               base::Diagnostics& diagnostics) {
  base::Diagnostics own;
  EdsCheck check(eds, file, wish, own);
  check.compare_identity();
  check.compare_mode();
  check.compare_settings();
  check.compare_objects(receive_pdos(wish), PdoDirection::kReceive);
  check.compare_objects(transmit_pdos(wish), PdoDirection::kTransmit);
  diagnostics.append(own);
  return own.ok();
}

}  // namespace armature::cia402
