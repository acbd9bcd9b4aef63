// SPDX-License-Identifier: Apache-2.0
#include "idl/model.hpp"

#include <algorithm>
#include <utility>

namespace armature::idl {

std::string_view name_of(Basic basic) {
  switch (basic) {
    case Basic::kVoid:
      return "void";
    case Basic::kBool:
      return "bool";
    case Basic::kChar:
      return "char";
    case Basic::kByte:
      return "byte";
    case Basic::kShort:
      return "short";
    case Basic::kUnsignedShort:
      return "unsigned short";
    case Basic::kInt:
      return "int";
    case Basic::kUnsignedInt:
      return "unsigned int";
    case Basic::kLong:
      return "long";
    case Basic::kUnsignedLong:
      return "unsigned long";
    case Basic::kFloat:
      return "float";
    case Basic::kDouble:
      return "double";
    case Basic::kString:
      return "String";
    case Basic::kStruct:
      return "struct";
    case Basic::kEnum:
      return "enum";
  }
  return "void";
}

std::string_view name_of(Access access) {
  switch (access) {
    case Access::kRead:
      return "read";
    case Access::kCommand:
      return "command";
    case Access::kConfigure:
      return "configure";
  }
  return "command";
}

bool is_whole_number(Basic basic) { return basic >= Basic::kChar && basic <= Basic::kUnsignedLong; }

bool is_number(Basic basic) { return basic >= Basic::kChar && basic <= Basic::kDouble; }

std::string to_text(const Type& type) {
  std::string text(name_of(type.basic));
  if (!type.name.empty()) text += " " + type.name;
  if (type.form == Type::Form::kSingle) return text;
  if (type.form == Type::Form::kFixed) text += ", " + std::to_string(type.count);
  return "Array<" + text + ">";
}

const Enumerator& Enumeration::first_value() const {
  const auto found = std::ranges::find(enumerators, Whole{}, &Enumerator::value);
  return found == enumerators.end() ? enumerators.front() : *found;
}

void Program::add(Module module) {
  for (std::size_t i = 0; i < module.structures.size(); ++i) {
    Index& index = module.structures[i].is_event ? events_ : structs_;
    index.emplace(module.structures[i].name, Place{modules_.size(), i});
  }
  for (std::size_t i = 0; i < module.enumerations.size(); ++i) {
    enums_.emplace(module.enumerations[i].name, Place{modules_.size(), i});
  }
  modules_.push_back(std::move(module));
}

const Structure* Program::find(const Index& index, std::string_view name) const {
  const auto found = index.find(name);
  if (found == index.end()) return nullptr;
  return &modules_[found->second.module].structures[found->second.index];
}

const Enumeration* Program::find_enum(std::string_view name) const {
  const auto found = enums_.find(name);
  if (found == enums_.end()) return nullptr;
  return &modules_[found->second.module].enumerations[found->second.index];
}

}  // namespace armature::idl
