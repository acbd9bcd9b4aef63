// SPDX-License-Identifier: Apache-2.0
#include "armature/replay/recorded_component.hpp"

#include <algorithm>
#include <utility>

#include "armature/component/author.hpp"
#include "armature/component/interface.hpp"
#include "armature/component/ports/input_port.hpp"
#include "armature/component/ports/output_port.hpp"
#include "armature/rt/guard.hpp"

namespace armature::replay {

RecordedComponent::RecordedComponent(std::unique_ptr<component::Component> original)
    : StandIn(original->name()), original_(std::move(original)) {
  const component::Interface& members = component::interface_of(*original_);
  for (const auto* output : members.outputs) outputs_.push_back(output->twin(*this));
  for (const auto* input : members.inputs) inputs_.push_back(input->twin(*this));
  for (const auto* operation : members.operations) operations_.push_back(operation->twin(*this));
  for (const auto* event : members.events) events_.push_back(event->twin(*this));
}

RecordedComponent::~RecordedComponent() = default;

base::Result<void> RecordedComponent::add(RecordedOutput output) {
  const auto port =
      std::ranges::find(outputs_, output.port, [](const auto& one) { return one->name(); });
  if (port == outputs_.end()) {
    return base::Error{"'" + name() + "' has no output '" + output.port + "' any more"};
  }
  if (!output.channel->samples.empty()) {
    types::Value value((*port)->type());
    const auto read = output.channel->recording->read(*output.channel->samples.front(),
                                                      value.type(), value.data());
    if (!read) return base::Error{read.error()};
  }
  playing_.push_back({port->get(), std::move(output)});
  return {};
}

base::Time RecordedComponent::next_of(const Playing& one) const {
  return one.next < one.recorded.channel->samples.size()
             ? one.recorded.channel->samples[one.next]->time
             : base::Time::max();
}

base::Time RecordedComponent::next() const {
  base::Time first = base::Time::max();
  for (const Playing& each : playing_) first = std::min(first, next_of(each));
  return first;
}

/// In the order of time; of one time each output's next in turn, as a component writes them.
template <typename Chosen>
void RecordedComponent::play_those(const Chosen& chosen) {
  const rt::PermitScope allocates;
  while (true) {
    base::Time first = base::Time::max();
    for (const Playing& each : playing_) {
      if (chosen(each)) first = std::min(first, next_of(each));
    }
    if (first > time()) return;
    for (Playing& each : playing_) {
      if (!chosen(each) || next_of(each) != first) continue;
      const record::RecordedSample& sample = *each.recorded.channel->samples[each.next++];
      if (state() == component::State::kRunning) write(each, sample);
    }
  }
}

void RecordedComponent::on_update() {
  play_those([](const Playing& one) { return one.by_itself(); });
}

void RecordedComponent::play() {
  play_those([](const Playing& /*one*/) { return true; });
}

void RecordedComponent::write(Playing& one, const record::RecordedSample& sample) {
  types::Value value(one.port->type());
  const auto read = one.recorded.channel->recording->read(sample, value.type(), value.data());
  if (!read) return fault(read.error());
  if (one.port->write_from(value.data()) == component::WriteStatus::kWrongSize) {
    fault("'" + one.port->name() + "' was recorded with another size than it has now");
  }
}

/// What triggered the original may have had it write.
void RecordedComponent::pass_on(component::InputPortBase& /*input*/, const void* /*value*/) {
  on_update();
}

component::CallStatus RecordedComponent::call(component::OperationBase& /*operation*/,
                                              const void* const* /*arguments*/, void* /*result*/) {
  return component::CallStatus::kUnreachable;
}

component::Outcome RecordedComponent::begin(component::CommandBase& /*command*/,
                                            const void* const* /*arguments*/) {
  return component::refused("it is recorded, and does not run again");
}

void RecordedComponent::cancel(component::CommandBase& /*command*/) {}

}  // namespace armature::replay
