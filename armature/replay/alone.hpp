// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/deploy/deployment.hpp"
#include "armature/replay/acts.hpp"
#include "armature/replay/recorded_channels.hpp"
#include "armature/replay/recorded_component.hpp"

namespace armature::replay {

/// Some components of a recorded run, which run again, while what the others wrote to them comes
/// from the recordings. So hardware and other processes need not be there, nor a simulation of
/// them, and runs in real time can be replayed.
class Alone {
 public:
  /// Makes the deployment one in which only the components of these names run; a `*` in a name is
  /// any number of characters but dots. Errors say what is not recorded that they need, or whom
  /// they call that does not run; a warning says what else they were told.
  /// @param folder     of the run
  /// @param real_time  the run was in real time: cycles come at the times of recorded samples
  static Alone of(const std::vector<std::string>& names, const std::string& folder, bool real_time,
                  deploy::Deployment& deployment, base::Diagnostics& diagnostics);

  /// Of acts those that concern components which run.
  std::vector<RecordedAct> acts_for(std::vector<RecordedAct> acts) const;

  /// Of the components that run.
  const std::set<std::string>& names() const { return names_; }
  /// Channels with what was recorded of their own doing.
  const std::set<std::string>& compared() const { return compared_; }
  /// Whether samples are missing in these.
  bool has_gaps() const { return gaps_; }
  /// Of the run's time: in real time the first in the recordings, since nobody knows more of it.
  base::Time begin() const { return begin_; }
  /// The last time in the recordings; the begin of time if there is none.
  base::Time end() const { return channels_->end(); }
  /// When something recorded is to be written next.
  base::Time next() const;
  /// Has it written, by those whose thread has not done so.
  void play(exec::Application& application) const;

 private:
  friend class Isolation;

  std::set<std::string> names_;
  std::set<std::string> there_;  ///< what is of the runtime, and recorders
  std::set<std::string> compared_;
  bool gaps_ = false;
  base::Time begin_{};
  std::unique_ptr<RecordedChannels> channels_;
  std::vector<RecordedComponent*> recorded_;  ///< writers before readers
};

}  // namespace armature::replay
