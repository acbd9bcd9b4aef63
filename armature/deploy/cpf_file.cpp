// SPDX-License-Identifier: Apache-2.0
#include "armature/deploy/document_files.hpp"
#include "armature/deploy/internal/xml_tree.hpp"

namespace armature::deploy {

std::vector<Property> parse_cpf(std::string_view text, const std::string& name,
                                base::Diagnostics& diagnostics, const Limits& limits) {
  const auto root = internal::parse_orocos_xml(text, name, limits, diagnostics);
  return root ? internal::properties_of(*root, diagnostics) : std::vector<Property>{};
}

std::string write_cpf(const std::vector<Property>& properties) {
  internal::XmlWriter writer;
  writer.open("properties", {});
  for (const Property& property : properties) writer.property(property);
  writer.close();
  return writer.take();
}

}  // namespace armature::deploy
