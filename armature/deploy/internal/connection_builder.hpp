// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/component/ports/input_port.hpp"
#include "armature/component/ports/output_port.hpp"
#include "armature/document/document.hpp"
#include "armature/exec/blueprint.hpp"

namespace armature::deploy::internal {

using namespace document;

/// Writes down a document's connections, between the components that the blueprint has already.
class ConnectionBuilder {
 public:
  ConnectionBuilder(const Document& document, exec::Blueprint& blueprint,
                    base::Diagnostics& diagnostics);

  void build();

 private:
  struct Ports {
    std::unordered_map<std::string_view, component::InputPortBase*> inputs;
    std::unordered_map<std::string_view, component::OutputPortBase*> outputs;
  };
  /// The ends of a connection by name, by direction.
  struct Ends {
    std::vector<const Endpoint*> outputs;
    std::vector<const Endpoint*> inputs;
    bool complete = true;  ///< every port was found
  };

  void add_connections();
  /// Ports have no use for what only an event that commands has.
  void check_is_command(const Connection& connection);
  void add(const Endpoint& from, const Endpoint& to, const ConnectionPolicy& policy,
           const base::Location& where);
  void add_named(const NamedConnection& named);
  Ends ends_of(const NamedConnection& named);
  void report_end(const NamedConnection& named, const Endpoint& end, const Ports* ports);
  void apply_delays();
  void check_fan_in(const Endpoint& to, const base::Location& where);
  component::MaxAge max_age_of(const Endpoint& to, const ConnectionPolicy& policy);
  component::InputPortBase* input(const Endpoint& end);
  /// The ports of a component, nullptr if there is no such component.
  const Ports* ports_of(const std::string& component);

  const Document& document_;
  exec::Blueprint& blueprint_;
  base::Diagnostics& diagnostics_;
  std::unordered_map<std::string_view, const component::Component*> components_;
  std::unordered_map<const component::Component*, Ports> ports_;
};

}  // namespace armature::deploy::internal
