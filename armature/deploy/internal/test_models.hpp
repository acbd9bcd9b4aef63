// SPDX-License-Identifier: Apache-2.0
#pragma once

// Component models for the tests of this folder.

#include <chrono>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/deploy/deployment.hpp"

namespace armature::deploy::test {

using component::args;
using component::Component;
using component::InputPort;
using component::OutputPort;
using component::Property;

/// Counts its updates.
class Source final : public Component {
 public:
  using Component::Component;
  Property<double> rate{this, "Rate", 1.0, "step of each update", "rad", component::range(0, 10)};
  Property<std::string> label{this, "Label", "none", "for people"};
  component::Attribute<int> spare{this, "Spare", 0, "not kept in files"};
  OutputPort<double> out{this, "Out", "an angle", "rad"};

 private:
  void on_update() override { out.write(sum_ += rate); }
  double sum_ = 0.0;
};

/// Passes on what comes in, in the writer's thread.
class Echo final : public Component {
 public:
  using Component::Component;
  OutputPort<double> out{this, "Out", "an angle", "rad"};

 private:
  void pass(double value) { out.write(value); }
  InputPort<double> in_{this, "In", "an angle", "rad", component::on_data<&Echo::pass>};
};

class Sink final : public Component {
 public:
  using Component::Component;
  InputPort<double> in{this,
                       "In",
                       "an angle",
                       "rad",
                       component::may_stay_open,
                       component::max_age(std::chrono::seconds(1), component::Reaction::kZero)};
  InputPort<double> all{this, "All", "angles", "rad", component::may_stay_open, component::fan_in};

 private:
  void on_update() override { in.read(); }
};

class Mux final : public Component {
 public:
  using Component::Component;
  Property<int> joints{this, "joints", 1, "how many", "", component::mandatory};
  component::InputPorts<double> positions{this, "Position", joints, "of each joint", "rad"};
  OutputPort<std::vector<double>> all{this, "All", "of all joints", "rad",
                                      component::size_of(joints)};
};

class Card final : public Component {
 public:
  using Component::Component;

 private:
  double read() { return 7.0; }
  component::Operation<double()> read_{this, "read", component::serve<&Card::read>, "reads it"};
};

/// Writes what its card reads.
class Joint final : public Component {
 public:
  using Component::Component;

 private:
  void on_update() override { out_.write(read_().value); }

  Property<std::string> peer_{this, "PeerName", "", "whose read it calls"};
  component::OperationCaller<double()> read_{this, "read", "reads the position",
                                             component::from(peer_)};
  OutputPort<double> out_{this, "Out", "what it read", "rad"};
};

inline void add_models(component::Registry& registry) {
  registry.add<Source>("Source", "counts its updates");
  registry.add<Echo>("Echo", "passes on at once");
  registry.add<Sink>("Sink", "reads angles");
  registry.add<Mux>("Mux", "gathers angles");
  registry.add<Card>("Card", "is read");
  registry.add<Joint>("Joint", "reads a card");
}

/// The deployment `yaml` with these models, as if read from `app.yaml`.
inline Deployment deploy(std::string_view yaml, DeploymentOptions options = {}) {
  options.models = &add_models;
  if (options.cpus == 0) options.cpus = 2;
  return parse_deployment(yaml, "app.yaml", options);
}

/// A component of the blueprint as its own class.
template <typename ComponentClass>
ComponentClass& get(const Deployment& deployment, std::string_view name) {
  for (const exec::ComponentEntry& entry : deployment.blueprint.components) {
    if (entry.component->name() == name) return dynamic_cast<ComponentClass&>(*entry.component);
  }
  throw std::invalid_argument("no such component");
}

inline const exec::ComponentEntry& entry_of(const Deployment& deployment, std::string_view name) {
  for (const exec::ComponentEntry& entry : deployment.blueprint.components) {
    if (entry.component->name() == name) return entry;
  }
  throw std::invalid_argument("no such component");
}

}  // namespace armature::deploy::test
