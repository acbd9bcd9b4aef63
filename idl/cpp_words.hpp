// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace armature::idl {

/// A keyword of C++20, or a macro of a header of C, C++ or POSIX: nothing can have its name.
bool is_cpp_word(std::string_view name);

/// What headers of C, C++ and POSIX declare outside of every namespace: no namespace has its name.
bool is_global_in_cpp(std::string_view name);

}  // namespace armature::idl
