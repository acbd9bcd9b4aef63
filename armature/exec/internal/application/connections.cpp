// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/application/connections.hpp"

#include "armature/base/quoted.hpp"
#include "armature/component/author.hpp"
#include "armature/component/interface.hpp"
#include "armature/component/observing/observer.hpp"
#include "armature/exec/internal/wiring.hpp"

namespace armature::exec::internal {

void Connections::declare_reactions() const {
  for (const ConnectionPlan& connection : plan_.connections) {
    if (!connection.reacts) continue;
    if (connection.entry->max_age) connection.input->set_max_age(*connection.entry->max_age);
    if (connection.entry->on_lost) connection.input->set_on_lost(*connection.entry->on_lost);
  }
}

void Connections::make(base::Diagnostics& diagnostics) const {
  for (const ComponentEntry& entry : blueprint_.components) {
    for (auto* output : component::interface_of(*entry.component).outputs) output->prepare();
  }
  for (const ConnectionPlan& connection : plan_.connections) connect(connection, diagnostics);
  for (const SubscriptionPlan& subscription : plan_.subscriptions) {
    subscription.event->subscribe(*subscription.handler);
  }
  for (const CallPlan& call : plan_.calls) call.requirement->connect(*call.operation);
  if (!plan_.observers.empty()) let_observers_look();
}

void Connections::connect(const ConnectionPlan& connection, base::Diagnostics& diagnostics) const {
  const ConnectionEntry& entry = *connection.entry;
  if (connection.output->fits(*connection.input)) {
    connection.output->connect(*connection.input, entry.policy);
    return;
  }
  diagnostics.error(entry.where, base::quoted(entry.from_component + "." + entry.from_port) +
                                     " was configured with another number of elements than " +
                                     base::quoted(entry.to_component + "." + entry.to_port) +
                                     " expects");
}

void Connections::let_observers_look() const {
  const component::Surroundings surroundings{components_of(blueprint_), output_folder_};
  for (const Index index : plan_.observers) {
    for (auto* observer :
         component::interface_of(*blueprint_.components[index].component).observers) {
      observer->observe(surroundings);
    }
  }
}

void Connections::undo() const {
  for (const ComponentEntry& entry : blueprint_.components) {
    const component::Interface& interface = component::interface_of(*entry.component);
    for (auto* output : interface.outputs) output->disconnect_all();
    for (auto* event : interface.events) event->unsubscribe_all();
    for (auto* caller : interface.callers) caller->disconnect();
    if (plan_.observers.empty()) continue;
    for (auto* property : interface.properties) property->untap();
  }
}

}  // namespace armature::exec::internal
