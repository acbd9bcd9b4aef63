// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/relay.hpp"

#include <algorithm>
#include <memory>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

#include "armature/remote/inspector.hpp"
#include "inspection_types.hpp"

namespace armature::studio::internal {

/// A body as it is.
struct Encoded {
  std::span<const std::byte> body;
};

void encode(ride::Encoder& to, const Encoded& encoded) { to.put_body(encoded.body); }

namespace {

/// `write` of `struct ItemValue write(String,String)`.
std::string_view name_in(std::string_view canonical) {
  const std::string_view before = canonical.substr(0, canonical.find('('));
  return before.substr(before.find_last_of(' ') + 1);
}

/// What whoever asks may do to the component that it asks about, as the inspector demands it: that
/// anybody may ask is all that its interface says.
ride::Access access_of(const ride::Declaration& declaration) {
  const std::string_view name = name_in(declaration.canonical);
  for (const std::string_view changes : {"write", "change"}) {
    if (name == changes) return ride::Access::kConfigure;
  }
  for (const std::string_view commands : {"call", "begin", "cancel"}) {
    if (name == commands) return ride::Access::kCommand;
  }
  return declaration.access;
}

}  // namespace

Relay::Connection::Connection(const std::string& address)
    : inspector(node.connect(address), remote::Inspector::kName, remote::kInspector) {}

Relay::Relay(std::string name) : Service(remote::kInspector), name_(std::move(name)) {}

void Relay::connect(const std::string& address) {
  auto made = std::make_shared<Connection>(address);
  const std::scoped_lock lock(mutex_);
  connection_.swap(made);
}

void Relay::disconnect() {
  std::shared_ptr<Connection> gone;
  const std::scoped_lock lock(mutex_);
  connection_.swap(gone);
}

std::shared_ptr<Relay::Connection> Relay::connection() const {
  const std::scoped_lock lock(mutex_);
  return connection_;
}

bool Relay::found() const {
  const auto run = connection();
  return run != nullptr && run->inspector.found();
}

ride::Executed Relay::execute(ride::Number operation, ride::Decoder& parameters,
                              ride::Reply& reply) {
  const auto& all = interface().declarations;
  const auto declaration = std::ranges::find(all, operation, &ride::Declaration::number);
  if (declaration == all.end()) return ride::Executed::kNoSuchOperation;
  reply.demand(name_, access_of(*declaration));
  const auto run = connection();
  if (run == nullptr) throw ride::Failure("nothing runs");
  const Encoded asked{parameters.take_rest()};
  const auto owed = std::make_shared<ride::PendingReply>(reply.keep());
  const auto hand_back = [owed](ride::Code code, std::string_view text,
                                std::span<const std::byte> result) {
    if (code == ride::Code::kNone) {
      owed->put(Encoded{result});
    } else {
      owed->fail(text);
    }
  };
  run->inspector.ask(operation, {}, ride::Fields(std::tie(asked)), hand_back);
  return ride::Executed::kDone;
}

}  // namespace armature::studio::internal
