// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "python/native/python_component.hpp"

namespace armature::python {

/// What `declared` says, as a member of `owner`. Its texts live as long as that.
std::unique_ptr<HostedMember> make_member(component::Component& owner, const Declared& declared);

}  // namespace armature::python
