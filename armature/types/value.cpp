// SPDX-License-Identifier: Apache-2.0
#include <new>
#include <utility>

#include "armature/types/type.hpp"

namespace armature::types {

Value::Value(const Type& type)
    : type_(&type), storage_(::operator new (type.size, std::align_val_t{type.alignment})) {
  type.construct(storage_);
}

Value::Value(const Type& type, const void* content) : Value(type) {
  type.assign(storage_, content);
}

Value::Value(const Value& other) : Value(*other.type_, other.storage_) {}

Value::Value(Value&& other) noexcept
    : type_(other.type_), storage_(std::exchange(other.storage_, nullptr)) {}

Value& Value::operator=(Value other) noexcept {
  std::swap(type_, other.type_);
  std::swap(storage_, other.storage_);
  return *this;
}

Value::~Value() {
  if (storage_ == nullptr) return;
  type_->destroy(storage_);
  ::operator delete (storage_, std::align_val_t{type_->alignment});
}

}  // namespace armature::types
