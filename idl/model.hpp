// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/diagnostic.hpp"

namespace armature::idl {

/// A whole number between the least `long` and the greatest `unsigned long`.
struct Whole {
  bool negative = false;
  std::uint64_t magnitude = 0;

  friend bool operator==(const Whole&, const Whole&) = default;
  friend bool operator<(const Whole& a, const Whole& b) {
    if (a.negative != b.negative) return a.negative;
    return a.negative ? a.magnitude > b.magnitude : a.magnitude < b.magnitude;
  }
};

/// What a single value is.
enum class Basic {
  kVoid,
  kBool,
  kChar,
  kByte,
  kShort,
  kUnsignedShort,
  kInt,
  kUnsignedInt,
  kLong,
  kUnsignedLong,
  kFloat,
  kDouble,
  kString,
  kStruct,
  kEnum
};

/// As the language writes it: `unsigned int`, `String`; `struct` and `enum` alone.
std::string_view name_of(Basic basic);

bool is_whole_number(Basic basic);  ///< char and byte too
bool is_number(Basic basic);

/// A type of the language. Arrays hold single values only, so one level describes every type.
struct Type {
  enum class Form { kSingle, kCounted, kFixed };  ///< T, Array<T>, Array<T, N>

  Basic basic = Basic::kVoid;
  std::string name;  ///< of a struct or enum
  Form form = Form::kSingle;
  std::uint32_t count = 0;  ///< N of Array<T, N>
  base::Location where;

  bool is_void() const { return basic == Basic::kVoid; }
  bool is_array() const { return form != Form::kSingle; }
  /// One element of an array.
  Type element() const { return {basic, name, Form::kSingle, 0, where}; }
};

/// `Array<struct Pose, 3>`: as one writes it in the language.
std::string to_text(const Type& type);

using Doc = std::vector<std::string>;  ///< a line each

/// Least and greatest value, as written. What they say is checked against the type.
struct Range {
  std::string low;
  std::string high;
  base::Location where;
};

/// A member of a struct or event, or a parameter.
struct Field {
  Type type;
  std::string name;  ///< empty for an unnamed parameter
  Doc doc;
  std::string unit;
  std::optional<Range> range;
  base::Location where;
};

/// A struct, or an event: the same members, sent on its own.
struct Structure {
  std::string name;
  bool is_event = false;
  std::vector<Field> members;
  Doc doc;
  base::Location where;
  std::string module;    ///< the name of the one that defines it
  bool complete = true;  ///< false if a mistake has taken members away
};

/// The value is there whether it is written or not.
struct Enumerator {
  std::string name;
  Whole value;
  Doc doc;
  base::Location where;
};

struct Enumeration {
  std::string name;
  Basic underlying = Basic::kByte;  ///< a whole number, as which it is sent and stored
  std::vector<Enumerator> enumerators;
  Doc doc;
  base::Location where;
  std::string module;  ///< the name of the one that defines it

  /// What a value has that nobody has set: the one that is 0. Without mistakes there is one.
  const Enumerator& first_value() const;
};

enum class Access { kRead, kCommand, kConfigure };
std::string_view name_of(Access access);

struct Operation {
  Type result;
  std::string name;
  std::vector<Field> parameters;
  Access access = Access::kCommand;
  std::uint8_t priority = 0;  ///< of its messages, as long as their sender says no other
  bool later = false;         ///< its service answers when it can, not when it returns
  Doc doc;
  base::Location where;

  /// Nobody waits for it: a command. Otherwise a request.
  bool is_command() const { return result.is_void(); }
};

struct EventName {
  std::string name;
  std::uint8_t priority = 0;  ///< of its messages
  base::Location where;
};

struct Interface {
  std::string name;
  std::vector<Operation> operations;
  std::vector<EventName> events;  ///< those it raises
  Doc doc;
  base::Location where;
  bool complete = true;  ///< false if a mistake has taken declarations away
};

struct Import {
  std::string path;  ///< as written: relative to the folder of the file that imports
  base::Location where;
  std::string module;  ///< the name of the module that was found there
};

/// What one file defines.
struct Module {
  std::string file;
  std::string name;  ///< the file's name without folder and `.idl`
  std::vector<Import> imports;
  std::vector<Enumeration> enumerations;
  std::vector<Structure> structures;  ///< structs and events
  std::vector<Interface> interfaces;
  bool complete = true;  ///< false if a mistake may have taken definitions away
};

/// A file and all that it imports: those that are imported first, the file itself last.
class Program {
 public:
  void add(Module module);

  const std::vector<Module>& modules() const { return modules_; }
  const Module& main() const { return modules_.back(); }

  /// The first struct or event of that name in any module, or nullptr.
  const Structure* find_struct(std::string_view name) const { return find(structs_, name); }
  const Structure* find_event(std::string_view name) const { return find(events_, name); }
  /// The same of enums.
  const Enumeration* find_enum(std::string_view name) const;

 private:
  struct Place {
    std::size_t module;
    std::size_t index;
  };
  using Index = std::map<std::string, Place, std::less<>>;
  const Structure* find(const Index& index, std::string_view name) const;

  std::vector<Module> modules_;
  Index structs_;
  Index events_;
  Index enums_;
};

}  // namespace armature::idl
