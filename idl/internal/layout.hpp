// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace armature::idl::internal {

// Lines of C++ as clang-format lays them out in the style of this project (Google, 100 columns), so
// that it leaves generated files as they are. Each text returned ends its last line.

inline constexpr std::size_t kColumns = 100;

using Items = std::vector<std::string>;

/// A function's declaration, or its head with a body behind it.
struct Function {
  std::string result;  ///< may be empty, with all words before it: `virtual std::int32_t`
  std::string owner;   ///< `VisionService::`, or empty
  std::string name;
  Items parameters;
  std::string tail;  ///< behind the closing parenthesis: `;`, ` {`, ` override;`
};
std::string function(std::size_t indent, const Function& function);

/// A function whose body is one statement, on the head's line if there is room.
std::string short_function(std::size_t indent, const Function& head, const std::string& statement);

std::string class_head(const std::string& name, const std::string& base);

/// `head` ends in an opening parenthesis; `tail` closes it.
std::string call(std::size_t indent, const std::string& head, const Items& arguments,
                 const std::string& tail);
/// Outside of functions, where clang-format takes a macro for a declaration.
std::string macro(const std::string& head, const Items& arguments, const std::string& tail);

/// A call whose last argument is one, too.
struct Call {
  std::string head;
  Items arguments;
};
std::string call_with_call(std::size_t indent, const Call& outer, const Call& inner,
                           const std::string& tail);

/// A call that is the only argument of another: `outer inner a, b tail`.
std::string nested_call(std::size_t indent, const std::string& outer, const std::string& inner,
                        const Items& arguments, const std::string& tail);

/// `head a && b && c tail`, aligned behind the head.
std::string chain(std::size_t indent, const std::string& head, const Items& operands,
                  std::string_view operation, const std::string& tail);

/// Lines of documentation, `///` before each; long ones are divided.
std::string comment(std::size_t indent, const std::vector<std::string>& lines);

/// `0x714c2b59`
std::string hexadecimal(std::uint32_t number);

/// In double quotes, with what C++ wants to have escaped.
std::string literal(std::string_view text);

/// A literal that is divided where it does not fit between `indent` and the last column; the parts
/// stand below each other.
std::string long_literal(std::size_t indent, std::string_view text);

}  // namespace armature::idl::internal
