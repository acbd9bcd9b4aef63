// SPDX-License-Identifier: Apache-2.0
#include "python/native/deployed.hpp"

#include <algorithm>

#include <pybind11/stl.h>

#include "armature/base/quoted.hpp"
#include "armature/component/interface.hpp"
#include "armature/document/document.hpp"
#include "armature/inspect/view.hpp"
#include "armature/remote/interface_file.hpp"
#include "armature/rt/log.hpp"
#include "armature/tls/transport.hpp"
#include "armature/websocket/transport.hpp"
#include "python/native/bindings.hpp"

namespace armature::python {
namespace {

namespace py = pybind11;

/// Finds what is wrong with a network's files, as `armature check` does; nothing listens.
std::unique_ptr<remote::Network> make_network() {
  remote::NetworkOptions options;
  options.tls = [](const document::Network& files, base::Diagnostics& problems) {
    return tls::make_client_transport(
        {files.certificate.name, files.key.name, files.authority.name}, problems);
  };
  options.web = [](const document::Network& files, base::Diagnostics& problems) {
    return websocket::make_transport({.pages = files.pages.name,
                                      .certificate = files.certificate.name,
                                      .key = files.key.name,
                                      .authority = files.authority.name},
                                     problems);
  };
  options.log = [](const rt::LogRecord&) {};
  return remote::make_network(options);
}

deploy::DeploymentOptions options_for(const Request& request, const ModelsOfLoad& models,
                                      remote::Network& network) {
  deploy::DeploymentOptions options;
  options.document.overrides = request.overrides;
  options.library_folders = request.library_folders;
  options.make_placeholder = [&network](const document::Component& written,
                                        std::unique_ptr<component::Component> prototype) {
    return network.make_placeholder(written, std::move(prototype));
  };
  options.make_inlets = [&network](const std::vector<component::InputPortBase*>& inputs) {
    using Made = base::Result<std::unique_ptr<component::Component>>;
    return Made(network.make_inlets(inputs));
  };
  options.read_interface = remote::read_interface;
  options.models = [&models](component::Registry& registry) { models.add_to(registry); };
  return options;
}

deploy::Deployment load_with_models(const Request& request, remote::Network& network) {
  const ModelsOfLoad models(request.models);
  const deploy::DeploymentOptions options = options_for(request, models, network);
  return request.text.empty() ? deploy::load_deployment(request.file, options)
                              : deploy::parse_deployment(request.text, request.file, options);
}

}  // namespace

Deployed::Deployed(const Request& request)
    : network_(make_network()), deployment_(load_with_models(request, *network_)) {
  if (!deployment_.document.network.listen.empty()) {
    network_->check(deployment_.document, deployment_.diagnostics);
  }
}

std::vector<std::string> Deployed::writers() const {
  std::vector<std::string> names;
  for (const exec::ComponentEntry& entry : deployment_.blueprint.components) {
    const auto& outputs = component::interface_of(*entry.component).outputs;
    if (!outputs.empty()) names.push_back(entry.component->name());
  }
  return names;
}

void Deployed::expect_alone() const {
  for (const document::Component& one : deployment_.document.components) {
    if (one.remote.name.empty()) continue;
    throw inspect::Refusal(base::quoted(one.name) + " lives in another process, at " +
                           one.remote.name +
                           ": an application in Python runs alone; give it a model here");
  }
}

bool Deployed::has_model(const std::string& model) const {
  return std::ranges::any_of(deployment_.document.components,
                             [&](const auto& one) { return one.model == model; });
}

void bind_deployment(py::module_& module) {
  py::class_<Deployed, std::shared_ptr<Deployed>>(module, "Deployed")
      .def(py::init([](std::string file, std::string text, std::vector<std::string> overrides,
                       std::vector<std::string> library_folders,
                       const std::vector<std::shared_ptr<Model>>& models) {
             const Request request{std::move(file),
                                   std::move(text),
                                   std::move(overrides),
                                   std::move(library_folders),
                                   {models.begin(), models.end()}};
             const py::gil_scoped_release others_run;
             return std::make_shared<Deployed>(request);
           }),
           py::arg("file"), py::arg("text"), py::arg("overrides"), py::arg("library_folders"),
           py::arg("models"))
      .def_property_readonly("diagnostics",
                             [](const Deployed& self) { return self.diagnostics().all(); })
      .def_property_readonly("ok", [](const Deployed& self) { return self.diagnostics().ok(); })
      .def_property_readonly("name", &Deployed::name)
      .def("writers", &Deployed::writers)
      .def("has_model", &Deployed::has_model);
}

}  // namespace armature::python
