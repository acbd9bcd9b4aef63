// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"

namespace armature::cli {

/// What `armature new` wrote.
struct NewFolder {
  std::string folder;
  std::vector<std::string> files;  ///< relative to the folder
};

/// A file to be written, relative to its folder.
struct NewFile {
  std::string name;
  std::string content;
};

/// What stands for `@word@` in a template; other text between two '@' stays.
using Words = std::map<std::string, std::string, std::less<>>;
std::string filled(std::string_view text, const Words& words);

/// `CANDriver2` as `can_driver2`.
std::string snake_case(std::string_view name);
/// `can_driver` as `CanDriver`; capitals stay.
std::string camel_case(std::string_view name);

/// What is wrong with the name of a class, a library and a folder; empty if nothing.
std::string problem_of_name(std::string_view name);

/// Writes files into a new folder below `parent`. Refused, with nothing written, if the folder
/// exists; after a failure nothing of it is left.
base::Result<NewFolder> make_folder(const std::string& parent, const std::string& name,
                                    const std::vector<NewFile>& files);

}  // namespace armature::cli
