// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/eds.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "armature/base/visible_text.hpp"
#include "drives/canopen/internal/eds_number.hpp"
#include "drives/canopen/internal/ini.hpp"
#include "drives/canopen/little_endian.hpp"

namespace armature::canopen {
namespace {

using internal::IniEntry;
using internal::IniSection;

/// ObjectType of CiA 301, table 42.
constexpr std::int64_t kDomainObject = 0x2;
constexpr std::int64_t kVariable = 0x7;
constexpr std::int64_t kArray = 0x8;
constexpr std::int64_t kRecord = 0x9;
constexpr std::uint8_t kMostSubindex = 0xfe;

std::optional<Access> parse_access(const std::string& text) {
  const std::string lower = internal::lower_case(text);
  if (lower == "ro") return Access::kReadOnly;
  if (lower == "wo") return Access::kWriteOnly;
  if (lower == "rw" || lower == "rwr" || lower == "rww") return Access::kReadWrite;
  if (lower == "const") return Access::kConstant;
  return std::nullopt;
}

/// `digits` as a hexadecimal number of at most that many digits.
std::optional<unsigned> parse_hexadecimal(std::string_view digits, std::size_t most) {
  unsigned value = 0;
  if (digits.empty() || digits.size() > most) return std::nullopt;
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

/// From sections to objects; mistakes go to the diagnostics.
class EdsReader {
 public:
  EdsReader(std::string file, NodeId node, base::Diagnostics& diagnostics)
      : file_(std::move(file)), node_(node), diagnostics_(diagnostics) {}

  Eds read(const std::vector<IniSection>& sections) {
    for (const IniSection& section : sections) by_name_[section.name] = &section;
    read_commissioning();
    read_device_info();
    for (const IniSection& section : sections) {
      if (const auto index = parse_hexadecimal(section.name, 4)) {
        read_object(static_cast<std::uint16_t>(*index), section);
      }
    }
    for (const char* list : {"mandatoryobjects", "optionalobjects", "manufacturerobjects"}) {
      check_list(list);
    }
    return std::move(eds_);
  }

 private:
  const IniSection* section(const std::string& name) const {
    const auto found = by_name_.find(name);
    return found == by_name_.end() ? nullptr : found->second;
  }
  void error(int line, const std::string& what, const char* hint = "") {
    diagnostics_.error({file_, line, 0}, what, std::string(hint));
  }

  std::optional<std::int64_t> number(const IniSection& section, const char* key) {
    const IniEntry* const entry = section.find(key);
    if (entry == nullptr || entry->value.empty()) return std::nullopt;
    const auto value = internal::parse_eds_number(entry->value, node_);
    if (value) return value.value();
    error(entry->line, "[" + base::visible_text(section.name) + "] " + key + ": " + value.error());
    return std::nullopt;
  }
  static std::string text(const IniSection& section, const char* key) {
    const IniEntry* const entry = section.find(key);
    return entry == nullptr ? std::string() : entry->value;
  }

  void read_commissioning() {
    // CiA 306 itself spells it with one m.
    const IniSection* found = section("devicecomissioning");
    if (found == nullptr) found = section("devicecommissioning");
    if (found == nullptr) return;
    const auto value = number(*found, "nodeid");
    if (!value) return;
    if (*value < 1 || *value > kLastNode) {
      error(found->line, "NodeID is " + std::to_string(*value) + ", expected 1 to 127");
      return;
    }
    eds_.node = node_ = static_cast<NodeId>(*value);
  }

  void read_device_info() {
    const IniSection* const found = section("deviceinfo");
    if (found == nullptr) return;
    eds_.vendor_name = text(*found, "vendorname");
    eds_.product_name = text(*found, "productname");
    eds_.identity.vendor = static_cast<std::uint32_t>(number(*found, "vendornumber").value_or(0));
    eds_.identity.product = static_cast<std::uint32_t>(number(*found, "productnumber").value_or(0));
    eds_.identity.revision =
        static_cast<std::uint32_t>(number(*found, "revisionnumber").value_or(0));
  }

  void read_object(std::uint16_t index, const IniSection& found) {
    indices_.insert(index);
    const std::int64_t kind = number(found, "objecttype").value_or(kVariable);
    const auto compact = number(found, "compactsubobj");
    if (compact && *compact != 0) {
      read_compact(index, found, *compact);
    } else if (kind == kVariable || kind == kDomainObject) {
      add({index, 0}, found, kind == kDomainObject ? DataType::kDomain : DataType::kUnsigned32);
    } else if (kind == kArray || kind == kRecord) {
      read_subobjects(index, found);
    }
    // Other kinds (DEFTYPE, DEFSTRUCT, NULL) hold no values.
  }

  void read_subobjects(std::uint16_t index, const IniSection& found) {
    const auto count = number(found, "subnumber");
    std::int64_t seen = 0;
    for (unsigned sub = 0; sub <= 0xff; ++sub) {
      const IniSection* const one = section(sub_name(found.name, sub));
      if (one == nullptr) continue;
      ++seen;
      add({index, static_cast<std::uint8_t>(sub)}, *one, DataType::kUnsigned8);
    }
    if (count && *count != seen) {
      error(found.line,
            "[" + base::visible_text(found.name) + "] SubNumber is " + std::to_string(*count) +
                ", and there are " + std::to_string(seen) + " sections such as [" +
                sub_name(base::visible_text(found.name), 1) + "]",
            "count subindex 0, too");
    }
  }

  static std::string sub_name(const std::string& object, unsigned sub) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string name = object + "sub";
    if (sub > 0xf) name += kDigits[sub >> 4];
    return name + kDigits[sub & 0xfu];
  }

  /// An array whose elements are alike, and their own names and values where they have some.
  void read_compact(std::uint16_t index, const IniSection& found, std::int64_t count) {
    if (count < 1 || count > kMostSubindex) {
      error(found.line, "[" + base::visible_text(found.name) + "] CompactSubObj is " +
                            std::to_string(count) + ", expected 1 to 254");
      return;
    }
    const auto element = object_of(found, DataType::kUnsigned32);
    if (!element) return;
    eds_.objects[{index, 0}] = {.name = "NrOfObjects",
                                .type = DataType::kUnsigned8,
                                .access = Access::kReadOnly,
                                .value = count};
    const IniSection* const names = section(found.name + "name");
    const IniSection* const values = section(found.name + "value");
    for (std::int64_t sub = 1; sub <= count; ++sub) {
      EdsObject object = *element;
      object.name += std::to_string(sub);
      const std::string key = std::to_string(sub);
      if (names != nullptr && names->find(key) != nullptr) object.name = names->find(key)->value;
      if (values != nullptr) set_value(object, *values, key.c_str());
      eds_.objects[{index, static_cast<std::uint8_t>(sub)}] = std::move(object);
    }
  }

  void add(Address address, const IniSection& found, DataType otherwise) {
    if (auto object = object_of(found, otherwise)) eds_.objects[address] = std::move(*object);
  }

  std::optional<EdsObject> object_of(const IniSection& found, DataType otherwise) {
    EdsObject object{.name = text(found, "parametername")};
    if (!set_type(object, found, otherwise)) return std::nullopt;
    set_access(object, found);
    object.mappable = number(found, "pdomapping").value_or(0) != 0;
    set_value(object, found, "defaultvalue");
    set_value(object, found, "parametervalue");
    if (bits_of(object.type) > 0 && !is_real(object.type)) {
      object.low = number(found, "lowlimit");
      object.high = number(found, "highlimit");
    }
    return object;
  }

  bool set_type(EdsObject& object, const IniSection& found, DataType otherwise) {
    object.type = otherwise;
    const auto type = number(found, "datatype");
    if (!type) return true;
    if (*type < 0 || *type > 0xffff || !is_data_type(static_cast<std::uint32_t>(*type))) {
      // 0x20 and more are structures, which have no value of their own.
      if (*type >= 0x20 && *type <= 0xffff) return false;
      error(found.find("datatype")->line,
            "[" + base::visible_text(found.name) + "] DataType is " + std::to_string(*type) +
                ", which CiA 301 does not have",
            "0x0007 is UNSIGNED32");
      return false;
    }
    object.type = static_cast<DataType>(*type);
    return true;
  }

  void set_access(EdsObject& object, const IniSection& found) {
    const IniEntry* const entry = found.find("accesstype");
    if (entry == nullptr) return;
    const auto access = parse_access(entry->value);
    if (access) {
      object.access = *access;
      return;
    }
    error(entry->line, "[" + base::visible_text(found.name) + "] AccessType is '" +
                           base::visible_text(entry->value) +
                           "', expected ro, wo, rw, rwr, rww or const");
  }

  void set_value(EdsObject& object, const IniSection& found, const char* key) {
    const IniEntry* const entry = found.find(key);
    if (entry == nullptr || entry->value.empty()) return;
    if (bits_of(object.type) == 0 || is_real(object.type)) {
      object.text = entry->value;
      return;
    }
    const auto value = number(found, key);
    if (!value) return;
    if (fits(object.type, *value)) {
      object.value = value;
    } else {
      error(entry->line, "[" + base::visible_text(found.name) + "] " + key + " is " +
                             base::visible_text(entry->value) + ", which is no " +
                             to_text(object.type));
    }
  }

  /// Negative numbers are often written by their bits, and the other way round.
  static bool fits(DataType type, std::int64_t value) {
    const unsigned bits = bits_of(type);
    if (bits >= 64) return true;
    const auto raw = static_cast<std::uint64_t>(value);
    return raw <= low_bits(bits) || (is_signed(type) && sign_extended(raw, bits) == value);
  }

  void check_list(const char* name) {
    const IniSection* const list = section(name);
    if (list == nullptr) return;
    for (const IniEntry& entry : list->entries) {
      if (entry.key == "supportedobjects") continue;
      const auto index = internal::parse_eds_number(entry.value, node_);
      if (!index) {
        error(entry.line, std::string("[") + name + "]: " + index.error());
      } else if (index.value() < 0 || index.value() > 0xffff ||
                 !indices_.contains(static_cast<std::uint16_t>(index.value()))) {
        error(entry.line,
              std::string("[") + name + "] lists " + base::visible_text(entry.value) +
                  ", which has no section",
              "describe it in a section with its index as name");
      }
    }
  }

  const std::string file_;
  NodeId node_;
  base::Diagnostics& diagnostics_;
  std::map<std::string, const IniSection*> by_name_;
  std::set<std::uint16_t> indices_;
  Eds eds_;
};

}  // namespace

const EdsObject* Eds::find(Address address) const {
  const auto found = objects.find(address);
  return found == objects.end() ? nullptr : &found->second;
}

std::optional<Eds> parse_eds(std::string_view text, const std::string& file, NodeId node,
                             base::Diagnostics& diagnostics) {
  base::Diagnostics own;
  const auto sections = internal::parse_ini(text, file, own);
  Eds eds = EdsReader(file, node, own).read(sections);
  if (own.ok() && eds.objects.empty()) {
    own.error({file, 0, 0}, "the file describes no objects", "expected sections such as [1000]");
  }
  diagnostics.append(own);
  if (!own.ok()) return std::nullopt;
  return eds;
}

}  // namespace armature::canopen
