// SPDX-License-Identifier: Apache-2.0
// EDS files that are written, and dictionaries of devices as EDS.
#include <array>
#include <cstdio>
#include <set>
#include <utility>
#include <vector>

#include "drives/canopen/eds.hpp"
#include "drives/canopen/little_endian.hpp"

namespace armature::canopen {
namespace {

const char* access_text(Access access) {
  switch (access) {
    case Access::kConstant:
      return "const";
    case Access::kReadOnly:
      return "ro";
    case Access::kWriteOnly:
      return "wo";
    case Access::kReadWrite:
      return "rw";
  }
  return "ro";
}

std::string hexadecimal_text(const char* form, unsigned long long number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), form, number);
  return text.data();
}

std::string object_text(const std::string& section, const EdsObject& object) {
  std::string text = "[" + section + "]\nParameterName=" + object.name + "\nObjectType=0x7\n";
  text += "DataType=" + hexadecimal_text("0x%04llX", static_cast<unsigned>(object.type)) + "\n";
  text += "AccessType=" + std::string(access_text(object.access)) + "\n";
  if (object.value) text += "DefaultValue=" + std::to_string(*object.value) + "\n";
  if (!object.text.empty()) text += "DefaultValue=" + object.text + "\n";
  if (object.low) text += "LowLimit=" + std::to_string(*object.low) + "\n";
  if (object.high) text += "HighLimit=" + std::to_string(*object.high) + "\n";
  return text + "PDOMapping=" + (object.mappable ? "1" : "0") + "\n\n";
}

/// The list in which an object belongs.
std::size_t list_of(std::uint16_t index) {
  if (index == 0x1000 || index == 0x1001 || index == 0x1018) return 0;
  return index >= 0x2000 && index < 0x6000 ? 2 : 1;
}

std::string lists_text(const std::set<std::uint16_t>& indices) {
  std::array<std::vector<std::uint16_t>, 3> lists;
  for (const std::uint16_t index : indices) lists[list_of(index)].push_back(index);
  constexpr std::array kNames = {"MandatoryObjects", "OptionalObjects", "ManufacturerObjects"};
  std::string text;
  for (std::size_t i = 0; i < lists.size(); ++i) {
    text += std::string("[") + kNames[i] +
            "]\nSupportedObjects=" + std::to_string(lists[i].size()) + "\n";
    for (std::size_t k = 0; k < lists[i].size(); ++k) {
      text += std::to_string(k + 1) + "=" + hexadecimal_text("0x%04llX", lists[i][k]) + "\n";
    }
    text += "\n";
  }
  return text;
}

}  // namespace

std::string to_text(const Eds& eds) {
  std::string text = "[FileInfo]\nEDSVersion=4.0\n\n[DeviceInfo]\n";
  text += "VendorName=" + eds.vendor_name + "\n";
  text += "VendorNumber=" + hexadecimal_text("0x%08llX", eds.identity.vendor) + "\n";
  text += "ProductName=" + eds.product_name + "\n";
  text += "ProductNumber=" + hexadecimal_text("0x%08llX", eds.identity.product) + "\n";
  text += "RevisionNumber=" + hexadecimal_text("0x%08llX", eds.identity.revision) + "\n\n";
  if (eds.node) {
    text += "[DeviceComissioning]\nNodeID=" + std::to_string(*eds.node) + "\n\n";
  }
  std::map<std::uint16_t, std::vector<std::uint8_t>> subindices;
  std::set<std::uint16_t> indices;
  for (const auto& [address, object] : eds.objects) {
    subindices[address.index].push_back(address.subindex);
    indices.insert(address.index);
  }
  text += lists_text(indices);
  for (const auto& [index, subs] : subindices) {
    const std::string name = hexadecimal_text("%04llX", index);
    if (subs.size() == 1 && subs[0] == 0) {
      text += object_text(name, *eds.find({index, 0}));
      continue;
    }
    text += "[" + name + "]\nParameterName=" + eds.find({index, subs[0]})->name +
            "\nObjectType=0x9\nSubNumber=" + std::to_string(subs.size()) + "\n\n";
    for (const std::uint8_t sub : subs) {
      text += object_text(name + "sub" + hexadecimal_text("%llX", sub), *eds.find({index, sub}));
    }
  }
  return text;
}

Eds describe(const ObjectDictionary& dictionary, std::string vendor_name,
             std::string product_name) {
  Eds eds;
  eds.vendor_name = std::move(vendor_name);
  eds.product_name = std::move(product_name);
  eds.identity.vendor = static_cast<std::uint32_t>(dictionary.number({0x1018, 1}));
  eds.identity.product = static_cast<std::uint32_t>(dictionary.number({0x1018, 2}));
  eds.identity.revision = static_cast<std::uint32_t>(dictionary.number({0x1018, 3}));
  for (const auto& [address, entry] : dictionary.entries()) {
    EdsObject object{.name = entry.info.name,
                     .type = entry.info.type,
                     .access = entry.info.access,
                     .mappable = entry.info.mappable,
                     .low = entry.info.low,
                     .high = entry.info.high};
    if (bits_of(entry.info.type) > 0 && !is_real(entry.info.type)) {
      object.value = dictionary.number(address);
    } else {
      object.text.assign(entry.bytes.begin(), entry.bytes.end());
    }
    eds.objects[address] = std::move(object);
  }
  return eds;
}

void add_objects(const Eds& eds, ObjectDictionary& dictionary) {
  for (const auto& [address, object] : eds.objects) {
    ObjectInfo info{.address = address,
                    .name = object.name,
                    .type = object.type,
                    .access = object.access,
                    .mappable = object.mappable,
                    .low = object.low,
                    .high = object.high};
    if (bits_of(object.type) > 0) {
      dictionary.add(std::move(info));
      dictionary.set_number(address, object.value.value_or(0));
    } else {
      const auto* const bytes = reinterpret_cast<const std::uint8_t*>(object.text.data());
      dictionary.add_bytes(std::move(info), {bytes, object.text.size()});
    }
  }
}

}  // namespace armature::canopen
