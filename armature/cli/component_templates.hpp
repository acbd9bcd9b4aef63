// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace armature::cli {

/// A file of a new component library. In name and content `@Name@` stands for the component's name,
/// `@name@` for that of library, folder and files.
struct FileTemplate {
  std::string_view name;
  std::string_view content;
};

std::span<const FileTemplate> component_templates();

}  // namespace armature::cli
