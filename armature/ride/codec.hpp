// SPDX-License-Identifier: Apache-2.0
#pragma once

// The bodies of messages: field after field, little-endian, each aligned relative to the body's
// start (docs/ride.md, "Body"). Structs, events and enums have an `encode` and a `decode` in their
// own namespace, which rcidl writes.

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "armature/base/utf8.hpp"
#include "armature/ride/body.hpp"
#include "armature/ride/memory_share.hpp"

namespace armature::ride {

/// What has a form of fixed size on the wire: `bool`, `char`, integers, `float`, `double`.
template <typename T>
concept Scalar = std::is_arithmetic_v<T> && sizeof(T) <= 8 && !std::is_same_v<T, wchar_t> &&
                 !std::is_same_v<T, char8_t> && !std::is_same_v<T, char16_t> &&
                 !std::is_same_v<T, char32_t>;

namespace internal {

/// 64-bit data too is aligned on 4 bytes.
template <Scalar T>
inline constexpr std::size_t kAlignment = sizeof(T) < 4 ? sizeof(T) : 4;

inline constexpr bool kLittleEndian = std::endian::native == std::endian::little;

constexpr std::size_t padding(std::size_t at, std::size_t alignment) {
  return (alignment - at % alignment) % alignment;
}

template <Scalar T>
void store(std::byte* to, T value) {
  std::memcpy(to, &value, sizeof value);
  if constexpr (!kLittleEndian) std::reverse(to, to + sizeof value);
}

template <Scalar T>
T load(const std::byte* from) {
  std::byte bytes[sizeof(T)];
  std::memcpy(bytes, from, sizeof bytes);
  if constexpr (!kLittleEndian) std::reverse(bytes, bytes + sizeof bytes);
  return std::bit_cast<T>(bytes);
}

/// Of which a sequence in memory is a sequence on the wire. A bool has to be looked at.
template <typename T>
concept Bulk = Scalar<T> && !std::is_same_v<T, bool> && kLittleEndian;

}  // namespace internal

/// Appends fields to a body; its start is where the body ended when the encoder was made.
/// Allocates only where the body is larger than ever before.
/// @rt nonblocking, no allocation once the body has the capacity
/// @thread one at a time
class Encoder {
 public:
  explicit Encoder(Body& body) : body_(&body), start_(body.size()) {}

  template <Scalar T>
  void put(T value) {
    internal::store(aligned(internal::kAlignment<T>, sizeof value), value);
  }
  /// A String: UTF-8 is expected, and checked by who receives it.
  void put(std::string_view text) { put_bytes(text.data(), text.size()); }
  void put(const std::string& text) { put(std::string_view(text)); }
  void put(const char* text) { put(std::string_view(text)); }

  template <typename T>
  void put(const std::vector<T>& elements) {
    put(static_cast<std::uint32_t>(elements.size()));
    put_elements(elements.data(), elements.size());
  }
  template <typename T, std::size_t N>
  void put(const std::array<T, N>& elements) {
    put_elements(elements.data(), N);
  }
  /// An Array<bool>: what is not 0 is sent as 1.
  void put_flags(const std::vector<std::uint8_t>& flags) {
    put(static_cast<std::uint32_t>(flags.size()));
    for (const std::uint8_t flag : flags) put(flag != 0);
  }
  /// All of a body that somebody else has encoded, before anything else: for who hands it on.
  void put_body(std::span<const std::byte> encoded) { body_->append(encoded); }
  /// A struct, event or enum, by its `encode(Encoder&, const S&)`.
  template <typename S>
  requires(std::is_class_v<S> || std::is_enum_v<S>) void put(const S& structure) {
    encode(*this, structure);
  }

 private:
  std::byte* aligned(std::size_t alignment, std::size_t size) {
    const std::size_t gap = internal::padding(body_->size() - start_, alignment);
    std::byte* const to = body_->extend(gap + size);
    for (std::size_t i = 0; i < gap; ++i) to[i] = std::byte{0};
    return to + gap;
  }

