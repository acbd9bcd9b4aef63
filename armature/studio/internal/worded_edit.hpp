// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/edit/edit.hpp"

namespace armature::studio::internal {

/// An edit by its name and words, as workbench.idl lists them; the error says which there are, or
/// how many words it takes.
base::Result<edit::Change> change_of(std::string_view name, const std::vector<std::string>& words);

}  // namespace armature::studio::internal
