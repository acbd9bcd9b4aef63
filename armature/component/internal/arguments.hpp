// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "armature/component/operations/signature.hpp"
#include "armature/types/type.hpp"

namespace armature::component::internal {

/// The arguments of a call or an event on their way to another thread, and what comes back; of any
/// signature. All values lie in one piece of memory: a component has many of these.
class Arguments {
 public:
  Arguments() = default;
  /// Default values.
  explicit Arguments(const Signature& signature);
  Arguments(Arguments&& other) noexcept;
  Arguments& operator=(Arguments&& other) noexcept;
  ~Arguments();

  /// Copies what is at `places`, as the signature describes it.
  /// @rt nonblocking; allocates only to make room for larger vectors than it ever had
  void assign(const void* const* places);

  /// Where the values are.
  const void* const* places() const;

  /// Where the result is to go; nullptr if the signature has none.
  void* result() const;

 private:
  /// A value in the piece of memory. Descriptions of types outlive every operation.
  struct Slot {
    const types::Type* type;
    void* value;
  };
  std::size_t slots() const { return arguments_ + (has_result_ ? 1 : 0); }
  void place(const types::Type& type, std::size_t slot, std::size_t& offset);

  std::size_t arguments_ = 0;
  bool has_result_ = false;
  std::size_t alignment_ = alignof(Slot);
  /// The slots, the result's the last, then `places`, then the values.
  Slot* memory_ = nullptr;
};

}  // namespace armature::component::internal
