// SPDX-License-Identifier: Apache-2.0
#include "armature/foxglove/internal/subscriptions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "armature/base/seconds.hpp"
#include "armature/foxglove/internal/flow_json.hpp"

namespace armature::foxglove::internal {
namespace {

/// Ages and the clock are asked for one after the other: what was written within such a time is one
/// and the same.
constexpr base::Duration kSame = std::chrono::milliseconds(5);
constexpr std::size_t kMostSubscriptions = 10'000;
constexpr std::size_t kTextsAtOnce = 200;

/// Nothing if it was never written.
std::optional<base::Time> written(base::Time now, double age) {
  if (!std::isfinite(age) || age < 0.0) return std::nullopt;
  return std::max(base::Time{}, now - base::from_seconds(std::min(age, 1e9)));
}

}  // namespace

void Subscriptions::subscribe(const Subscribe& request) {
  for (const auto& [id, channel] : request.subscriptions) {
    const Channel* const found = channels_.find(channel);
    if (found == nullptr) {
      outlet_.warn("there is no channel " + std::to_string(channel));
    } else if (subscriptions_.contains(id) || subscriptions_.size() >= kMostSubscriptions) {
      outlet_.warn("there is a subscription " + std::to_string(id) + " already, or too many");
    } else {
      subscriptions_[id] = channel;
      if (found->kind == Channel::Kind::kScene) new_scenes_.insert(id);
      changed_ = true;
    }
  }
}

void Subscriptions::unsubscribe(const Unsubscribe& request) {
  for (const std::uint32_t id : request.subscriptions) {
    if (subscriptions_.erase(id) > 0) changed_ = true;
    new_scenes_.erase(id);
    sent_texts_.erase(id);
  }
}

void Subscriptions::replace(std::vector<MovedRobot> robots) {
  robots_ = std::move(robots);
  std::erase_if(subscriptions_,
                [this](const auto& one) { return channels_.find(one.second) == nullptr; });
  new_scenes_.clear();
  for (const auto& [id, channel] : subscriptions_) {
    if (channels_.find(channel)->kind == Channel::Kind::kScene) new_scenes_.insert(id);
  }
  changed_ = true;
}

void Subscriptions::lose() {
  watch_.reset();
  streams_.clear();
  moved_.clear();
  changed_ = true;
}

bool Subscriptions::wants(Channel::Kind kind) const {
  return std::ranges::any_of(subscriptions_, [&](const auto& one) {
    const Channel* const channel = channels_.find(one.second);
    return channel != nullptr && channel->kind == kind;
  });
}

std::vector<std::string> Subscriptions::wanted_items() const {
  std::vector<std::string> items;
  const auto add = [&](const std::string& item) {
    if (std::ranges::count(items, item) == 0) items.push_back(item);
  };
  for (const auto& [id, number] : subscriptions_) {
    const Channel* const channel = channels_.find(number);
    if (channel != nullptr && channel->kind == Channel::Kind::kNumbers) {
      add(channel->advertised.topic);
    }
  }
  if (!wants(Channel::Kind::kTransforms)) return items;
  for (const MovedRobot& robot : robots_) std::ranges::for_each(robot.items, add);
  return items;
}

/// The numbers of an item, which come one after the other.
Subscriptions::Part Subscriptions::part_of(const std::string& item,
                                           const std::vector<inspect::WatchedItem>& given) {
  const auto is_of_it = [&](const inspect::WatchedItem& one) {
    if (!one.item.starts_with(item)) return false;
    const char next = one.item.size() == item.size() ? '\0' : one.item[item.size()];
    return next == '\0' || next == '[' || next == '.';
  };
  Part part{item, {}};
  const auto first = std::ranges::find_if(given, is_of_it);
  part.begin = static_cast<std::size_t>(first - given.begin());
  for (auto one = first; one != given.end() && is_of_it(*one); ++one) {
    part.paths.push_back(one->item.substr(item.size()));
  }
  return part;
}

/// All of them, or without those that the application does not watch.
inspect::Watch Subscriptions::watch_what_can_be(const std::vector<std::string>& items) {
  try {
    return view_.watch(items, kInterval);
  } catch (const inspect::Refusal& all) {
    std::vector<std::string> good;
    for (const std::string& item : items) {
      try {
        view_.end_watch(view_.watch({item}, kInterval).handle);
        good.push_back(item);
      } catch (const inspect::Refusal& why) {
        outlet_.warn(why.what());
      }
    }
    if (good.empty()) return {};
    if (good.size() < items.size()) return view_.watch(good, kInterval);
    return watch_as_many_as_can_be(std::move(good), all.what());
  }
}

/// The first of them: each can be watched, but not all together.
inspect::Watch Subscriptions::watch_as_many_as_can_be(std::vector<std::string> items,
                                                      const std::string& why) {
  while (items.size() > 1) {
    items.resize(items.size() / 2);
    try {
      inspect::Watch some = view_.watch(items, kInterval);
      outlet_.warn("values come of the first " + std::to_string(items.size()) +
                   " subscriptions only: " + why);
      return some;
    } catch (const inspect::Refusal&) {
      // Half of these, then.
    }
  }
  outlet_.warn(why);
  return {};
}

void Subscriptions::end_watch() {
  if (watch_) view_.end_watch(*std::exchange(watch_, std::nullopt));
  streams_.clear();
  moved_.clear();
}

void Subscriptions::begin_watch() {
  end_watch();
  moves_at_all_ = false;
  const std::vector<std::string> items = wanted_items();
  inspect::Watch watch;
  if (!items.empty()) watch = watch_what_can_be(items);
  if (!watch.items.empty()) watch_ = watch.handle;
  std::set<std::uint32_t> channels;
  for (const auto& [id, number] : subscriptions_) channels.insert(number);
  for (const std::uint32_t number : channels) {
    const Channel& channel = *channels_.find(number);
    if (channel.kind != Channel::Kind::kNumbers) continue;
    Part part = part_of(channel.advertised.topic, watch.items);
    if (part.paths.empty()) continue;
    NumberText text(channel.shape, part.paths);
    streams_.push_back({number, std::move(text), std::move(part)});
  }
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    Moved moved{i, {}};
    for (const std::string& item : robots_[i].items) {
      moved.parts.push_back(part_of(item, watch.items));
    }
    moved_.push_back(std::move(moved));
  }
}

