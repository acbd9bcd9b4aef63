// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "armature/can/link.hpp"
#include "armature/component/author.hpp"
#include "armature/controllers/base/limited_effort.hpp"
#include "armature/controllers/base/sampling_period.hpp"
#include "armature/types/enum.hpp"
#include "drives/cia402/background_sdo.hpp"
#include "drives/cia402/drive_group.hpp"
#include "drives/cia402/homing_run.hpp"
#include "drives/cia402_components/drive_plan.hpp"
#include "drives/cia402_components/drive_sample.hpp"
#include "drives/cia402_components/torque_watch.hpp"

namespace armature::cia402 {

/// What the position unit of the drives is: see cia402::PositionUnit.
enum class DriveUnit : std::uint8_t { kIncrements, kFeed };
ARMATURE_ENUM(DriveUnit, kIncrements, kFeed);

/// The host of drives by CiA 402 on one bus, which the components Cia402Drive use as their peer: to
/// be extended by what the bus is.
///
/// At the configuration it compares each drive with what is declared, and maps its PDOs. The first
/// drive that is read in a cycle, or the Sample where none is read any more, begins the cycle on
/// the bus: what has come is used, the targets of the cycle before are sent, and one SYNC, at which
/// all drives take their targets and answer. So an answer to a sample acts two SYNCs later; the
/// check of gains knows that as the Robot's `effort_delay`. A target that was not set anew for 100
/// ms is torque 0, velocity 0, or the position where the drive is. Whenever the host stops, its
/// drives stop quickly and switch off.
/// @rt nonblocking, no allocation
class Cia402Host : public component::Component {
 public:
  using Component::Component;

  /// Of all drives that do not say another.
  /// @thread configuration only, as for nodes
  CyclicMode mode() const { return mode_; }
  const std::vector<int>& nodes() const { return nodes_; }
  /// Whether it asks drives for numbers that no PDO has.
  bool asks_slowly() const { return slow_period_ > 0.0; }
  /// Whether drives know of its end.
  bool has_heartbeat() const { return host_heartbeat_ > 0.0; }
  void on_check(component::Check& check) const override;

 protected:
  /// Not opened yet.
  virtual base::Result<std::unique_ptr<can::Link>> make_link() = 0;
  base::Duration cycle() const { return period_.duration(); }
  std::uint32_t bit_rate() const { return static_cast<std::uint32_t>(bit_rate_.get()); }
  const DriveGroup* group() const { return group_ ? &*group_ : nullptr; }
  /// Quick stop, then off: at once on the bus.
  void make_safe();

  // Of a bus that has a guardian.
  virtual component::Outcome begin_to_guard() { return component::accepted(); }
  /// A cycle begins; false if the host is out of service.
  virtual bool is_guarded() { return true; }
  /// No cycle is expected.
  virtual void rest() {}
  virtual void end_guard() {}

  component::Outcome on_configure() override;
  component::Outcome on_start() override;
  void on_stop() override;
  void on_cleanup() override;

 private:
  DriveSample read_drive(int node);
  bool set_effort(int node, control::LimitedEffort effort) {
    return set_target(node, CyclicMode::kTorque, effort);
  }
  bool set_velocity(int node, control::LimitedVelocity velocity) {
    return set_target(node, CyclicMode::kVelocity, velocity);
  }
  bool set_position(int node, control::LimitedPosition position) {
    return set_target(node, CyclicMode::kPosition, position);
  }
  bool energize_drive(int node, bool enable, control::DrivePermit permit);
  bool make_drive_safe(int node, bool quick_stop);
  bool home_drive(int node, control::DrivePermit permit);
  bool reset_drive(int node);
  void read_slow(std::size_t place, DriveSample& sample) const;
  bool has_rebooted(std::size_t place) const;
  bool is_unprepared(std::size_t place) const {
    return has_rebooted(place) || accounts_[place].is_nmt_stopped;
  }
  void follow_preparation();
  void begin_heartbeat();

  DrivePlan plan_of(int node) const;
  component::Outcome know_plans();
  void plan_by_own_words() const;
  void find_places();
  void find_homing();
  component::Outcome prepare();
  bool set_target(int node, CyclicMode mode, double target);
  void watch_torques();
  void step_homing();
  void stop_silent(std::size_t place);
  void begin_cycle();
  void keep_cycle();
  void take_frames();
  void drop_old_targets();
  double no_target(std::size_t drive) const;
  std::optional<std::size_t> place_of(int node) const;