  void put_bytes(const void* bytes, std::size_t size) {
    put(static_cast<std::uint32_t>(size));
    body_->append({static_cast<const std::byte*>(bytes), size});
  }

  template <typename T>
  void put_elements(const T* elements, std::size_t count) {
    if constexpr (internal::Bulk<T>) {
      if (count == 0) return;
      std::memcpy(aligned(internal::kAlignment<T>, count * sizeof(T)), elements, count * sizeof(T));
    } else {
      for (std::size_t i = 0; i < count; ++i) put(elements[i]);
    }
  }

  Body* body_;
  std::size_t start_;
};

/// Takes fields from a received body, which it never reads beyond. Every `take` says whether the
/// field was there and valid; after the first that was not, none is.
/// @rt nonblocking; allocates only for a String or Array that has to grow
/// @thread one at a time
class Decoder {
 public:
  /// @param holding  counts what Strings and Arrays take; none: without bound
  explicit Decoder(std::span<const std::byte> body, Holding* holding = nullptr)
      : start_(body.data()), size_(body.size()), at_(0), holding_(holding) {}

  template <Scalar T>
  bool take(T& value) {
    const std::byte* const from = aligned(internal::kAlignment<T>, sizeof value);
    if (from == nullptr) return false;
    if constexpr (std::is_same_v<T, bool>) {
      if (std::to_integer<unsigned>(*from) > 1) return fail();
      value = std::to_integer<unsigned>(*from) != 0;
    } else {
      value = internal::load<T>(from);
    }
    return true;
  }
  /// A String where it lies in the body, as long as that is there.
  bool take(std::string_view& text) {
    lends_ = true;
    return find(text);
  }
  bool take(std::string& text) {
    std::string_view found;
    if (!find(found)) return false;
    hold(found.size());
    text.assign(found);
    return true;
  }
  template <typename T>
  bool take(std::vector<T>& elements) {
    std::uint32_t count = 0;
    if (!take_count(count)) return false;
    if constexpr (internal::Bulk<T>) {
      if (count > remaining() / sizeof(T)) return fail();
      hold(count * sizeof(T));
      elements.resize(count);
      return take_elements(elements.data(), count);
    } else {
      return take_one_by_one(elements, count);
    }
  }
  template <typename T, std::size_t N>
  bool take(std::array<T, N>& elements) {
    return take_elements(elements.data(), N);
  }
  /// An Array<bool>.
  bool take_flags(std::vector<std::uint8_t>& flags) {
    if (!take(flags)) return false;
    return std::ranges::all_of(flags, [](std::uint8_t flag) { return flag <= 1; }) || fail();
  }
  /// All that is left, where it lies, unseen: for who hands it on.
  std::span<const std::byte> take_rest() {
    const std::size_t size = remaining();
    if (size == 0) return {};
    at_ += size;
    return {start_ + at_ - size, size};
  }
  /// A struct, event or enum, by its `decode(Decoder&, S&)`.
  template <typename S>
  requires(std::is_class_v<S> || std::is_enum_v<S>) bool take(S& structure) {
    return decode(*this, structure) || fail();
  }

  /// Counts what a value takes beyond its body, before it is made.
  /// @throws std::bad_alloc  its sender may not take so much
  void hold(std::size_t bytes) {
    if (holding_ != nullptr) holding_->take(bytes);
  }

  /// True if nothing failed and no byte is left over.
  bool ended() const { return at_ == size_; }
  /// For generated code: false if a parameter that was taken is outside its range; then no more is
  /// taken, and `problem` says so. Defined in armature/ride/range.hpp, like the next.
  template <typename T, typename Low, typename High>
  bool expect_within(const char* parameter, const T& value, Low low, High high);
  /// The same of a member.
  /// @param structure  a described struct (ARMATURE_STRUCT) that has it
  template <typename T, typename Low, typename High, typename S>
  bool within(const T& member, Low low, High high, const S& structure);
  /// The same of an enumeration (ARMATURE_ENUM): false if no enumerator has the number that is
  /// taken. Defined in armature/ride/enumeration.hpp.
  template <typename E>
  bool take_enumerator(E& value);
  /// `parameter speed is 2, expected 0 to 1`, or `member Pose.x is ...`; `Mode is 7,
  /// expected off or on`; empty if all that was taken is what it may be.
  const std::string& problem() const { return problem_; }

