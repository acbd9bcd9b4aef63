// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/component/observing/observer.hpp"

namespace armature::general {

/// Something that can be recorded: one of the three.
struct Source {
  std::string name;  ///< `Component.Member`
  component::OutputPortBase* output = nullptr;
  component::InputPortBase* input = nullptr;
  component::PropertyBase* property = nullptr;
};

/// What names stand for, each source once, in the order of the names and then of declaration.
struct Selection {
  std::vector<Source> sources;
  std::vector<component::Observer::Objection> objections;  ///< to names that stand for nothing
};

/// `Component.Member` is a port, property or attribute, `Component` all of its output ports. A `*`
/// is any number of characters that are no dots.
Selection select(const std::vector<std::string>& names,
                 const std::vector<component::Component*>& components);

}  // namespace armature::general
