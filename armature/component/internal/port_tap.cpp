// SPDX-License-Identifier: Apache-2.0
#include "armature/component/internal/port_tap.hpp"

#include "armature/component/internal/sample_form.hpp"
#include "armature/rt/ring.hpp"

namespace armature::component::internal {

namespace {

template <typename S>
class RingTap final : public AttachedTap {
 public:
  RingTap(const SampleForm& form, const void* value, std::size_t capacity, std::uint64_t every)
      : form_(form),
        every_(every),
        ring_(capacity, rt::WhenFull::kDropNewest, S::of_value(form, value)) {}

  void push(const void* sample) noexcept override {
    if (every_ != 1 && (form_.sequence(sample) - 1) % every_ != 0) return;
    if (ring_.push(S::view(form_, sample)) != rt::PushResult::kTaken) count_dropped();
  }

  bool take(TappedSample& to) override {
    const S* const found = ring_.pop();
    if (found == nullptr) return false;
    const void* const sample = found->get();
    to.time = form_.time(sample);
    to.sequence = form_.sequence(sample);
    to.value.clear();
    types::encode(form_.type(), sample, to.value);
    return true;
  }

 private:
  const SampleForm form_;
  const std::uint64_t every_;
  rt::Ring<S> ring_;
};

}  // namespace

std::unique_ptr<AttachedTap> make_port_tap(const SampleForm& form, bool is_small, const void* value,
                                           std::size_t capacity, std::uint64_t every) {
  using Made = std::unique_ptr<AttachedTap>;
  return with_sample_of<Made>(form, is_small, [&]<typename S>() -> Made {
    return std::make_unique<RingTap<S>>(form, value, capacity, every);
  });
}

}  // namespace armature::component::internal
