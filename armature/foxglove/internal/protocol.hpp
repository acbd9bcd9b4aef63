// SPDX-License-Identifier: Apache-2.0
#pragma once

// The messages of Foxglove's WebSocket protocol, `foxglove.websocket.v1`
// (https://github.com/foxglove/ws-protocol/blob/main/docs/spec.md), as far as they are offered.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/foxglove/internal/json.hpp"

namespace armature::foxglove::internal {

inline constexpr const char* kSubprotocol = "foxglove.websocket.v1";

// --- what a client asks for ----------------------------------------------------------------------

/// A name and what it is, or is to be.
struct Parameter {
  std::string name;
  Json value;
};

struct Subscribe {
  /// The client's number of a subscription, and the channel.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> subscriptions;
};
struct Unsubscribe {
  std::vector<std::uint32_t> subscriptions;
};
struct GetParameters {
  std::vector<std::string> names;  ///< empty: all
  std::optional<std::string> id;
};
struct SetParameters {
  std::vector<Parameter> parameters;
  std::optional<std::string> id;
};
struct SubscribeParameters {
  std::vector<std::string> names;  ///< empty: all
};
struct UnsubscribeParameters {
  std::vector<std::string> names;  ///< empty: all
};
struct FetchAsset {
  std::string uri;
  std::uint32_t request = 0;
};
using Request = std::variant<Subscribe, Unsubscribe, GetParameters, SetParameters,
                             SubscribeParameters, UnsubscribeParameters, FetchAsset>;

/// A message of a client, whoever that is. The error says what was expected.
base::Result<Request> parse_request(std::string_view text);

// --- what it is told -----------------------------------------------------------------------------

/// As clients show it.
enum class Level : std::uint8_t { kInfo, kWarning, kError };

/// What a client may subscribe to.
struct Advertised {
  std::uint32_t id = 0;
  std::string topic;
  std::string schema_name;
  std::string schema;  ///< JSON Schema
};

std::string server_info(const std::string& name, const std::string& session);
std::string advertise(const std::vector<Advertised>& channels);
std::string unadvertise(const std::vector<std::uint32_t>& channels);
std::string status(Level level, const std::string& text);
std::string parameter_values(const std::vector<Parameter>& parameters,
                             const std::optional<std::string>& id);
/// Binary messages: a value, the time, a file.
std::string message_data(std::uint32_t subscription, base::Time time, std::string_view json);
std::string time_message(base::Time time);
std::string asset(std::uint32_t request, const base::Result<std::string>& content);

}  // namespace armature::foxglove::internal
