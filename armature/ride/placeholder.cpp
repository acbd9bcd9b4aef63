// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/placeholder.hpp"

#include <utility>

#include "armature/ride/internal/peer_state.hpp"

namespace armature::ride {

Peer::Peer(std::shared_ptr<internal::PeerState> state) : state_(std::move(state)) {}
Peer::~Peer() = default;

const std::string& Peer::address() const { return state_->text(); }
bool Peer::connected() const { return state_->connected(); }
std::uint64_t Peer::losses() const { return state_->losses(); }

base::Result<void> Peer::wait_until_connected(base::Duration limit) const {
  return state_->wait_until_connected(limit);
}

base::Result<std::vector<PeerComponent>> Peer::components(base::Duration limit) const {
  return state_->components(limit);
}

Subscription Peer::on_change(std::function<void(const PeerChange&)> handler) {
  return state_->on_change(std::move(handler));
}

Placeholder::Placeholder(Peer& peer, std::string name, const Interface& interface)
    : peer_(peer), component_(peer.state()->component(std::move(name), interface)) {}

Placeholder::~Placeholder() = default;

const std::string& Placeholder::name() const { return component_->name; }
const Interface& Placeholder::interface() const { return *component_->interface; }

bool Placeholder::found() const {
  return component_->state.load() == internal::RemoteComponent::State::kFound;
}

Code Placeholder::call(Number number, std::string_view operation, const CallOptions& options,
                       const Fields& parameters, const Place& result, std::string& error) {
  internal::WaitingCall call(result);
  peer_.state()->request(*component_, number, options, parameters, call);
  if (call.code != Code::kNone) {
    error = error_text(operation, std::string(name_of(call.code)) + ": " + call.text);
  }
  return call.code;
}

Sent Placeholder::send(Number number, Priority priority, const Fields& parameters) {
  return peer_.state()->link().send(priority, Type::kCommand,
                                    internal::Recipient(component_->identifier), {number},
                                    parameters, internal::Link::Flush::kGather);
}

void Placeholder::ask(Number number, Priority priority, const Fields& parameters, Then then) {
  peer_.state()->link().call(number, priority, internal::Recipient(component_->identifier),
                             parameters, std::make_unique<internal::CallbackCall>(std::move(then)));
}

Subscription Placeholder::subscribe(Number event, std::function<bool(Decoder&)> handler) {
  return peer_.state()->subscribe(component_, event, std::move(handler));
}

std::string Placeholder::error_text(std::string_view operation, std::string_view problem) const {
  std::string text = "'" + name() + "' at " + peer_.address() + ", ";
  text.append(operation).append(": ").append(problem);
  return text;
}

}  // namespace armature::ride
