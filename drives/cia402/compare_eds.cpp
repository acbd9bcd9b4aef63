// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/compare_eds.hpp"

#include <array>
#include <cstdio>
#include <set>
#include <utility>

#include "drives/cia402/cycle_pdos.hpp"
#include "drives/cia402/drive_settings.hpp"
#include "drives/cia402/objects.hpp"

namespace armature::cia402 {
namespace {

using canopen::Address;
using canopen::DataType;

std::set<Address> used_objects(const DriveWish& wish) {
  std::set<Address> used = {object::kSupportedModes,    object::kRatedTorque, object::kRatedCurrent,
                            object::kEncoderIncrements, object::kGearMotor,   object::kFeed};
  for (const auto& pdos : {receive_pdos(wish), transmit_pdos(wish)}) {
    for (const canopen::Pdo& pdo : pdos) {
      for (const canopen::MappedObject& mapped : pdo.objects) used.insert(mapped.address);
    }
  }
  if (const auto settings = settings_of(wish)) {
    for (const Setting& setting : settings.value()) used.insert(setting.address);
  }
  return used;
}

std::string number_text(std::int64_t number) {
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "0x%llX", static_cast<unsigned long long>(number));
  return text.data();
}

/// A drive beside its file.
class EdsComparison {
 public:
  EdsComparison(canopen::SdoChannel& channel, const canopen::Eds& eds, const std::string& file,
                const DriveWish& wish, base::Diagnostics& diagnostics)
      : channel_(channel), eds_(eds), file_(file), wish_(wish), diagnostics_(diagnostics) {}

  void compare_identity() {
    const std::array<std::pair<const char*, std::uint32_t>, 3> numbers = {
        {{"vendor", eds_.identity.vendor},
         {"product", eds_.identity.product},
         {"revision", eds_.identity.revision}}};
    for (std::uint8_t i = 0; i < numbers.size(); ++i) {
      const auto& [what, expected] = numbers[i];
      if (expected == 0) continue;
      const Address address{0x1018, static_cast<std::uint8_t>(i + 1)};
      const auto found = channel_.read(address, DataType::kUnsigned32);
      if (found && found.value() == expected) continue;
      error(std::string(what) + " " + to_text(address) + " is " +
            (found ? number_text(found.value()) : "not told") + ", and its EDS says " +
            number_text(expected));
    }
  }

  void compare_objects() {
    for (const Address address : used_objects(wish_)) {
      const canopen::EdsObject* const expected = eds_.find(address);
      if (expected == nullptr || !may_read(expected->access)) continue;
      const auto found = channel_.upload(address);
      const unsigned bytes = canopen::bytes_of_bits(canopen::bits_of(expected->type));
      if (!found) {
        error("object " + to_text(address) + " '" + expected->name +
              "' is in its EDS, and the drive does not have it");
      } else if (bytes != 0 && found.value().size() != bytes) {
        error("object " + to_text(address) + " '" + expected->name + "' has " +
              std::to_string(found.value().size()) + " bytes, and its EDS says " +
              to_text(expected->type));
      }
    }
  }

 private:
  void error(const std::string& what) {
    diagnostics_.error(
        {file_, 0, 0},
        "drive '" + wish_.name + "', node " + std::to_string(wish_.node) + ": " + what,
        std::string("give the EDS of this drive and of its firmware"));
  }

  canopen::SdoChannel& channel_;
  const canopen::Eds& eds_;
  const std::string& file_;
  const DriveWish& wish_;
  base::Diagnostics& diagnostics_;
};

}  // namespace

bool compare_with_eds(canopen::SdoChannel& channel, const canopen::Eds& eds,
                      const std::string& file, const DriveWish& wish,
                      base::Diagnostics& diagnostics) {
  base::Diagnostics own;
  EdsComparison comparison(channel, eds, file, wish, own);
  comparison.compare_identity();
  if (own.ok()) comparison.compare_objects();
  diagnostics.append(own);
  return own.ok();
}

}  // namespace armature::cia402
