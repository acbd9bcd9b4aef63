// SPDX-License-Identifier: Apache-2.0
#include "armature/foxglove/internal/session.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "armature/base/quoted.hpp"
#include "armature/foxglove/internal/inside_transport.hpp"
#include "armature/foxglove/internal/scene_schemas.hpp"

namespace armature::foxglove::internal {
namespace {

using namespace std::chrono_literals;

constexpr base::Duration kTextsPeriod = 200ms;
constexpr base::Duration kSecond = 1s;
constexpr base::Duration kUntilAllowed = 30s;
/// Before the path of a robot's description.
constexpr std::string_view kAssets = "robot_description:";

ride::NodeOptions by(std::unique_ptr<ride::Connection> inside) {
  ride::NodeOptions options;
  options.name = kIdentity;
  options.transports.push_back(std::make_shared<InsideTransport>(std::move(inside)));
  return options;
}

bool is_due(base::Time& next, base::Time now, base::Duration period) {
  if (now < next) return false;
  next = now + period;
  return true;
}

bool are_same(const std::vector<inspect::ComponentStatus>& a,
              const std::vector<inspect::ComponentStatus>& b) {
  return std::ranges::equal(
      a, b, [](const auto& x, const auto& y) { return x.name == y.name && x.model == y.model; });
}

Channel of_robots(Channel::Kind kind, const char* topic, const char* schema_name,
                  std::string schema) {
  Channel channel;
  channel.advertised = {0, topic, schema_name, std::move(schema)};
  channel.kind = kind;
  return channel;
}

}  // namespace

Session::Session(websocket::Messages& messages, std::uint32_t client,
                 std::unique_ptr<ride::Connection> inside, const ServerOptions& options)
    : outlet_(messages, client),
      node_(by(std::move(inside))),
      peer_(node_.connect(InsideTransport::kAddress)),
      view_(peer_, options.inspector),
      companion_(options.companion(peer_)),
      subscriptions_(view_, channels_, outlet_),
      parameters_(view_, outlet_) {
  outlet_.tell(server_info("Armature", std::to_string(client)));
}

// --- what the client asks for --------------------------------------------------------------------

void Session::take(bool text, std::string_view content) {
  if (!text) return outlet_.warn("nothing is published or called by Foxglove");
  const auto request = parse_request(content);
  if (!request) return outlet_.warn(request.error());
  try {
    answer(request.value());
  } catch (const inspect::NoAnswer& why) {
    outlet_.warn(why.what());
  }
}

void Session::answer(const Request& request) {
  const auto answered = [this](const auto& one) {
    using T = std::decay_t<decltype(one)>;
    if constexpr (std::is_same_v<T, Subscribe>) {
      subscriptions_.subscribe(one);
    } else if constexpr (std::is_same_v<T, Unsubscribe>) {
      subscriptions_.unsubscribe(one);
    } else if constexpr (std::is_same_v<T, GetParameters>) {
      parameters_.get(one);
    } else if constexpr (std::is_same_v<T, SetParameters>) {
      parameters_.set(one);
    } else if constexpr (std::is_same_v<T, SubscribeParameters>) {
      parameters_.subscribe(one);
    } else if constexpr (std::is_same_v<T, UnsubscribeParameters>) {
      parameters_.unsubscribe(one);
    } else {
      outlet_.tell_binary(asset(one.request, asset_at(one.uri)));
    }
  };
  std::visit(answered, request);
}

/// A robot's description: nothing else of the machine is given away.
base::Result<std::string> Session::asset_at(const std::string& uri) {
  for (const NamedRobot& robot : robots_) {
    if (uri == std::string(kAssets) + robot.path) return companion_->description(robot.path);
  }
  std::string expected;
  for (const NamedRobot& robot : robots_) expected += ", " + std::string(kAssets) + robot.path;
  return base::Error{"unknown " + base::quoted(uri) + ": there is " +
                     (expected.empty() ? "nothing" : expected.substr(2))};
}

// --- what it is told -----------------------------------------------------------------------------

void Session::look(base::Time now) {
  try {
    if (is_due(next_second_, now, kSecond)) {
      companion_->attend();
      follow();
      if (there_) parameters_.look();
      tell_losses();
    }
    if (!there_ || !is_due(next_values_, now, Subscriptions::kInterval)) return;
    const base::Time time = view_.status().time;
    if (std::exchange(time_told_, time) != time) outlet_.offer(time_message(time));
    subscriptions_.send(time);
    if (is_due(next_texts_, now, kTextsPeriod)) subscriptions_.send_texts(time);
  } catch (const inspect::NoAnswer& why) {
    lose();
    if (!std::string_view(why.what()).starts_with("not allowed")) return;
    // Each refusal is logged there: it is not asked for again at once.
    next_second_ = now + kUntilAllowed;
    if (std::exchange(told_refusal_, why.what()) != why.what()) outlet_.warn(why.what());
  }
}

void Session::follow() {
  if (!view_.connected()) return lose();
  view_.forget();
  if (!view_.has_application()) return lose();
  auto components = view_.components();
  if (there_ && are_same(components, components_)) return;
  describe(std::move(components));
}

void Session::describe(std::vector<inspect::ComponentStatus> components) {
  std::vector<inspect::ComponentDescription> descriptions;
  std::vector<Channel> channels;
  for (const auto& one : components) {
    descriptions.push_back(view_.describe(one.name, inspect::Values::kIncluded));
    std::ranges::move(channels_of(descriptions.back()), std::back_inserter(channels));
  }
  std::vector<MovedRobot> moved = robots(descriptions);
  if (!moved.empty()) {
    channels.push_back(
        of_robots(Channel::Kind::kTransforms, "/tf", kTransformsName, transforms_schema()));
    channels.push_back(of_robots(Channel::Kind::kScene, "/scene", kSceneName, scene_schema()));
  }
  tell(channels_.replace(std::move(channels)));
  subscriptions_.replace(std::move(moved));
  parameters_.replace(descriptions);
  components_ = std::move(components);
  there_ = true;
}

std::vector<MovedRobot> Session::robots(
    const std::vector<inspect::ComponentDescription>& components) {
  robots_ = robots_of(components);
  const auto chosen =
      robots_.empty() ? std::map<std::string, std::string>() : companion_->chosen_ports();
  std::vector<MovedRobot> all;
  for (const NamedRobot& one : robots_) {
    const auto text = companion_->description(one.path);
    auto scene = text ? RobotScene::make(text.value(), one,
                                         robots_.size() > 1 ? one.owner + "/" : std::string())
                      : base::Result<RobotScene>(base::Error{text.error()});
    if (!scene) {
      outlet_.warn("the robot of " + base::quoted(one.owner) + " is not drawn: " + scene.error());
      continue;
    }
    const auto port = chosen.find(one.owner);
    const auto source = joint_source(components, one.owner, scene.value().joints(),
                                     port == chosen.end() ? std::string() : port->second);
    if (!source) {
      outlet_.warn("the robot of " + base::quoted(one.owner) + " stands still: " + source.error());
    }
    all.push_back(
        {std::move(scene).value(), source ? source.value().items : std::vector<std::string>()});
  }
  return all;
}

void Session::tell(const ChannelList::Change& change) {
  if (!change.gone.empty()) outlet_.tell(unadvertise(change.gone));
  if (!change.came.empty()) outlet_.tell(advertise(change.came));
}

void Session::lose() {
  if (!std::exchange(there_, false)) return;
  view_.forget();
  tell(channels_.replace({}));
  subscriptions_.lose();
  subscriptions_.replace({});
  parameters_.replace({});
  robots_.clear();
}

void Session::tell_losses() {
  const std::uint64_t lost = outlet_.lost() - std::exchange(told_lost_, outlet_.lost());
  if (lost == 0) return;
  outlet_.warn(std::to_string(lost) +
               " values were lost, because this client or the way to it is too slow: subscribe to "
               "fewer channels");
}

}  // namespace armature::foxglove::internal
