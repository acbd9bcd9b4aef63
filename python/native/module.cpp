// SPDX-License-Identifier: Apache-2.0
#include "python/native/bindings.hpp"

PYBIND11_MODULE(_native, module) {
  using namespace armature::python;
  module.doc() = "The runtime of Armature, as the package `armature` uses it.";
  bind_errors(module);
  bind_error_metrics(module);
  bind_diagnostics(module);
  bind_descriptions(module);
  bind_components(module);
  bind_deployment(module);
  bind_simulation(module);
  bind_recording(module);
  bind_connection(module);
}
