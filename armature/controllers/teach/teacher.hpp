// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "armature/base/fixed_text.hpp"
#include "armature/base/result.hpp"
#include "armature/component/author.hpp"
#include "armature/control/taught/taught_motion.hpp"
#include "armature/controllers/base/max_age.hpp"
#include "armature/controllers/teach/taught_file.hpp"

namespace armature::controllers {

/// Teaches a robot by hand: records what a hand does with it, and has its generator, an
/// nAxesGeneratorTaught among its peers, play that; keeps poses by name. It arms nothing and
/// switches no mode: `record` listens only, and what moves the robot is refused by the generator
/// unless it is armed.
///
/// A motion is the file NAME.motion in `folder`, a pose a line in `poses`; both are text and are
/// replaced as a whole. They are read when they are needed, so that they may be edited meanwhile;
/// a mistake in them refuses the command with its file and line, and nothing moves.
///
/// Recording ends by `finish`, which keeps it, when max_duration is over (kept as well; the log
/// says so), or by cancelling it, which drops it. Without a measured position for 100 ms it fails.
/// Its memory is there from the configuration on.
///
/// It works with files: its thread is to be one of its own, `activity: {periodic: 10 ms, scheduler:
/// other}`, of at most 20 ms.
class Teacher final : public component::Component {
 public:
  using Component::Component;

 private:
  using Vector = std::vector<double>;
  using Name = base::FixedText<63>;

  void on_check(component::Check& check) const override;
  component::Outcome on_configure() override;
  component::Outcome on_start() override;
  void on_update() override;

  component::Outcome begin_record(const Name& name);
  component::Outcome begin_play(const Name& name, double speed);
  component::Outcome begin_go_to(const Name& name, double time_s);
  component::Outcome begin_keep_pose(const Name& name);
  component::Outcome begin_finish();
  bool at_once() { return true; }
  void drop() { samples_.times_s.clear(); }
  void cancel() { motion_.cancel(); }

  void record_sample();
  base::Result<void> keep_motion();
  void follow(component::Command<Name, double>& command);
  component::Outcome sent(component::CommandHandle handle);
  std::string file_of(std::string_view motion) const;
  std::vector<std::string> motions() const;
  base::Result<control::TaughtMotion> read_motion(std::string_view name) const;
  base::Result<Poses> read_poses() const;
  std::string list();
  bool is_moving() const { return play_.active() || go_to_.active(); }

  component::Property<int> joints_{
      this, "joints", 1, "number of joints", "", component::mandatory, component::range(1, 100000)};
  component::Property<std::string> folder_{this, "folder", "taught", "where motions are"};
  component::Property<std::string> poses_{this, "poses", "poses.yaml", "file of the named poses"};
  component::Property<std::string> unit_{this, "unit", "deg",
                                         "in which poses are written: rad, deg, m or mm"};
  component::Property<double> longest_{this, "max_duration",
                                       60.0, "of a recording, then it ends",
                                       "s",  component::range(0.1, 3600.0)};
  component::Attribute<double> recorded_{this, "recorded_time", 0.0,
                                         "of the present or last recording [s]"};
  component::InputPort<Vector> measured_{this,
                                         "nAxesSensorPosition",
                                         "measured position of each joint",
                                         "rad",
                                         component::size_of(joints_),
                                         component::max_age(kMaxAge, component::Reaction::kHold),
                                         component::on_lost(component::Reaction::kHold)};
  component::CommandCaller<const Vector&, double> play_path_{this, "playPath", "plays a path"};
  component::CommandCaller<const Vector&, double> move_to_{this, "moveTo", "moves the joints"};
  component::Command<Name> record_{this,
                                   "record",
                                   component::serve<&Teacher::begin_record>,
                                   "records what a hand does with the robot, until finish",
                                   component::args("motion"),
                                   component::cancelled_by<&Teacher::drop>};
  component::Command<> finish_{this, "finish", component::serve<&Teacher::begin_finish>,
                               "ends the recording and keeps it",
                               component::done_when<&Teacher::at_once>};
  component::Command<Name, double> play_{
      this,
      "play",
      component::serve<&Teacher::begin_play>,
      "moves to the begin of a motion and plays it; 1 is the speed of the teaching",
      component::args("motion", "speed"),
      component::cancelled_by<&Teacher::cancel>};
  component::Command<Name, double> go_to_{
      this,
      "goTo",
      component::serve<&Teacher::begin_go_to>,
      "moves to a pose in a time; 0: as fast as the limits allow",
      component::args("pose", "time [s]"),
      component::cancelled_by<&Teacher::cancel>};
  component::Command<Name> keep_pose_{this,
                                      "keepPose",
                                      component::serve<&Teacher::begin_keep_pose>,
                                      "keeps where the robot is as a pose",
                                      component::args("pose"),
                                      component::done_when<&Teacher::at_once>};
  component::Operation<std::string()> list_{this, "list", component::serve<&Teacher::list>,
                                            "names of motions and poses", component::in_own_thread};

  component::CommandHandle motion_{component::CallStatus::kNotConnected};
  control::TaughtSamples samples_;  ///< their room is that of max_duration
  Name name_;                       ///< of what is recorded
  base::Time begun_{};
};

}  // namespace armature::controllers
