// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/inlets.hpp"

#include <algorithm>
#include <string>

#include "armature/document/document.hpp"

namespace armature::remote {
namespace {

std::string path_of(const component::InputPortBase& input) {
  return input.owner().name() + "." + input.name();
}

}  // namespace

Inlets::Inlets(const std::vector<component::InputPortBase*>& inputs)
    : Component(document::kNetworkName) {
  for (const component::InputPortBase* const input : inputs) {
    inlets_.push_back({input, input->make_writer(*this, path_of(*input))});
  }
}

base::Error Inlets::not_open(const component::InputPortBase& input) {
  return {"'" + path_of(input) +
          "' is not open to other processes: list it in its deployment, network: {inputs: [...]}"};
}

base::Result<void> Inlets::write(exec::Application& application,
                                 const component::InputPortBase& input, const types::Value& value) {
  const auto inlet = std::ranges::find(inlets_, &input, &Inlet::input);
  if (inlet == inlets_.end()) return not_open(input);
  // Shared: a thread that answers too late still uses it.
  struct Writing {
    types::Value value;
    component::WriteStatus status = component::WriteStatus::kNotConnected;
  };
  const auto writing = std::make_shared<Writing>(Writing{value});
  component::OutputPortBase& writer = *inlet->writer;
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

}  // namespace armature::remote
