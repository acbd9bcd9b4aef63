// SPDX-License-Identifier: Apache-2.0
#include "armature/component/internal/arguments.hpp"

#include <cstddef>

namespace armature::component::internal {

Arguments::Arguments(const Signature& signature) {
  values_.reserve(signature.arguments.size());
  for (const Signature::Argument& argument : signature.arguments) {
    places_.push_back(values_.emplace_back(*argument.type).data());
  }
}

void Arguments::assign(const void* const* places) {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    values_[i].type().assign(values_[i].data(), places[i]);
  }
}

}  // namespace armature::component::internal
