// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "armature/document/document.hpp"

/// What becomes of an expanded document when components have other names, or go.
namespace armature::edit::internal {

/// The new full name of a component; its own if it keeps it.
using NewName = std::function<std::string(const std::string& name)>;

/// Every name of a component replaced.
document::Document renamed(document::Document document, const NewName& new_name);

/// True for the full names of components that go.
using IsGone = std::function<bool(const std::string& name)>;

/// Without them, and without all that refers to them.
document::Document without(document::Document document, const IsGone& is_gone);

}  // namespace armature::edit::internal
