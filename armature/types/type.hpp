// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "armature/base/fixed_text.hpp"
#include "armature/base/result.hpp"

namespace armature::types {

/// Kinds of types: scalars, texts, and what is made of them.
enum class Kind {
  kBool,
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat,
  kDouble,
  kEnum,       ///< described by ARMATURE_ENUM (enum.hpp)
  kText,       ///< std::string: grows, so never on a port
  kFixedText,  ///< base::FixedText<N>
  kArray,      ///< std::array<T, N>
  kVector,     ///< std::vector<T>: its size is fixed from configuration on
  kStruct,
};

struct Type;

/// A field of a struct.
struct Field {
  std::string_view name;
  std::size_t offset;
  const Type* type;
  std::string_view unit;  ///< empty for a plain number
  std::string_view doc;
};

/// A value of an enumeration and its name, as files, scripts and tools have it: `catch_up`.
struct Enumerator {
  std::string name;
  std::int64_t value;
};

/// Describes a C++ type to files, tools, recorder and network. It lives as long as the program. Two
/// plug-ins may each have their own description of one type: compare with `same_type`.
struct Type {
  std::string name;  ///< canonical: `double`, `vector<double>`, `array<float,3>`, `Pose`
  Kind kind;
  std::size_t size;           ///< sizeof the C++ type
  std::size_t alignment;      ///< alignof the C++ type
  std::uint32_t hash;         ///< FNV-1a of the canonical layout: equal in every process and build
  const Type* element;        ///< of an array or vector, else nullptr
  std::size_t count;          ///< elements of an array, capacity of a fixed text, else 0
  std::vector<Field> fields;  ///< of a struct
  const Type* underlying;     ///< integer that an enumeration is stored as, else nullptr
  std::vector<Enumerator> enumerators;  ///< of an enumeration, in the order of its declaration
  bool grows;                           ///< a vector or text is inside, so copying may allocate
  bool sealed;  ///< only its own class makes values: no property, tool or peer does

  void (*construct)(void* at);
  void (*destroy)(void* at);
  void (*assign)(void* to, const void* from);
  std::size_t (*vector_size)(const void* vector);
  void (*vector_resize)(void* vector, std::size_t count);
  void* (*vector_data)(void* vector);
  std::string_view (*text)(const void* text);
  void (*set_text)(void* text, std::string_view content);

  /// True if copying never allocates whatever the sizes: no vector and no text inside.
  bool fixed_size() const { return !grows; }
};

/// The description of `T`. Supported: bool, integers, float, double, std::string, FixedText,
/// std::array and std::vector (except vector<bool>) of supported types, enumerations described by
/// ARMATURE_ENUM (enum.hpp), and structs described by ARMATURE_STRUCT (struct.hpp) that do not
/// contain themselves.
template <typename T>
const Type& type_of();

/// True if a value of one may be read as a value of the other: same name, fields and memory layout.
bool same_type(const Type& a, const Type& b);

/// What `hash` is computed from, such as `Pose{x:double,q:vector<float>}`,
/// `Mode:uint8{off=0,on=1}`.
std::string layout_text(const Type& type);

/// True if assigning `b` to `a` needs no allocation: equal vector sizes at every level.
/// @rt nonblocking, no allocation, O(vectors)
bool same_shape(const Type& type, const void* a, const void* b);

/// Readable text: `0.5`, `catch_up`, `[1, 2]`, `{x: 1, y: 2}`. A text is written as it is, and in
/// quotes where it is inside something else; a value that no enumerator has, as its number.
std::string to_text(const Type& type, const void* value);

/// Reads what `to_text` writes. A struct needs each of its fields once, in any order. An error
/// names the path of the part at fault and leaves `value` as it was.
base::Result<void> from_text(const Type& type, std::string_view text, void* value);

/// Appends the binary form: little-endian, without padding; a u32 count goes before the elements of
/// a vector and the bytes of a text, of which there are fewer than 2^32.
void encode(const Type& type, const void* value, std::vector<std::byte>& to);

/// Size of the binary form in bytes.
/// @rt nonblocking, no allocation
std::size_t encoded_size(const Type& type, const void* value);

/// Writes the binary form to `to`, which has room for `encoded_size` bytes; returns the bytes
/// written.
/// @rt nonblocking, no allocation
std::size_t encode_to(const Type& type, const void* value, std::byte* to);

/// Reads the binary form and returns the bytes used; what follows is the caller's. An error says at
/// which byte and leaves `value` as it was: too few bytes, a count beyond them, a bool above 1, a
/// number that no enumerator has.
base::Result<std::size_t> decode(const Type& type, const std::byte* from, std::size_t size,
                                 void* value);

/// Calls `visitor(path, type, value)` for every scalar or text inside, in order; the path is like
/// `pose.x` or `q[3]`, empty for a scalar itself.
template <typename Visitor>
void visit_leaves(const Type& type, const void* value, Visitor&& visitor,
                  const std::string& path = {});

/// A value of any described type that owns its storage; for tools, never on a real-time thread.
class Value {
 public:
  explicit Value(const Type& type);
  Value(const Type& type, const void* content);
  Value(const Value& other);
  Value(Value&& other) noexcept;
  Value& operator=(Value other) noexcept;
  ~Value();

  template <typename T>
  static Value of(const T& content) {
    return Value(type_of<T>(), &content);
  }

  const Type& type() const { return *type_; }
  void* data() { return storage_; }
  const void* data() const { return storage_; }
  template <typename T>
  const T* get_if() const {
    return same_type(*type_, type_of<T>()) ? static_cast<const T*>(storage_) : nullptr;
  }
  std::string text() const { return to_text(*type_, storage_); }

 private:
  const Type* type_;
  void* storage_;
};

}  // namespace armature::types

#include "armature/types/internal/type_of.hpp"
