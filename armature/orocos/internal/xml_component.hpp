// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/document/document.hpp"
#include "armature/document/limits.hpp"
#include "armature/orocos/internal/xml_tree.hpp"

namespace armature::orocos {

using namespace document;

/// A port and the name of the connection that it belongs to.
struct XmlPort {
  std::string connection;
  std::string component;
  std::string port;
  base::Location where;
};

/// A component's struct as the map that it has in YAML; adds its ports to `ports`.
Value component_of(const XmlElement& element, std::vector<XmlPort>& ports, const Limits& limits,
                   base::Diagnostics& diagnostics);

/// The `ConnPolicy` structs and the ports that name them, as the list that YAML has.
Value connections_of(const std::vector<const XmlElement*>& policies,
                     const std::vector<XmlPort>& ports, const Limits& limits,
                     base::Diagnostics& diagnostics);

/// Adds `armature:key="..."` attributes as keys whose values are YAML.
void add_extras(const XmlElement& element, Value& map, const Limits& limits,
                base::Diagnostics& diagnostics);

/// Gives each SlaveActivity the activity of its Master, in the Master's thread.
void seat_slaves(std::vector<XmlElement>& components, base::Diagnostics& diagnostics);

void add_entry(Value& map, std::string key, Value value);
void add_entry(Value& map, std::string key, std::string text, const base::Location& where);

}  // namespace armature::orocos
