// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/network.hpp"

#include <utility>

#include "armature/base/quoted.hpp"
#include "armature/control/dynamics/robot_frames.hpp"
#include "armature/platform/file.hpp"
#include "armature/tls/transport.hpp"

namespace armature::cli {
namespace {

/// The robots of this process' application: their descriptions are files of this machine.
class OwnDescriptions final : public foxglove::Companion {
 public:
  base::Result<std::string> description(const std::string& path) override {
    constexpr std::size_t kMostBytes = 4u << 20;
    auto text = platform::read_file(path, kMostBytes);
    if (!text) return text;
    // No other file is given away, whatever a property names.
    const auto robot = control::RobotFrames::parse(text.value());
    if (!robot) return base::Error{base::quoted(path) + ": " + robot.error()};
    return text;
  }
};

}  // namespace

deploy::MakePlaceholder NetworkOnDemand::placeholders() {
  return
      [this](const document::Component& written, std::unique_ptr<component::Component> prototype) {
        return network().make_placeholder(written, std::move(prototype));
      };
}

deploy::MakeInlets NetworkOnDemand::inlets() {
  return [this](const std::vector<component::InputPortBase*>& inputs) {
    using Made = base::Result<std::unique_ptr<component::Component>>;
    return Made(network().make_inlets(inputs));
  };
}

void NetworkOnDemand::check(const document::Document& document, base::Diagnostics& diagnostics) {
  if (wanted(document, {})) network().check(document, diagnostics);
}

bool NetworkOnDemand::wanted(const document::Document& document,
                             const RunArguments& arguments) const {
  return network_ != nullptr || !document.network.listen.empty() || !arguments.listen.empty();
}

bool NetworkOnDemand::open(const document::Document& document, const RunArguments& arguments,
                           exec::Application& application) {
  if (!wanted(document, arguments)) return true;
  base::Diagnostics diagnostics;
  network().open(document, arguments.listen, application, diagnostics);
  for (const std::string& address : network().addresses()) {
    console_.say(rt::LogLevel::kInfo, "listens at " + address);
  }
  for (const auto& transport : web_) {
    const bool anywhere = transport->scheme() == "wss";
    for (const std::string& page : transport->pages()) {
      console_.say(rt::LogLevel::kInfo,
                   "open " + page + " in a browser" + (anywhere ? "" : " of this machine"));
    }
  }
  for (const auto& messages : messages_) {
    for (const std::string& address : messages->addresses()) {
      console_.say(rt::LogLevel::kInfo, "Foxglove finds it at " + address);
    }
  }
  console_.show(diagnostics);
  return diagnostics.ok();
}

std::shared_ptr<websocket::Messages> NetworkOnDemand::serve_foxglove() {
  messages_.push_back(foxglove::make_messages());
  foxglove::ServerOptions options;
  options.companion = [](ride::Peer&) { return std::make_unique<OwnDescriptions>(); };
  foxglove_.push_back(std::make_unique<foxglove::Server>(messages_.back(), std::move(options)));
  return messages_.back();
}

void NetworkOnDemand::serve() {
  if (network_ != nullptr) network_->serve();
}

void NetworkOnDemand::leave() {
  if (network_ != nullptr) network_->leave();
}

remote::Network& NetworkOnDemand::network() {
  if (network_ != nullptr) return *network_;
  remote::NetworkOptions options;
  options.tls = [](const document::Network& files, base::Diagnostics& problems) {
    return tls::make_client_transport(
        {files.certificate.name, files.key.name, files.authority.name}, problems);
  };
  options.web = [this](const document::Network& files, base::Diagnostics& problems) {
    const bool pages = !files.pages.name.empty();
    auto transport = websocket::make_transport({.pages = files.pages.name,
                                                .certificate = files.certificate.name,
                                                .key = files.key.name,
                                                .authority = files.authority.name,
                                                .tokens = tokens_,
                                                .messages = pages ? serve_foxglove() : nullptr},
                                               problems);
    if (transport != nullptr) web_.push_back(transport);
    return transport;
  };
  options.policy = policy_;
  options.log = [this](const rt::LogRecord& record) { console_.log(record); };
  network_ = remote::make_network(options);
  return *network_;
}

}  // namespace armature::cli
