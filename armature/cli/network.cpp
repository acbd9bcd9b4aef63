// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/network.hpp"

#include <utility>

#include "armature/cli/loaded.hpp"
#include "armature/cli/tls.hpp"

namespace armature::cli {
namespace {

constexpr const char* kRemoteLibrary = "libarmature_remote.so";

}  // namespace

deploy::MakePlaceholder NetworkOnDemand::placeholders() {
  return
      [this](const document::Component& written, std::unique_ptr<component::Component> prototype) {
        using Made = base::Result<std::unique_ptr<component::Component>>;
        base::Diagnostics problems;
        remote::Network* const network = load(problems);
        if (network == nullptr) return Made(base::Error{problems.to_text()});
        return network->make_placeholder(written, std::move(prototype));
      };
}

deploy::MakeInlets NetworkOnDemand::inlets() {
  return [this](const std::vector<component::InputPortBase*>& inputs) {
    using Made = base::Result<std::unique_ptr<component::Component>>;
    base::Diagnostics problems;
    remote::Network* const network = load(problems);
    if (network == nullptr) return Made(base::Error{problems.to_text()});
    return Made(network->make_inlets(inputs));
  };
}

void NetworkOnDemand::check(const document::Document& document, base::Diagnostics& diagnostics) {
  if (!wanted(document, {})) return;
  if (remote::Network* const network = load(diagnostics)) network->check(document, diagnostics);
}

bool NetworkOnDemand::wanted(const document::Document& document,
                             const RunArguments& arguments) const {
  return network_ != nullptr || !document.network.listen.empty() || !arguments.listen.empty();
}

bool NetworkOnDemand::open(const document::Document& document, const RunArguments& arguments,
                           exec::Application& application) {
  if (!wanted(document, arguments)) return true;
  base::Diagnostics diagnostics;
  if (remote::Network* const network = load(diagnostics)) {
    network->open(document, arguments.listen, application, diagnostics);
    for (const std::string& address : network->addresses()) {
      console_.say(rt::LogLevel::kInfo, "listens at " + address);
    }
  }
  console_.show(diagnostics);
  return diagnostics.ok();
}

void NetworkOnDemand::serve() {
  if (network_ != nullptr) network_->serve();
}

void NetworkOnDemand::leave() {
  if (network_ != nullptr) network_->leave();
}

remote::Network* NetworkOnDemand::load(base::Diagnostics& diagnostics) {
  if (network_ != nullptr) return network_.get();
  void* const make = load_function(kRemoteLibrary, remote::kMakeNetwork,
                                   "communication with other processes needs", diagnostics);
  if (make == nullptr) return nullptr;
  remote::NetworkOptions options;
  options.tls = [](const document::Network& files, base::Diagnostics& problems) {
    return load_tls({files.certificate.name, files.key.name, files.authority.name}, problems);
  };
  options.log = [this](const rt::LogRecord& record) { console_.log(record); };
  network_.reset(reinterpret_cast<remote::MakeNetwork>(make)(options));
  return network_.get();
}

}  // namespace armature::cli
