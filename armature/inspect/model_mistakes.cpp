// SPDX-License-Identifier: Apache-2.0
#include "armature/inspect/model_mistakes.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "armature/base/quoted.hpp"
#include "armature/base/unit.hpp"
#include "armature/component/author.hpp"
#include "armature/component/interface.hpp"

namespace armature::inspect {
namespace {

/// Where in `type` there is a text that grows, as `field.field`; nothing if there is none.
std::optional<std::string> place_of_text(const types::Type& type) {
  if (type.kind == types::Kind::kText) return "";
  if (type.element != nullptr) return place_of_text(*type.element);
  for (const types::Field& field : type.fields) {
    const auto inner = place_of_text(*field.type);
    if (inner) return std::string(field.name) + (inner->empty() ? "" : ".") + *inner;
  }
  return std::nullopt;
}

/// Looks at one model's members.
class ModelCheck {
 public:
  explicit ModelCheck(const component::Registry::Model& model)
      : model_("model " + base::quoted(model.name) + " of " +
               (model.library.empty() ? "the program" : "library " + base::quoted(model.library))) {
  }

  void look_at(const std::string& member, std::string_view unit) {
    if (const auto known = base::parse_unit(unit); !known) {
      mistakes_.push_back(model_ + ": " + member + ": " + known.error());
    }
  }

  /// `item` is a property or port, whose type may be a struct.
  template <typename Item>
  void look_at(const std::string& kind, const Item& item) {
    const std::string member = kind + " " + base::quoted(item.name());
    look_at(member, item.unit());
    look_at_fields(member, item.type(), "");
  }

  /// Data on ports never grows: writing it must not allocate.
  template <typename Port>
  void look_at_port(const std::string& kind, const Port& port) {
    look_at(kind, port);
    const auto place = place_of_text(port.type());
    if (!place) return;
    mistakes_.push_back(model_ + ": " + kind + " " + base::quoted(port.name()) + ": " +
                        port.type().name + " has a text inside" +
                        (place->empty() ? "" : ", the field " + base::quoted(*place)) +
                        ", which grows; ports carry base::FixedText");
  }

  std::vector<std::string> take() { return std::move(mistakes_); }

 private:
  void look_at_fields(const std::string& member, const types::Type& type, const std::string& path) {
    if (type.element != nullptr) look_at_fields(member, *type.element, path);
    for (const types::Field& field : type.fields) {
      const std::string inner = path + (path.empty() ? "" : ".") + std::string(field.name);
      look_at(member + ", field " + base::quoted(inner), field.unit);
      look_at_fields(member, *field.type, inner);
    }
  }

  std::string model_;
  std::vector<std::string> mistakes_;
};

/// The ports of an array are not looked at one by one: there may be none of them yet.
template <typename Ports>
void look_at_ports(ModelCheck& check, const std::string& kind, const Ports& ports,
                   const std::vector<component::PortArrayBase*>& arrays) {
  for (const auto* port : ports) {
    const bool of_an_array = std::any_of(arrays.begin(), arrays.end(), [&](const auto* array) {
      return array->has_name(port->name());
    });
    if (!of_an_array) check.look_at_port(kind, *port);
  }
}

}  // namespace

std::vector<std::string> mistakes_of_model(const component::Component& component,
                                           const component::Registry::Model& model) {
  const component::Interface& interface = component::interface_of(component);
  ModelCheck check(model);
  for (const auto* property : interface.properties) {
    check.look_at(property->persistent() ? "property" : "attribute", *property);
  }
  look_at_ports(check, "input", interface.inputs, interface.port_arrays);
  look_at_ports(check, "output", interface.outputs, interface.port_arrays);
  for (const auto* array : interface.port_arrays) {
    check.look_at("ports " + base::quoted(std::string(array->name()) + "1..N"), array->unit());
  }
  return check.take();
}

}  // namespace armature::inspect
