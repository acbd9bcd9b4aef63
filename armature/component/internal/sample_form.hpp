// SPDX-License-Identifier: Apache-2.0
#pragma once

// Samples of types that are known by their descriptions: ports and channels are compiled once, not
// for each type.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "armature/base/time.hpp"
#include "armature/component/ports/port.hpp"
#include "armature/types/type.hpp"

namespace armature::component::internal {

/// Where in a `Sample<T>` is what.
class SampleForm {
 public:
  explicit SampleForm(const types::Type& type);

  const types::Type& type() const { return *type_; }
  std::size_t size() const;
  std::size_t alignment() const;

  /// @param sample  a `Sample` of the type; its value comes first
  base::Time& time(void* sample) const { return *at<base::Time>(sample, time_at_); }
  base::Time time(const void* sample) const { return *at<const base::Time>(sample, time_at_); }
  std::uint64_t& sequence(void* sample) const {
    return *at<std::uint64_t>(sample, time_at_ + sizeof(base::Time));
  }
  std::uint64_t sequence(const void* sample) const {
    return *at<const std::uint64_t>(sample, time_at_ + sizeof(base::Time));
  }

 private:
  template <typename What, typename Sample>
  static What* at(Sample* sample, std::size_t offset) {
    using Byte = std::conditional_t<std::is_const_v<Sample>, const std::byte, std::byte>;
    return reinterpret_cast<What*>(static_cast<Byte*>(sample) + offset);
  }

  const types::Type* type_;
  std::size_t time_at_;
};

/// A sample of any type, which owns its storage or, made by `view`, looks at somebody's.
class AnySample {
 public:
  /// The type's default value, never written.
  explicit AnySample(const SampleForm& form);
  AnySample(const AnySample& other);
  AnySample(AnySample&& other) noexcept;
  /// Allocates only if assigning a value of this shape does.
  AnySample& operator=(const AnySample& other);
  AnySample& operator=(AnySample&& other) noexcept;
  ~AnySample();

  /// Const, so that whatever keeps it makes a copy.
  static const AnySample view(const SampleForm& form, const void* sample) {  // NOLINT
    return {form, sample};
  }
  /// `value`, never written.
  static AnySample of_value(const SampleForm& form, const void* value);

  void* get() { return storage_; }
  const void* get() const { return storage_; }

 private:
  AnySample(const SampleForm& form, const void* sample)
      : form_(form), owns_(false), storage_(const_cast<void*>(sample)) {}
  void copy_from(const void* sample);

  SampleForm form_;
  bool owns_ = true;
  void* storage_;
};

/// The sample of a type that can be copied as bytes and has so many words of eight.
template <std::size_t Words>
struct SmallSample {
  alignas(8) std::array<std::byte, 8 * Words> value{};
  base::Time time{};
  std::uint64_t sequence = 0;

  static const SmallSample& view(const SampleForm&, const void* sample) {
    return *static_cast<const SmallSample*>(sample);
  }
  static SmallSample of_value(const SampleForm& form, const void* value) {
    SmallSample sample;
    std::memcpy(sample.value.data(), value, form.type().size);
    return sample;
  }
  const void* get() const { return this; }
};

inline constexpr std::size_t kMostWords = 256 / 8;

/// Calls `make.template operator()<S>()` with the S that carries samples of a port: a small one of
/// the right size, so that copying is a few instructions, else AnySample.
template <typename Result, typename Make>
Result with_sample_of(const SampleForm& form, bool is_small, const Make& make) {
  using Case = Result (*)(const Make&);
  static constexpr auto kCases = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array<Case, sizeof...(I)>{[](const Make& chosen) -> Result {
      return chosen.template operator()<SmallSample<I + 1>>();
    }...};
  }
  (std::make_index_sequence<kMostWords>{});
  if (!is_small) return make.template operator()<AnySample>();
  return kCases[(form.type().size + 7) / 8 - 1](make);
}

}  // namespace armature::component::internal
