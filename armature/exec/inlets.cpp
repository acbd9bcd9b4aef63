// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/inlets.hpp"

#include <algorithm>
#include <utility>

namespace armature::exec {
namespace {

std::string path_of(const component::InputPortBase& input) {
  return input.owner().name() + "." + input.name();
}

Inlets* inlets_of_operator(const Application& application) {
  return dynamic_cast<Inlets*>(application.find(kOperatorName));
}

}  // namespace

Inlets::Inlets(std::string name, const std::vector<component::InputPortBase*>& inputs)
    : Component(std::move(name)) {
  for (const component::InputPortBase* const input : inputs) {
    inlets_.push_back({input, input->make_writer(*this, path_of(*input))});
  }
}

bool Inlets::writes(const component::InputPortBase& input) const {
  return std::ranges::find(inlets_, &input, &Inlet::input) != inlets_.end();
}

base::Result<void> Inlets::write(Application& application, const component::InputPortBase& input,
                                 const types::Value& value) {
  const auto inlet = std::ranges::find(inlets_, &input, &Inlet::input);
  // Shared: a thread that answers too late still uses it.
  struct Writing {
    types::Value value;
    component::WriteStatus status = component::WriteStatus::kNotConnected;
  };
  const auto writing = std::make_shared<Writing>(Writing{value});
  component::OutputPortBase& writer = *inlet->writer;
  application.note_written(name(), path_of(input), value);
  const bool done = application.run_in_thread_of(
      *this, [writing, &writer] { writing->status = writer.write_from(writing->value.data()); });
  if (!done) return base::Error{"the thread that writes '" + path_of(input) + "' does not answer"};
  if (writing->status == component::WriteStatus::kWrongSize) {
    return base::Error{"the value for '" + path_of(input) +
                       "' has another size than the input takes"};
  }
  if (writing->status == component::WriteStatus::kFull) {
    return base::Error{"'" + path_of(input) + "' has not yet taken the previous value"};
  }
  return {};
}

base::Result<void> write_for_operator(Application& application,
                                      const component::InputPortBase& input,
                                      const types::Value& value) {
  if (!is_open_to_operator(application, input)) {
    return base::Error{"'" + path_of(input) +
                       "' is a port: only components write it, unless its deployment opens it to "
                       "the operator with operator_inputs"};
  }
  return inlets_of_operator(application)->write(application, input, value);
}

bool is_open_to_operator(const Application& application, const component::InputPortBase& input) {
  const Inlets* const inlets = inlets_of_operator(application);
  return inlets != nullptr && inlets->writes(input);
}

}  // namespace armature::exec
