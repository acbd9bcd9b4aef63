// SPDX-License-Identifier: Apache-2.0
#include "armature/foxglove/internal/protocol.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <initializer_list>

#include "armature/base/quoted.hpp"

namespace armature::foxglove::internal {
namespace {

/// So many names, subscriptions or parameters in one message; a whole application has fewer.
constexpr std::size_t kMostEntries = 10'000;
constexpr std::size_t kLongestName = 1000;
constexpr int kDeepest = 32;

/// Why a message of a client is none.
struct Malformed {
  std::string text;
};

[[noreturn]] void expected(const std::string& what) { throw Malformed{"expected " + what}; }

const Json& entries_of(const Json& json, const char* name) {
  const auto found = json.find(name);
  if (found == json.end() || !found->is_array() || found->size() > kMostEntries) {
    expected("the list " + base::quoted(name));
  }
  return *found;
}

std::uint32_t number_in(const Json& json) {
  if (!json.is_number_unsigned() || json.get<std::uint64_t>() > UINT32_MAX) {
    expected("a number from 0 to 4294967295");
  }
  return json.get<std::uint32_t>();
}

std::uint32_t number_of(const Json& json, const char* name) {
  const auto found = json.is_object() ? json.find(name) : json.end();
  if (!json.is_object() || found == json.end()) expected("the number " + base::quoted(name));
  return number_in(*found);
}

std::string text_in(const Json& json) {
  if (!json.is_string() || json.get_ref<const std::string&>().size() > kLongestName) {
    expected("a text of at most 1000 characters");
  }
  return json.get<std::string>();
}

std::string text_at(const Json& json, const char* name) {
  const auto found = json.is_object() ? json.find(name) : json.end();
  if (!json.is_object() || found == json.end()) expected("the text " + base::quoted(name));
  return text_in(*found);
}

std::optional<std::string> id_of(const Json& json) {
  const auto found = json.find("id");
  return found == json.end() ? std::nullopt : std::optional(text_in(*found));
}

std::vector<std::string> names_in(const Json& json) {
  std::vector<std::string> names;
  for (const Json& one : entries_of(json, "parameterNames")) names.push_back(text_in(one));
  return names;
}

Request subscribe(const Json& json) {
  Subscribe request;
  for (const Json& one : entries_of(json, "subscriptions")) {
    request.subscriptions.emplace_back(number_of(one, "id"), number_of(one, "channelId"));
  }
  return request;
}

Request unsubscribe(const Json& json) {
  Unsubscribe request;
  for (const Json& one : entries_of(json, "subscriptionIds")) {
    request.subscriptions.push_back(number_in(one));
  }
  return request;
}

Request set_parameters(const Json& json) {
  SetParameters request{{}, id_of(json)};
  for (const Json& one : entries_of(json, "parameters")) {
    const std::string name = text_at(one, "name");
    const auto value = one.find("value");
    request.parameters.push_back({name, value == one.end() ? Json() : *value});
  }
  return request;
}

Request request_in(const Json& json) {
  const std::string op = text_at(json, "op");
  if (op == "subscribe") return subscribe(json);
  if (op == "unsubscribe") return unsubscribe(json);
  if (op == "getParameters") return GetParameters{names_in(json), id_of(json)};
  if (op == "setParameters") return set_parameters(json);
  if (op == "subscribeParameterUpdates") return SubscribeParameters{names_in(json)};
  if (op == "unsubscribeParameterUpdates") return UnsubscribeParameters{names_in(json)};
  if (op == "fetchAsset") return FetchAsset{text_at(json, "uri"), number_of(json, "requestId")};
  throw Malformed{base::quoted(op) + " is not offered: nothing is published, called or commanded " +
                  "by Foxglove"};
}

/// Each member of an object is compared with those before it, so that very many of them would take
/// the time of other clients.
class KeyLimit {
 public:
  static constexpr int kMost = 256;

