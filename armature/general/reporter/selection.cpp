// SPDX-License-Identifier: Apache-2.0
#include "armature/general/reporter/selection.hpp"

#include <unordered_set>
#include <utility>

#include "armature/base/name_pattern.hpp"
#include "armature/base/near_name.hpp"
#include "armature/component/interface.hpp"

namespace armature::general {
namespace {

using component::Component;

std::vector<Source> outputs_of(const Component& component) {
  std::vector<Source> sources;
  for (auto* output : component::interface_of(component).outputs) {
    sources.push_back({component.name() + "." + output->name(), output, nullptr, nullptr});
  }
  return sources;
}

std::vector<Source> members_of(const Component& component) {
  std::vector<Source> sources = outputs_of(component);
  for (auto* input : component::interface_of(component).inputs) {
    sources.push_back({component.name() + "." + input->name(), nullptr, input, nullptr});
  }
  for (auto* property : component::interface_of(component).properties) {
    sources.push_back(
        {component.name() + "." + std::string(property->name()), nullptr, nullptr, property});
  }
  return sources;
}

class Selector {
 public:
  explicit Selector(const std::vector<Component*>& components) : components_(components) {}

  void add(const std::string& name) {
    bool found = false;
    for (const Component* component : components_) found |= add_from(*component, name);
    if (!found) selection_.objections.push_back(objection_to(name));
  }

  Selection take() { return std::move(selection_); }

 private:
  /// A name that has all of a component's and goes on is that of a member.
  bool add_from(const Component& component, const std::string& name) {
    if (base::matches(name, component.name())) return add_all(outputs_of(component));
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos) return false;
    if (!base::matches(std::string_view(name).substr(0, dot), component.name())) return false;
    std::vector<Source> members;
    for (Source& member : members_of(component)) {
      if (base::matches(name, member.name)) members.push_back(std::move(member));
    }
    return add_all(std::move(members));
  }

  bool add_all(std::vector<Source> sources) {
    for (Source& source : sources) {
      if (names_.insert(source.name).second) selection_.sources.push_back(std::move(source));
    }
    return !sources.empty();
  }

  component::Observer::Objection objection_to(const std::string& name) const {
    const std::string message = "'" + name + "' cannot be recorded";
    const std::string owner = name.substr(0, name.rfind('.'));
    std::vector<std::string> known;
    for (const Component* component : components_) {
      if (component->name() == name) {
        return {"'" + name + "' has no output ports",
                "'" + name + ".*' are its other ports and its properties"};
      }
      if (component->name() == owner) return {message, suggestion_of_member(name, *component)};
      known.push_back(component->name());
    }
    return {message, base::suggestion(owner, known).text};
  }

  static std::string suggestion_of_member(const std::string& name, const Component& component) {
    std::vector<std::string> known;
    for (Source& member : members_of(component)) known.push_back(std::move(member.name));
    return base::suggestion(name, known).text;
  }

  const std::vector<Component*>& components_;
  Selection selection_;
  std::unordered_set<std::string> names_;
};

}  // namespace

Selection select(const std::vector<std::string>& names,
                 const std::vector<component::Component*>& components) {
  Selector selector(components);
  for (const std::string& name : names) selector.add(name);
  return selector.take();
}

}  // namespace armature::general
