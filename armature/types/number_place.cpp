// SPDX-License-Identifier: Apache-2.0
#include "armature/types/number_place.hpp"

#include <cstring>
#include <limits>

#include "armature/types/elements.hpp"

namespace armature::types {

/// Walks through a value and notes each number that it comes to.
class NumberPlace::Finder {
 public:
  void visit(const Type& type, const void* value) {
    if (is_list(type)) return visit_elements(type, value);
    if (is_text(type)) return;
    if (type.kind != Kind::kStruct) return add(type);
    for (const Field& field : type.fields) {
      const NumberPlace before = here_;
      here_.offset_ += field.offset;
      here_.path_ += "." + std::string(field.name);
      visit(*field.type, at_offset(value, field.offset));
      here_ = before;
    }
  }

  std::vector<NumberPlace> take() { return std::move(found_); }

 private:
  void visit_elements(const Type& type, const void* value) {
    const std::size_t count = element_count(type, value);
    for (std::size_t i = 0; i < count; ++i) {
      const NumberPlace before = here_;
      if (type.kind == Kind::kVector) {
        here_.hops_.push_back({here_.offset_, &type, i});
        here_.offset_ = 0;
      } else {
        here_.offset_ += i * type.element->size;
      }
      here_.path_ += "[" + std::to_string(i + 1) + "]";
      visit(*type.element, elements(type, value) + i * type.element->size);
      here_ = before;
    }
  }

  void add(const Type& scalar) {
    here_.scalar_ = &scalar;
    found_.push_back(here_);
  }

  NumberPlace here_;
  std::vector<NumberPlace> found_;
};

std::vector<NumberPlace> NumberPlace::all_in(const Type& type, const void* value) {
  Finder finder;
  finder.visit(type, value);
  return finder.take();
}

double NumberPlace::read(const void* value) const noexcept {
  if (hops_.empty() && scalar_->kind == Kind::kDouble) {  // nearly all
    return *static_cast<const double*>(at_offset(value, offset_));
  }
  const void* at = value;
  for (const Hop& hop : hops_) {
    const void* const vector = at_offset(at, hop.offset);
    if (hop.index >= hop.vector->vector_size(vector)) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    at = elements(*hop.vector, vector) + hop.index * hop.vector->element->size;
  }
  at = at_offset(at, offset_);
  const Type& type = scalar_->kind == Kind::kEnum ? *scalar_->underlying : *scalar_;
  return with_scalar(type.kind, [at]<typename T>(std::type_identity<T>) {
    T number;
    std::memcpy(&number, at, sizeof number);
    return static_cast<double>(number);
  });
}

}  // namespace armature::types
