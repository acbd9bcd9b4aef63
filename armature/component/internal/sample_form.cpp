// SPDX-License-Identifier: Apache-2.0
#include "armature/component/internal/sample_form.hpp"

#include <algorithm>
#include <new>

namespace armature::component::internal {

namespace {

constexpr std::size_t round_up_to(std::size_t size, std::size_t alignment) {
  return (size + alignment - 1) / alignment * alignment;
}

constexpr std::size_t time_behind(std::size_t value_size) {
  return round_up_to(value_size, alignof(base::Time));
}

template <typename T>
constexpr bool is_laid_out_like() {
  return offsetof(Sample<T>, time) == time_behind(sizeof(T)) &&
         offsetof(Sample<T>, sequence) == time_behind(sizeof(T)) + sizeof(base::Time);
}
static_assert(is_laid_out_like<char>() && is_laid_out_like<double>());
static_assert(is_laid_out_like<std::array<char, 9>>() && is_laid_out_like<long double>());
static_assert(sizeof(SmallSample<2>) == sizeof(Sample<std::array<char, 9>>));

}  // namespace

SampleForm::SampleForm(const types::Type& type) : type_(&type), time_at_(time_behind(type.size)) {}

std::size_t SampleForm::alignment() const {
  return std::max(type_->alignment, alignof(base::Time));
}

std::size_t SampleForm::size() const {
  return round_up_to(time_at_ + sizeof(base::Time) + sizeof(std::uint64_t), alignment());
}

AnySample::AnySample(const SampleForm& form)
    : form_(form), storage_(::operator new(form.size(), std::align_val_t(form.alignment()))) {
  form.type().construct(storage_);
  form.time(storage_) = {};
  form.sequence(storage_) = 0;
}

AnySample::AnySample(const AnySample& other) : AnySample(other.form_) { copy_from(other.storage_); }

AnySample::AnySample(AnySample&& other) noexcept
    : form_(other.form_), owns_(other.owns_), storage_(std::exchange(other.storage_, nullptr)) {}

AnySample& AnySample::operator=(const AnySample& other) {
  copy_from(other.storage_);
  return *this;
}

AnySample& AnySample::operator=(AnySample&& other) noexcept {
  std::swap(form_, other.form_);
  std::swap(owns_, other.owns_);
  std::swap(storage_, other.storage_);
  return *this;
}

AnySample::~AnySample() {
  if (!owns_ || storage_ == nullptr) return;
  form_.type().destroy(storage_);
  ::operator delete(storage_, std::align_val_t(form_.alignment()));
}

AnySample AnySample::of_value(const SampleForm& form, const void* value) {
  AnySample sample(form);
  form.type().assign(sample.storage_, value);
  return sample;
}

void AnySample::copy_from(const void* sample) {
  form_.type().assign(storage_, sample);
  form_.time(storage_) = form_.time(sample);
  form_.sequence(storage_) = form_.sequence(sample);
}

}  // namespace armature::component::internal
