// SPDX-License-Identifier: Apache-2.0
#include "armature/orocos/internal/xml_tree.hpp"
#include "armature/orocos/property_file.hpp"

namespace armature::orocos {

using namespace document;

std::vector<Property> parse_cpf(std::string_view text, const std::string& name,
                                base::Diagnostics& diagnostics, const Limits& limits) {
  const auto root = parse_orocos_xml(text, name, limits, diagnostics);
  return root ? properties_of(*root, diagnostics) : std::vector<Property>{};
}

std::string write_cpf(const std::vector<Property>& properties) {
  XmlWriter writer;
  writer.open("properties", {});
  for (const Property& property : properties) writer.property(property);
  writer.close();
  return writer.take();
}

}  // namespace armature::orocos
