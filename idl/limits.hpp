// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace armature::idl {

// No interface of a robot comes near these; whatever a file says, its answer comes in time and with
// little memory.
inline constexpr std::size_t kLargestFile = 256 * 1024;        ///< bytes
inline constexpr std::size_t kMostFiles = 64;                  ///< imported, one by the other
inline constexpr std::size_t kLongestName = 64;                ///< letters
inline constexpr std::size_t kMostMembers = 256;               ///< of a struct or event
inline constexpr std::size_t kMostEnumerators = 256;           ///< of an enum
inline constexpr std::size_t kMostParameters = 64;             ///< of an operation
inline constexpr std::size_t kMostDeclarations = 256;          ///< of an interface
inline constexpr std::size_t kDeepestNesting = 32;             ///< of structs in structs
inline constexpr std::size_t kLongestCanonical = 16 * 1024;    ///< characters
inline constexpr std::size_t kLargestBody = 16 * 1024 * 1024;  ///< bytes, as RIDE takes them
inline constexpr std::size_t kMostElements = kLargestBody;     ///< of an Array<T, N>
inline constexpr std::size_t kLongestUnit = 24;                ///< columns
inline constexpr std::size_t kMostErrors = 100;                ///< told of in one run

}  // namespace armature::idl