  bool allows(int depth, Json::parse_event_t event) {
    using Event = Json::parse_event_t;
    const auto place = static_cast<std::size_t>(depth);
    if (event == Event::object_start) counts_.at(place + 1) = 0;
    if (event == Event::key && ++counts_.at(place) > kMost) exceeded_ = true;
    return !exceeded_;
  }
  bool exceeded() const { return exceeded_; }

 private:
  std::array<int, kDeepest + 2> counts_{};  ///< of the object that is read at each depth
  bool exceeded_ = false;
};

template <std::unsigned_integral Number>
void put(Number number, std::string& to) {
  for (std::size_t i = 0; i < sizeof number; ++i) {
    to += static_cast<char>(static_cast<unsigned char>(number >> (8 * i)));
  }
}

std::uint64_t ns_of(base::Time time) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(base::to_ns(time), 0));
}

}  // namespace

base::Result<Request> parse_request(std::string_view text) {
  KeyLimit keys;
  // Deeper values are left out: copies of them go as deep.
  const auto sensible = [&](int depth, Json::parse_event_t event, Json&) {
    return depth <= kDeepest && keys.allows(depth, event);
  };
  const Json json = Json::parse(text, sensible, false);
  if (keys.exceeded()) {
    return base::Error{"an object of a message has at most " + std::to_string(KeyLimit::kMost) +
                       " members"};
  }
  if (!json.is_object()) return base::Error{"expected a message in JSON, an object"};
  try {
    return request_in(json);
  } catch (const Malformed& problem) {
    return base::Error{problem.text};
  }
}

std::string server_info(const std::string& name, const std::string& session) {
  return text_of({{"op", "serverInfo"},
                  {"name", name},
                  {"capabilities", {"time", "parameters", "parametersSubscribe", "assets"}},
                  {"supportedEncodings", Json::array()},
                  {"metadata", Json::object()},
                  {"sessionId", session}});
}

std::string advertise(const std::vector<Advertised>& channels) {
  Json all = Json::array();
  for (const Advertised& one : channels) {
    all.push_back({{"id", one.id},
                   {"topic", one.topic},
                   {"encoding", "json"},
                   {"schemaName", one.schema_name},
                   {"schema", one.schema},
                   {"schemaEncoding", "jsonschema"}});
  }
  return text_of({{"op", "advertise"}, {"channels", all}});
}

std::string unadvertise(const std::vector<std::uint32_t>& channels) {
  return text_of({{"op", "unadvertise"}, {"channelIds", channels}});
}

std::string status(Level level, const std::string& text) {
  return text_of(
      {{"op", "status"}, {"level", static_cast<std::uint8_t>(level)}, {"message", text}});
}

std::string parameter_values(const std::vector<Parameter>& parameters,
                             const std::optional<std::string>& id) {
  Json all = Json::array();
  for (const Parameter& one : parameters) {
    Json parameter{{"name", one.name}, {"value", one.value}};
    const bool list = one.value.is_array() && !one.value.empty() &&
                      std::ranges::all_of(one.value, [](const Json& x) { return x.is_number(); });
    if (one.value.is_number()) parameter["type"] = "float64";
    if (list) parameter["type"] = "float64_array";
    all.push_back(parameter);
  }
  Json message{{"op", "parameterValues"}, {"parameters", all}};
  if (id) message["id"] = *id;
  return text_of(message);
}

std::string message_data(std::uint32_t subscription, base::Time time, std::string_view json) {
  std::string message(1, '\x01');
  put(subscription, message);
  put(ns_of(time), message);
  message += json;
  return message;
}

std::string time_message(base::Time time) {
  std::string message(1, '\x02');
  put(ns_of(time), message);
  return message;
}

std::string asset(std::uint32_t request, const base::Result<std::string>& content) {
  std::string message(1, '\x04');
  put(request, message);
  message += content ? '\0' : '\x01';
  const std::string error = content ? std::string() : content.error();
  put(static_cast<std::uint32_t>(error.size()), message);
  message += error;
  if (content) message += content.value();
  return message;
}

}  // namespace armature::foxglove::internal
