// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/base/sample_input.hpp"

#include <algorithm>
#include <string>
#include <unordered_set>
#include <vector>

#include "armature/component/interface.hpp"

namespace armature::controllers {
namespace {

using component::Check;
using component::Component;
using component::InputPortBase;

/// All that a sample of `sampled` triggers by data, at once or by way of others.
std::unordered_set<const Component*> triggered_by(const InputPortBase& sampled,
                                                  const Check& check) {
  std::unordered_set<const InputPortBase*> handlers;
  std::unordered_set<const Component*> found;
  std::vector<const InputPortBase*> open{&sampled};
  while (!open.empty()) {
    const InputPortBase& handler = *open.back();
    open.pop_back();
    for (const component::OutputPortBase* const output :
         component::interface_of(handler.owner()).outputs) {
      if (!handler.effects().includes(output->name())) continue;
      for (const InputPortBase* const reader : check.readers_of(*output)) {
        if (!reader->triggers() || !handlers.insert(reader).second) continue;
        open.push_back(reader);
        found.insert(&reader->owner());
      }
    }
  }
  found.erase(&sampled.owner());
  return found;
}

const SampleInput* sample_input_of(const Component& component) {
  for (const component::Checked* const each : component::interface_of(component).checked) {
    if (const auto* const input = dynamic_cast<const SampleInput*>(each)) return input;
  }
  return nullptr;
}

}  // namespace

void SampleInput::check(Check& check) const {
  const bool by_event = check.source_of(event_) != nullptr;
  const bool by_port = !check.writers_of(port_).empty();
  if (by_event && by_port) {
    return check.error(
        "it is sampled by the event Sample and by the port SamplePort, expected one of them",
        "remove the Sampler from its peers, or the connection to SamplePort");
  }
  if (!by_event && !by_port) {
    return check.error(
        "nobody samples it: neither a peer has the event Sample, nor has SamplePort "
        "a writer",
        "add the Sampler to its peers, or connect its SamplePort");
  }
  if (by_port) check_order(check);
}

void SampleInput::check_order(Check& check) const {
  const component::OutputPortBase& sampler = *check.writers_of(port_).front();
  const auto readers = check.readers_of(sampler);
  const auto mine = std::ranges::find(readers, &port_);
  for (const Component* const later : triggered_by(port_, check)) {
    const SampleInput* const sampled = sample_input_of(*later);
    if (sampled == nullptr) continue;
    const auto theirs = std::ranges::find(readers, &sampled->port_);
    if (theirs != readers.end() && theirs < mine) continue;
    return check.error(
        "it is sampled before '" + later->name() + "', which its data triggers",
        "connect " + std::string(sampler.name()) + " to '" + later->name() + "' first");
  }
}

}  // namespace armature::controllers
