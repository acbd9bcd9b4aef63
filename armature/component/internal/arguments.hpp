// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "armature/component/operations/signature.hpp"
#include "armature/types/type.hpp"

namespace armature::component::internal {

/// The arguments of a call or an event on their way to another thread; of any signature.
class Arguments {
 public:
  Arguments() = default;
  /// Default values.
  explicit Arguments(const Signature& signature);

  /// Copies what is at `places`, as the signature describes it.
  /// @rt nonblocking; allocates only to make room for larger vectors than it ever had
  void assign(const void* const* places);

  /// Where the values are.
  const void* const* places() const { return places_.data(); }

 private:
  std::vector<types::Value> values_;
  std::vector<const void*> places_;
};

}  // namespace armature::component::internal
