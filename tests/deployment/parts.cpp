// SPDX-License-Identifier: Apache-2.0
// Component models for deployments with mistakes; none of them does anything.
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "armature/component/author.hpp"

namespace parts {

using namespace armature::component;

struct Gains {
  double kp = 0.0;
  double limit = 0.0;
};
ARMATURE_STRUCT(Gains, (kp, "V/rad", "proportional gain"), (limit, "V", "upper limit"));

namespace {

class Source final : public Component {
 public:
  using Component::Component;

 private:
  Property<double> rate_{this, "Rate", 1.0, "how fast it changes", "rad/s", range(0.0, 10.0)};
  Property<int> steps_{this, "Steps", 1, "values in each cycle"};
  Property<bool> loud_{this, "Loud", false, "says what it writes"};
  Property<std::vector<double>> table_{this, "Table", {}, "what it writes", "rad"};
  Property<std::array<double, 2>> offsets_{this, "Offsets", {}, "added to them", "rad"};
  Property<Gains> gains_{this, "Gains", {}, "multiplied with them"};
  OutputPort<double> out_{this, "Out", "an angle", "rad"};
};

class Sink final : public Component {
 public:
  using Component::Component;

 private:
  InputPort<double> in_{this, "In", "an angle", "rad"};
  InputPort<double> extra_{this, "Extra", "an angle more", "rad", may_stay_open};
};

class VoltSink final : public Component {
 public:
  using Component::Component;

 private:
  InputPort<double> in_{this, "In", "a voltage", "V"};
};

class IntSink final : public Component {
 public:
  using Component::Component;

 private:
  InputPort<int> in_{this, "In", "a number", "rad"};
};

/// Passes on what comes in, in the thread of whoever writes.
class Echo final : public Component {
 public:
  using Component::Component;

 private:
  void pass(double value) { out_.write(value); }

  OutputPort<double> out_{this, "Out", "an angle", "rad"};
  InputPort<double> in_{this, "In", "an angle", "rad", on_data<&Echo::pass>};
};

/// Reads in its update.
class Stage final : public Component {
 public:
  using Component::Component;

 private:
  InputPort<double> in_{this, "In", "an angle", "rad"};
  OutputPort<double> out_{this, "Out", "an angle", "rad"};
};

class Mux final : public Component {
 public:
  using Component::Component;

 private:
  Property<int> joints_{this, "joints", 1, "how many", "", mandatory, range(1, 64)};
  InputPorts<double> positions_{this, "Position", joints_, "of each joint", "rad"};
  OutputPort<std::vector<double>> all_{this, "All", "of all joints", "rad", size_of(joints_)};
};

class VectorSink final : public Component {
 public:
  using Component::Component;

 private:
  Property<int> size_{this, "size", 2, "of the vector"};
  InputPort<std::vector<double>> in_{this, "In", "angles", "rad", size_of(size_)};
};

class Card final : public Component {
 public:
  using Component::Component;

 private:
  double read() { return 0.0; }
  double scaled(double factor) { return factor; }
  void release() {}

  Operation<double()> read_{this, "read", serve<&Card::read>, "reads it"};
  Operation<double(double)> scaled_{this, "scaled", serve<&Card::scaled>, "reads it, scaled"};
  Operation<void()> release_{this, "release", serve<&Card::release>, "lets it move", by_operator};
};

class Joint final : public Component {
 public:
  using Component::Component;

 private:
  Property<std::string> peer_{this, "PeerName", "", "whose read it calls"};
  OperationCaller<double()> read_{this, "read", "reads the position", from(peer_)};
};

class Broken final : public Component {
 public:
  explicit Broken(std::string name) : Component(std::move(name)) {
    throw std::runtime_error("there is no card on can0");
  }
};

class Saved final : public Component {
 public:
  using Component::Component;

 private:
  Property<double> gain_{this, "Gain", 1.0, "gain", "V/rad", range(0.0, 10.0)};
  Property<std::string> bus_{this, "Bus", "can0", "bus"};
};

/// Declares units that there are not.
class Tacho final : public Component {
 public:
  using Component::Component;

 private:
  Property<double> limit_{this, "Limit", 1.0, "highest speed", "rad/sec"};
  OutputPort<double> speed_{this, "Speed", "of the shaft", "RPM"};
};

}  // namespace
}  // namespace parts

ARMATURE_COMPONENT_LIBRARY(test_parts, registry) {
  using namespace parts;
  registry.add<Source>("Source", "writes angles");
  registry.add<Sink>("Sink", "reads angles");
  registry.add<VoltSink>("VoltSink", "reads voltages");
  registry.add<IntSink>("IntSink", "reads numbers");
  registry.add<Echo>("Echo", "passes on at once");
  registry.add<Stage>("Stage", "passes on in its update");
  registry.add<Mux>("Mux", "gathers angles");
  registry.add<VectorSink>("VectorSink", "reads vectors");
  registry.add<Card>("Card", "is read");
  registry.add<Joint>("Joint", "reads a card");
  registry.add<Broken>("Broken", "cannot be made");
  registry.add<Saved>("Saved", "has properties to keep");
  registry.add<Tacho>("Tacho", "measures a speed");
}
