// SPDX-License-Identifier: Apache-2.0
#pragma once

// How the samples of an output port reach a tap.

#include <cstddef>
#include <cstdint>

#include "armature/component/port.hpp"
#include "armature/component/tap.hpp"
#include "armature/rt/ring.hpp"

namespace armature::component::internal {

class PortTapBase : public Tap {
 public:
  /// @param sample  a `Sample` of the port's type
  /// @thread the writer's
  virtual void push(const void* sample) noexcept = 0;

  PortTapBase* next = nullptr;  ///< of those that are attached to a port
};

/// The writer copies its sample, and the reader brings it into its binary form.
template <typename T>
class PortTap final : public PortTapBase {
 public:
  PortTap(std::size_t capacity, std::uint64_t every, const Sample<T>& shape)
      : every_(every), ring_(capacity, rt::WhenFull::kDropNewest, shape) {}

  void push(const void* written) noexcept override {
    const auto& sample = *static_cast<const Sample<T>*>(written);
    if (every_ != 1 && (sample.sequence - 1) % every_ != 0) return;
    if (ring_.push(sample) != rt::PushResult::kTaken) count_dropped();
  }

  bool take(TappedSample& to) override {
    const Sample<T>* const sample = ring_.pop();
    if (sample == nullptr) return false;
    to.time = sample->time;
    to.sequence = sample->sequence;
    to.value.clear();
    types::encode(types::type_of<T>(), &sample->value, to.value);
    return true;
  }

 private:
  const std::uint64_t every_;
  rt::Ring<Sample<T>> ring_;
};

}  // namespace armature::component::internal
