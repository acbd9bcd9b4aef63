// SPDX-License-Identifier: Apache-2.0
#include "armature/component/library.hpp"

#include <exception>
#include <string_view>
#include <utility>

namespace armature::component {
namespace {

/// Why nothing of it can be used here; empty if all can.
std::string misfit(const LibraryDescription* description, const std::string& library) {
  const std::string undescribed =
      library +
      " has an empty library description: rebuild it with this program's headers and compiler";
  if (description == nullptr || description->abi == nullptr) return undescribed;
  const std::string_view theirs = description->abi;
  const std::string_view ours = abi_tag();
  if (theirs != ours) {
    return library + " was built for " + std::string(theirs) + ", but this program is " +
           std::string(ours) + ": rebuild the library with this program's headers and compiler";
  }
  if (description->layout != runtime_layout()) {
    return library + " was built with other headers of " +
           std::string(ours.substr(0, ours.find('/'))) +
           " than this program, so they disagree about the layout of components: "
           "rebuild the library with the headers of this program";
  }
  if (description->name == nullptr || description->fill == nullptr) return undescribed;
  return {};
}

}  // namespace

base::Result<void> add_library(const LibraryDescription* description, const std::string& library,
                               Registry& registry) {
  if (std::string problem = misfit(description, library); !problem.empty()) {
    return base::Error{std::move(problem)};
  }
  registry.begin_library(description->name);
  std::string thrown;
  try {
    description->fill(registry);
  } catch (const std::exception& exception) {
    thrown = exception.what();
  } catch (...) {
    thrown = "an object that is not a std::exception";
  }
  const std::string problems = registry.end_library();
  if (!thrown.empty()) return base::Error{library + " threw while it was loaded: " + thrown};
  if (!problems.empty()) return base::Error{library + ": " + problems};
  return {};
}

}  // namespace armature::component
