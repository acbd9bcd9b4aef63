// SPDX-License-Identifier: Apache-2.0
#include "armature/component/internal/arguments.hpp"

#include <algorithm>
#include <new>
#include <utility>

namespace armature::component::internal {
namespace {

/// Where a value of the type begins that comes after `end` bytes.
std::size_t begin_after(std::size_t end, const types::Type& type) {
  return (end + type.alignment - 1) / type.alignment * type.alignment;
}

}  // namespace

Arguments::Arguments(const Signature& signature)
    : arguments_(signature.arguments.size()), has_result_(signature.result != nullptr) {
  if (slots() == 0) return;
  const std::size_t values_begin = slots() * sizeof(Slot) + arguments_ * sizeof(void*);
  std::size_t size = values_begin;
  const auto make_room = [&](const types::Type& type) {
    size = begin_after(size, type) + type.size;
    alignment_ = std::max(alignment_, type.alignment);
  };
  for (const Signature::Argument& argument : signature.arguments) make_room(*argument.type);
  if (has_result_) make_room(*signature.result);

  memory_ = static_cast<Slot*>(::operator new(size, std::align_val_t(alignment_)));
  std::size_t offset = values_begin;
  for (std::size_t i = 0; i < arguments_; ++i) place(*signature.arguments[i].type, i, offset);
  if (has_result_) place(*signature.result, arguments_, offset);
  auto* const where = reinterpret_cast<const void**>(memory_ + slots());
  for (std::size_t i = 0; i < arguments_; ++i) where[i] = memory_[i].value;
}

void Arguments::place(const types::Type& type, std::size_t slot, std::size_t& offset) {
  offset = begin_after(offset, type);
  void* const value = reinterpret_cast<std::byte*>(memory_) + offset;
  type.construct(value);
  memory_[slot] = {&type, value};
  offset += type.size;
}

Arguments::Arguments(Arguments&& other) noexcept
    : arguments_(std::exchange(other.arguments_, 0)),
      has_result_(std::exchange(other.has_result_, false)),
      alignment_(other.alignment_),
      memory_(std::exchange(other.memory_, nullptr)) {}

Arguments& Arguments::operator=(Arguments&& other) noexcept {
  std::swap(arguments_, other.arguments_);
  std::swap(has_result_, other.has_result_);
  std::swap(alignment_, other.alignment_);
  std::swap(memory_, other.memory_);
  return *this;
}

Arguments::~Arguments() {
  if (memory_ == nullptr) return;
  for (std::size_t i = 0; i < slots(); ++i) memory_[i].type->destroy(memory_[i].value);
  ::operator delete(memory_, std::align_val_t(alignment_));
}

void Arguments::assign(const void* const* places) {
  for (std::size_t i = 0; i < arguments_; ++i) memory_[i].type->assign(memory_[i].value, places[i]);
}

const void* const* Arguments::places() const {
  return reinterpret_cast<const void* const*>(memory_ + slots());
}

void* Arguments::result() const { return has_result_ ? memory_[arguments_].value : nullptr; }

}  // namespace armature::component::internal
