// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "armature/base/time.hpp"
#include "armature/foxglove/internal/channel_list.hpp"
#include "armature/foxglove/internal/number_text.hpp"
#include "armature/foxglove/internal/outlet.hpp"
#include "armature/foxglove/internal/robot_scene.hpp"
#include "armature/inspect/view.hpp"

namespace armature::foxglove::internal {

/// A robot with what moves it.
struct MovedRobot {
  RobotScene scene;
  std::vector<std::string> items;  ///< empty: nothing moves it
};

/// What a client has subscribed to, and the values that it is sent: as the application's threads
/// have copied them last.
class Subscriptions {
 public:
  /// Between two values of a channel.
  static constexpr base::Duration kInterval = std::chrono::milliseconds(40);

  Subscriptions(inspect::View& view, const ChannelList& channels, Outlet& outlet)
      : view_(view), channels_(channels), outlet_(outlet) {}

  void subscribe(const Subscribe& request);
  void unsubscribe(const Unsubscribe& request);
  /// Channels or robots are others than before; what is subscribed to stays as far as it is there.
  void replace(std::vector<MovedRobot> robots);
  /// Nothing can be asked: what was watched is watched no more.
  void lose();

  /// Sends what is new. Throws inspect::NoAnswer where nothing can be asked.
  /// @param now  of the application's clock
  void send(base::Time now);
  /// The same for values that are texts, or have some: these are asked for one by one.
  void send_texts(base::Time now);

 private:
  /// Numbers of a watch that come from one port.
  struct Part {
    std::string item;
    std::vector<std::string> paths;
    std::size_t begin = 0;
    base::Time written = base::Time::min();  ///< what was sent last
  };
  struct Stream {
    std::uint32_t channel = 0;
    NumberText text;
    Part part;
  };
  struct Moved {
    std::size_t robot = 0;
    std::vector<Part> parts;
  };

  std::vector<std::string> wanted_items() const;
  void begin_watch();
  inspect::Watch watch_what_can_be(const std::vector<std::string>& items);
  inspect::Watch watch_as_many_as_can_be(std::vector<std::string> items, const std::string& why);
  static Part part_of(const std::string& item, const std::vector<inspect::WatchedItem>& given);
  bool wants(Channel::Kind kind) const;
  void end_watch();
  void send_text(const Channel& channel, const inspect::ItemValue& one, base::Time now);
  void publish(std::uint32_t channel, base::Time time, const std::string& json);
  void send_transforms(base::Time now, const inspect::WatchedValues& values);
  void send_scene(base::Time now);

  inspect::View& view_;
  const ChannelList& channels_;
  Outlet& outlet_;
  std::map<std::uint32_t, std::uint32_t> subscriptions_;  ///< the client's number: the channel
  std::set<std::uint32_t> new_scenes_;                    ///< subscriptions that have none yet
  std::map<std::uint32_t, std::string> sent_texts_;       ///< by subscription: the last value
  std::vector<MovedRobot> robots_;
  bool changed_ = false;  ///< another watch is wanted
  std::optional<std::int32_t> watch_;
  std::vector<Stream> streams_;
  std::vector<Moved> moved_;
  bool moves_at_all_ = false;  ///< transforms were sent since the watch began
};

}  // namespace armature::foxglove::internal
