// SPDX-License-Identifier: Apache-2.0
#include "python/native/hosted_members.hpp"

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "armature/component/face.hpp"
#include "python/native/values.hpp"

namespace armature::python {
namespace {

namespace py = pybind11;
using component::Component;

template <typename T>
T value_of(py::handle value, const std::string& name) {
  const types::Value read = from_python(value, types::type_of<T>(), name);
  return *static_cast<const T*>(read.data());
}

template <typename T>
class HostedProperty final : public HostedMember {
 public:
  template <typename... Options>
  HostedProperty(Component& owner, const Declared& about, Options... options)
      : property_(&owner, about.name, value_of<T>(about.initial, about.name), about.doc, about.unit,
                  options...) {}

  py::object get() override { return to_python(types::type_of<T>(), &property_.get()); }
  void set(py::handle value) override {
    property_.assign(value_of<T>(value, std::string(property_.name())));
  }

 private:
  component::Property<T> property_;
};

template <typename T>
class HostedInput final : public HostedMember {
 public:
  template <typename... Options>
  HostedInput(Component& owner, const Declared& about, Options... options)
      : name_(about.name), input_(&owner, about.name, about.doc, about.unit, options...) {}

  py::object get() override {
    const component::Reading<T> reading = input_.read();
    if (!reading) return py::none();
    return to_python(types::type_of<T>(), &reading.value);
  }
  void set(py::handle) override {
    throw py::attribute_error("the input '" + name_ + "' is written by who is connected to it");
  }

 private:
  std::string name_;
  component::InputPort<T> input_;
};

template <typename T>
class HostedOutput final : public HostedMember {
 public:
  template <typename... Options>
  HostedOutput(Component& owner, const Declared& about, Options... options)
      : name_(about.name), output_(&owner, about.name, about.doc, about.unit, options...) {}

  py::object get() override {
    return to_python(types::type_of<T>(), component::face(output_).current());
  }
  void set(py::handle value) override {
    if (output_.write(value_of<T>(value, name_)) != component::WriteStatus::kWrongSize) return;
    throw py::value_error("the output '" + name_ + "' has another size: declare `size`");
  }

 private:
  std::string name_;
  component::OutputPort<T> output_;
};

/// Options are known when a member is made, and their types when it is compiled.
template <typename T>
std::unique_ptr<HostedMember> make_property(Component& owner, const Declared& about) {
  const auto made = [&](auto... options) -> std::unique_ptr<HostedMember> {
    return std::make_unique<HostedProperty<T>>(owner, about, options...);
  };
  if (about.range && about.changeable_while_running) {
    return made(*about.range, component::changeable_while_running);
  }
  if (about.range) return made(*about.range);
  if (about.changeable_while_running) return made(component::changeable_while_running);
  return made();
}

template <typename T, typename... Options>
std::unique_ptr<HostedMember> make_input(Component& owner, const Declared& about,
                                         Options... options) {
  const auto made = [&](auto... more) -> std::unique_ptr<HostedMember> {
    return std::make_unique<HostedInput<T>>(owner, about, options..., more...);
  };
  if (about.triggers && about.may_stay_open) {
    return made(component::on_data_update, component::may_stay_open);
  }
  if (about.triggers) return made(component::on_data_update);
  if (about.may_stay_open) return made(component::may_stay_open);
  return made();
}

template <typename T>
std::unique_ptr<HostedMember> make_port(Component& owner, const Declared& about) {
  const bool is_input = about.kind == "input";
  if constexpr (std::is_same_v<T, std::vector<double>>) {
    const component::PortSize size = component::fixed_size(about.size);
    if (is_input) return make_input<T>(owner, about, size);
    return std::make_unique<HostedOutput<T>>(owner, about, size);
  } else {
    if (is_input) return make_input<T>(owner, about);
    return std::make_unique<HostedOutput<T>>(owner, about);
  }
}

}  // namespace

std::unique_ptr<HostedMember> make_member(Component& owner, const Declared& declared) {
  const bool is_property = declared.kind == "property";
  const auto made = [&]<typename T>(std::type_identity<T>) {
    return is_property ? make_property<T>(owner, declared) : make_port<T>(owner, declared);
  };
  if (declared.type == "bool") return made(std::type_identity<bool>{});
  if (declared.type == "int") return made(std::type_identity<int>{});
  if (declared.type == "float") return made(std::type_identity<double>{});
  if (declared.type == "list") return made(std::type_identity<std::vector<double>>{});
  return make_property<std::string>(owner, declared);  // the only one that is left
}

}  // namespace armature::python