  /// Whether a value lies in the body, which has to stay there for it.
  bool lends() const { return lends_; }
  /// Bytes that are left; 0 after a failure.
  std::size_t remaining() const { return at_ == kFailed ? 0 : size_ - at_; }

 private:
  static constexpr std::size_t kFailed = static_cast<std::size_t>(-1);

  bool fail() {
    at_ = kFailed;
    return false;
  }

  bool find(std::string_view& text) {
    std::uint32_t size = 0;
    if (!take_count(size)) return false;
    const std::string_view found(reinterpret_cast<const char*>(start_ + at_), size);
    if (!base::is_utf8(found)) return fail();
    at_ += size;
    text = found;
    return true;
  }

  /// Where the next `size` bytes lie; no place if they are not there.
  const std::byte* aligned(std::size_t alignment, std::size_t size) {
    if (at_ == kFailed) return nullptr;
    const std::size_t gap = internal::padding(at_, alignment);
    if (size + gap > size_ - at_) {
      fail();
      return nullptr;
    }
    const std::byte* const from = start_ + at_ + gap;
    at_ += gap + size;
    return from;
  }

  /// A count of what takes a byte or more each.
  bool take_count(std::uint32_t& count) {
    if (!take(count)) return false;
    return count <= remaining() || fail();
  }

  template <typename T>
  bool take_elements(T* elements, std::size_t count) {
    if constexpr (internal::Bulk<T>) {
      if (count == 0) return at_ != kFailed;
      const std::byte* const from = aligned(internal::kAlignment<T>, count * sizeof(T));
      if (from == nullptr) return false;
      std::memcpy(elements, from, count * sizeof(T));
    } else {
      for (std::size_t i = 0; i < count; ++i) {
        if (!take(elements[i])) return false;
      }
    }
    return true;
  }

  /// Memory is asked for as elements are found, so a count that lies costs nothing.
  template <typename T>
  bool take_one_by_one(std::vector<T>& elements, std::uint32_t count) {
    elements.resize(std::min<std::size_t>(elements.size(), count));
    for (std::size_t i = 0; i < count; ++i) {
      if (i == elements.size()) {
        // When it grows, the elements are there twice.
        if (i == elements.capacity()) hold(2 * std::max<std::size_t>(i, 1) * sizeof(T));
        elements.emplace_back();
      }
      if (!take(elements[i])) return false;
    }
    return true;
  }

  const std::byte* start_;
  std::size_t size_;
  std::size_t at_;
  Holding* holding_;
  bool lends_ = false;
  std::string problem_;
};

/// Values whose C++ form is known where a message is built or taken apart, and only there.
class Fields {
 public:
  template <typename Tuple>
  explicit Fields(const Tuple& all) : fields_(&all), put_(&put_all<Tuple>) {}

  void put(Encoder& to) const { put_(to, fields_); }

 private:
  template <typename Tuple>
  static void put_all(Encoder& to, const void* fields) {
    std::apply([&to](const auto&... field) { (to.put(field), ...); },
               *static_cast<const Tuple*>(fields));
  }

  const void* fields_;
  void (*put_)(Encoder&, const void*);
};

/// A place for the value that a reply brings.
class Place {
 public:
  template <typename T>
  explicit Place(T& value)
      : value_(&value),
        take_([](Decoder& from, void* to) { return from.take(*static_cast<T*>(to)); }) {}
  /// For nothing.
  Place() : value_(nullptr), take_([](Decoder&, void*) { return true; }) {}

  /// False if the body does not hold the value, or more than it.
  bool take(Decoder& from) const { return take_(from, value_) && from.ended(); }

 private:
  void* value_;
  bool (*take_)(Decoder&, void*);
};

}  // namespace armature::ride
