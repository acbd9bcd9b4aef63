// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/node.hpp"

#include <utility>

#include "armature/ride/internal/node/node_state.hpp"

namespace armature::ride {

std::string who(const AccessQuestion& question) {
  if (question.identity.empty()) {
    const bool here = question.transport == "unix" || question.transport == "tcp";
    return here ? "local" : "nobody@" + std::string(question.transport);
  }
  if (question.transport == "unix") return "local:" + std::string(question.identity);
  const bool page = question.transport == "ws" || question.transport == "wss";
  // A program that comes over wss with a certificate is who it is over tls.
  if (page && question.identity.ends_with("@tls")) return std::string(question.identity);
  return std::string(question.identity) + "@" + std::string(page ? "web" : question.transport);
}

Node::Node(NodeOptions options)
    : state_(std::make_shared<internal::NodeState>(std::move(options))) {
  state_->start();
}

Node::~Node() { state_->stop(); }

base::Result<Address> Node::listen(const std::string& address) { return state_->listen(address); }

base::Result<std::uint32_t> Node::add(std::string name, Service& service) {
  return state_->add(std::move(name), service);
}

void Node::remove(Service& service) { state_->remove(service); }

Peer& Node::connect(const std::string& address) { return state_->connect(address); }

NodeStatistics Node::statistics() const { return state_->statistics(); }

}  // namespace armature::ride