  component::Property<std::vector<int>> nodes_{
      this, "nodes", {}, "numbers of the drives, 1 to 127", "", component::mandatory};
  component::Property<CyclicMode> mode_{
      this, "mode", CyclicMode::kPosition,
      "how drives are commanded that do not say it: torque (CST), velocity (CSV), position (CSP)"};
  component::Property<DriveUnit> unit_{
      this, "unit", DriveUnit::kIncrements,
      "of positions in the drives: increments of the encoder, or feed by their feed constant"};
  component::Property<int> vendor_{this, "vendor", 0,
                                   "that every drive says it is of (0x1018:01); 0: not compared"};
  component::Property<int> product_{this, "product", 0, "likewise (0x1018:02)"};
  component::Property<std::string> eds_{
      this, "eds", "", "the file in which the drives' maker describes them; empty: not compared"};
  component::Property<int> bit_rate_{
      this,      "bit_rate",
      1'000'000, "of the bus; a CAN interface has its own, which has to be this one",
      "",        component::range(1, 1'000'000)};
  component::Property<double> heartbeat_{
      this, "heartbeat", 0.1, "of the drives; 0: none", "s", component::range(0.0, 10.0)};
  component::Property<int> host_node_{
      this, "host_node", 127, "of this host among heartbeats", "", component::range(1, 127)};
  component::Property<double> host_heartbeat_{
      this, "host_heartbeat",
      0.1,  "of this host; drives that miss three of them stop by themselves; 0: none",
      "s",  component::range(0.0, 10.0)};
  component::Property<double> slow_period_{
      this, "slow_period",
      0.1,  "in which each drive is asked for its current and temperature; 0: never",
      "s",  component::range(0.0, 60.0)};
  controllers::SamplingPeriod period_{this};
  component::Operation<DriveSample(int)> read_drive_{this,
                                                     "readDrive",
                                                     component::serve<&Cia402Host::read_drive>,
                                                     "what a drive says in this cycle",
                                                     component::args("node"),
                                                     component::in_own_thread};
  component::Operation<bool(int, control::LimitedEffort)> set_effort_{
      this,
      "setEffort",
      component::serve<&Cia402Host::set_effort>,
      "the torque of a drive, in mode torque, from the next SYNC on",
      component::args("node", "effort [Nm]"),
      component::in_own_thread};
  component::Operation<bool(int, control::LimitedVelocity)> set_velocity_{
      this,
      "setVelocity",
      component::serve<&Cia402Host::set_velocity>,
      "the velocity of a drive, in mode velocity, from the next SYNC on",
      component::args("node", "velocity [rad/s]"),
      component::in_own_thread};
  component::Operation<bool(int, control::LimitedPosition)> set_position_{
      this,
      "setPosition",
      component::serve<&Cia402Host::set_position>,
      "where a drive is to be, in mode position, at the next SYNC but one",
      component::args("node", "position [rad]"),
      component::in_own_thread};
  component::Operation<bool(int, bool, control::DrivePermit)> energize_drive_{
      this,
      "energizeDrive",
      component::serve<&Cia402Host::energize_drive>,
      "has a drive switch on, and follow its targets if `enable`",
      component::args("node", "enable", "permit"),
      component::in_own_thread};
  component::Operation<bool(int, bool)> make_drive_safe_{
      this,
      "makeDriveSafe",
      component::serve<&Cia402Host::make_drive_safe>,
      "has a drive stop quickly, or switch off",
      component::args("node", "quick_stop"),
      component::in_own_thread};
  component::Operation<bool(int, control::DrivePermit)> home_drive_{
      this,
      "homeDrive",
      component::serve<&Cia402Host::home_drive>,
      "has a drive switch on and home by itself, in mode HM, until it is made safe",
      component::args("node", "permit"),
      component::in_own_thread};
  component::Operation<bool(int)> reset_drive_{
      this,
      "resetDrive",
      component::serve<&Cia402Host::reset_drive>,
      "has a drive that failed leave its fault; prepares one "
      "that lost its power as at the start",
      component::by_operator,
      component::args("node"),
      component::in_own_thread};
  component::EventHandler<> sample_{this,
                                    "Sample",
                                    component::serve<&Cia402Host::keep_cycle>,
                                    "keeps the cycle on the bus when no drive is read any more",
                                    component::optional,
                                    component::leads_to_nothing()};
  component::Attribute<int> lost_answers_{this, "lost_answers", 0,
                                          "cycles since the start without a drive's answer"};
  component::Attribute<int> refused_frames_{this, "refused_frames", 0,
                                            "since the start, that the bus did not take"};

  /// What a drive's component has taken and given.
  struct Account {
    base::Time seen{};            ///< when the position came that was taken last
    base::Time target_at{};       ///< when its target was set last
    bool dropped = false;         ///< that target is too old
    std::uint32_t reboots = 0;    ///< after which it was prepared
    std::uint32_t preparing = 0;  ///< after which it is being prepared
    bool is_preparing = false;
    double target = 0.0;  ///< that it has
    TorqueWatch watch{};  ///< in mode torque
    TorqueWatch::Finding torque = TorqueWatch::Finding::kGood;
    std::optional<HomingRun> homing{};  ///< of one that can home
    bool is_nmt_stopped = false;        ///< since it did not answer while it homed
    bool is_started_again = false;      ///< behind that, and has not answered yet
  };
  mutable std::vector<DrivePlan> plans_;  ///< by place; made by the check, which sees all drives
  std::unique_ptr<can::Link> link_;
  std::optional<DriveGroup> group_;
  std::optional<BackgroundSdo> background_;
  std::vector<Account> accounts_;
  std::vector<std::optional<std::size_t>> place_of_;  ///< by the drive's node
  base::Time cycle_at_ = base::Time::min();
};

}  // namespace armature::cia402
