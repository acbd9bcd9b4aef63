// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/component/observing/observer.hpp"
#include "bridges/ros2/participant.hpp"

namespace armature::ros2 {

/// A time as messages of ROS 2 have it.
struct Stamp {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
};

/// The application as a node of ROS 2: its name, domain and network. One per application; the other
/// components of this library are on it. The defaults stay on this machine.
///
/// All components of this library work with DDS, which allocates and waits: each needs a period,
/// and a thread that no other component shares and that is not real-time, such as
/// `activity: {periodic: 2 ms, scheduler: other, thread: ros}`. Ports from and to the control are
/// wait-free, as between any threads.
class RosNode final : public component::Component, private component::Observer {
 public:
  explicit RosNode(std::string name) : Component(std::move(name)), Observer(this) {}

  /// Opened when it is asked for first, and for all at once; an error says why not.
  /// @thread configuration only
  base::Result<std::shared_ptr<Participant>> participant();
  /// A time of the application as ROS 2 has it: of the wall clock, or simulated.
  /// @thread any
  Stamp stamp_of(base::Time time) const;

 private:
  void on_check(component::Check& check) const override;
  std::vector<Objection> check_view(
      const std::vector<component::Component*>& components) const override;
  void observe(const component::Surroundings& surroundings) override;
  component::Outcome on_start() override;
  void on_update() override;
  void on_cleanup() override { participant_.reset(); }

  Network network() const;
  void set_clocks();
  void tell_of_dds();

  component::Property<std::string> node_{this, "node", "armature", "its name in ROS 2"};
  component::Property<std::string> namespace_{
      this, "namespace", "/", "in front of topics that do not begin with /; such as /arm"};
  component::Property<int> domain_{
      this, "domain", 0, "as ROS_DOMAIN_ID", "", component::range(0, 232)};
  component::Property<std::string> interface_{
      this, "interface", "lo",
      "network interface, by name or address; any other than lo opens it to other machines"};
  component::Property<std::vector<std::string>> peers_{
      this,
      "peers",
      {},
      "addresses of machines that are asked, without multicast; none: this machine on lo, else "
      "multicast"};

  std::shared_ptr<Participant> participant_;
  std::string refused_;
  std::atomic<std::int64_t> to_wall_clock_ns_{0};
  base::Time clocks_set_at_{};
  base::Time told_at_{};
};

}  // namespace armature::ros2
