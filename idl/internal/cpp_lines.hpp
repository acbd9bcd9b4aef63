// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace armature::idl::internal {

// Lines of C++ by one rule: what fits into 100 columns is one line; otherwise each item of a list
// has a line of its own, four columns to the right. Each text returned ends its last line.

inline constexpr std::size_t kColumns = 100;

using Items = std::vector<std::string>;

/// `head item, item tail`; `head` ends in the opening bracket, `tail` begins with the closing one.
std::string list(std::size_t indent, const std::string& head, const Items& items,
                 const std::string& tail);

/// The same as an item of a list, whose indentation, comma and end of line are the list's.
std::string item(std::size_t indent, const std::string& head, const Items& items,
                 const std::string& tail);

/// A call whose last argument is a call; the tail closes both.
struct Call {
  std::string head;
  Items arguments;
};
std::string call_with_call(std::size_t indent, const Call& outer, const Call& inner,
                           const std::string& tail);

/// `head a && b && c tail`; the first item stays behind the head.
std::string chain(std::size_t indent, const std::string& head, const Items& items,
                  const std::string& operation, const std::string& tail);

/// `type name`, with the name below its type if need be.
std::string declaration(std::size_t indent, const std::string& type, const std::string& name);

/// A list with a type before it, on a line of its own if need be.
std::string list_of(std::size_t indent, const std::string& type, const std::string& head,
                    const Items& items, const std::string& tail);

/// A function's declaration, or its head with a body behind it.
struct Function {
  std::string result;  ///< with all words before it: `virtual std::int32_t`
  std::string name;    ///< `start`, `VisionService::start`
  Items parameters;
};
std::string declared(std::size_t indent, const Function& function, const std::string& tail = ";");
/// @param body  whole lines
std::string defined(std::size_t indent, const Function& function, const std::string& body);

/// Lines of documentation, `///` before each; long ones are divided between words.
std::string comment(std::size_t indent, const std::vector<std::string>& lines);

/// `0x714c2b59`
std::string hexadecimal(std::uint32_t number);

/// In double quotes, with what C++ wants to have escaped.
std::string literal(std::string_view text);

/// The same with `indent` columns in front of it, divided behind some of the characters `behind` if
/// one line has no room for it.
std::string long_literal(std::size_t indent, std::string_view text, char behind);

}  // namespace armature::idl::internal
