// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <unordered_set>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/component/registry.hpp"
#include "armature/deploy/builder.hpp"
#include "armature/deploy/internal/once_per_place.hpp"
#include "armature/deploy/internal/rtai_priorities.hpp"
#include "armature/document/document.hpp"
#include "armature/exec/blueprint.hpp"

namespace armature::deploy::internal {

using namespace document;

/// Makes components with their properties, activities, peers and bindings.
class ComponentBuilder {
 public:
  ComponentBuilder(const Document& document, const component::Registry& registry,
                   const BuildOptions& options, base::Diagnostics& diagnostics)
      : document_(document),
        registry_(registry),
        options_(options),
        diagnostics_(diagnostics),
        of_interfaces_(diagnostics),
        priorities_(document, diagnostics) {}

  /// Adds the component to the blueprint, or its name to those that are absent.
  void build(const Component& written, exec::Blueprint& blueprint);

 private:
  void add(const Component& written, std::unique_ptr<component::Component> component,
           exec::Blueprint& blueprint);
  std::unique_ptr<component::Component> make(const Component& written);
  std::unique_ptr<component::Component> read_interface(Component& written);
  void refuse_other_processes(const Component& written);
  /// What stands for it here if it lives in another process, else the component itself; nullptr
  /// after an error.
  std::unique_ptr<component::Component> settle(const Component& written,
                                               std::unique_ptr<component::Component> component);
  void report_units(const Component& written, const component::Registry::Model& model,
                    const component::Component& component);
  void report_machines(const Component& written, const component::Component& component);
  void report_unknown_model(const Component& written);
  bool set_properties(const Component& written, component::Component& component);
  void refuse_attributes(const Component& written, const std::vector<Property>& properties,
                         component::Component& component);
  /// The property that a name such as `Sensor2Mux` gives; nothing may give it another value.
  bool set_number_in_name(const Component& written, component::Component& component);
  void check_number_in_name(const Component& written, const component::Component& component);
  bool apply_property_file(const Component& written, const PropertyFile& file,
                           component::Component& component);
  bool apply(const Component& written, const std::vector<Property>& properties,
             component::Component& component);
  /// The content of a property file, read once; nullptr if it cannot be read.
  const std::vector<Property>* read(const PropertyFile& file, bool may_be_missing);

  const Document& document_;
  const component::Registry& registry_;
  const BuildOptions& options_;
  base::Diagnostics& diagnostics_;
  OncePerPlace of_interfaces_;
  RtaiPriorities priorities_;
  std::vector<std::string> model_names_;
  std::unordered_set<const component::Registry::Model*> known_models_;  ///< looked at already
  std::map<std::string, std::unique_ptr<std::vector<Property>>> files_;
};

}  // namespace armature::deploy::internal
