// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/new_component.hpp"

#include "armature/base/quoted.hpp"
#include "armature/cli/component_templates.hpp"

namespace armature::cli {

base::Result<NewFolder> make_component_library(const std::string& name, const std::string& parent) {
  if (const std::string problem = problem_of_name(name); !problem.empty()) {
    return base::Error{"the name " + base::quoted(name) + " " + problem};
  }
  const std::string library = snake_case(name);
  const Words words{{"Name", camel_case(name)}, {"name", library}};
  std::vector<NewFile> files;
  for (const FileTemplate& each : component_templates()) {
    files.push_back({filled(each.name, words), filled(each.content, words)});
  }
  return make_folder(parent, library, files);
}

}  // namespace armature::cli