void Subscriptions::publish(std::uint32_t channel, base::Time time, const std::string& json) {
  for (const auto& [id, number] : subscriptions_) {
    if (number == channel) outlet_.offer(message_data(id, time, json));
  }
}

void Subscriptions::send(base::Time now) {
  if (std::exchange(changed_, false)) begin_watch();
  if (!new_scenes_.empty()) send_scene(now);
  inspect::WatchedValues values;
  if (watch_) values = view_.watched(*watch_);
  for (Stream& stream : streams_) {
    Part& part = stream.part;
    if (part.begin + part.paths.size() > values.values.size()) continue;
    const auto time = written(now, values.ages[part.begin]);
    if (!time || *time < part.written + kSame) continue;
    part.written = *time;
    publish(stream.channel, *time,
            stream.text.filled(std::span(values.values).subspan(part.begin, part.paths.size())));
  }
  if (wants(Channel::Kind::kTransforms)) send_transforms(now, values);
}

void Subscriptions::send_transforms(base::Time now, const inspect::WatchedValues& values) {
  Json transforms = Json::array();
  for (Moved& moved : moved_) {
    std::vector<double> positions;
    bool is_new = !moves_at_all_;
    for (Part& part : moved.parts) {
      if (part.begin + part.paths.size() > values.values.size() || part.paths.empty()) continue;
      const auto time = written(now, values.ages[part.begin]);
      is_new = is_new || (time && *time >= part.written + kSame);
      if (time) part.written = *time;
      const auto numbers = std::span(values.values).subspan(part.begin, part.paths.size());
      positions.insert(positions.end(), numbers.begin(), numbers.end());
    }
    if (is_new) robots_[moved.robot].scene.add_transforms(now, positions, transforms);
  }
  moves_at_all_ = true;
  if (transforms.empty()) return;
  const std::string json = text_of({{"transforms", transforms}});
  for (const Channel& channel : channels_.all()) {
    if (channel.kind == Channel::Kind::kTransforms) publish(channel.advertised.id, now, json);
  }
}

void Subscriptions::send_scene(base::Time now) {
  Json entities = Json::array();
  for (const MovedRobot& robot : robots_) robot.scene.add_entities(now, entities);
  const std::string json = text_of({{"deletions", Json::array()}, {"entities", entities}});
  for (const std::uint32_t id : std::exchange(new_scenes_, {})) {
    outlet_.offer(message_data(id, now, json));
  }
}

void Subscriptions::send_texts(base::Time now) {
  std::map<std::string, const Channel*> wanted;
  for (const auto& [id, number] : subscriptions_) {
    const Channel* const channel = channels_.find(number);
    if (channel != nullptr && channel->kind == Channel::Kind::kTexts) {
      wanted[channel->advertised.topic] = channel;
    }
  }
  std::vector<std::string> items;
  for (auto one = wanted.begin(); one != wanted.end();) {
    items.push_back(one->first);
    ++one;
    if (items.size() < kTextsAtOnce && one != wanted.end()) continue;
    for (const inspect::ItemValue& value : view_.read(items)) {
      const auto found = wanted.find(value.item);
      if (found != wanted.end()) send_text(*found->second, value, now);
    }
    items.clear();
  }
}

void Subscriptions::send_text(const Channel& channel, const inspect::ItemValue& one,
                              base::Time now) {
  if (!one.error.empty() || !one.written) return;
  const Json value = json_of_text(channel.shape, one.value);
  const bool structure = channel.shape.kind == Shape::Kind::kStruct;
  const std::string json = text_of(structure ? value : Json{{"value", value}});
  for (const auto& [id, number] : subscriptions_) {
    if (number != channel.advertised.id || sent_texts_[id] == json) continue;
    sent_texts_[id] = json;
    outlet_.offer(message_data(id, std::max(base::Time{}, now - one.age), json));
  }
}

}  // namespace armature::foxglove::internal
