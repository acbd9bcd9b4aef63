// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>

#include "armature/component/author.hpp"
#include "armature/component/properties/keeping.hpp"
#include "armature/controllers/joint/joint_settings.hpp"

namespace armature::controllers {

/// Where a joint was when a run ended; in the property file of a Joint with `autosave`.
struct LastPosition {
  double position = 0.0;  ///< [rad] of the joint
  std::string date;       ///< when it was measured there, `2026-11-25T03:34:19Z`
  std::string owner;      ///< `application/component`
  bool at_rest = false;   ///< false: a run began then, and did not end with the joint at rest
};
ARMATURE_STRUCT(LastPosition, (position, "rad", "of the joint"), (date, "", "when it was there"),
                (owner, "", "application/component"),
                (at_rest, "", "false: a run began then, and did not end with the joint at rest"));

/// The last position of a joint as its next initial one (paper 2, sections 4.1 and 5.1). It is a
/// proposal: nobody saw what moved the joint meanwhile, so the joint is doubtful until the operator
/// has confirmed where it is, and is not armed before.
class KeptPosition final : public component::Keeping {
 public:
  /// What is known of a joint whose component stops.
  struct Stop {
    double position = 0.0;  ///< [rad]
    bool at_rest = false;   ///< measured just before
    bool braked = false;    ///< confirmed by the hardware, if it has a brake
    bool exact = false;     ///< no sample was lost
    bool known = true;      ///< it did not begin to home without finding it, or was looked at
  };

  KeptPosition(component::Component* owner, const JointProperties& settings);

  bool fills(const component::PropertyBase& property) const override { return &property == &last_; }
  void take(const component::KeepingMoment& moment, const base::Location& where,
            base::Diagnostics& diagnostics) override;
  void begin(const component::KeepingMoment& moment) override;
  void give_back() override { last_.assign(found_); }
  std::string end(const component::KeepingMoment& moment) override;

  /// Where the joint is taken to be at first [rad].
  double initial() const { return proposal_.value_or(settings_->initial_position); }

  // In the joint's thread; nonblocking, no allocation.
  /// Nobody has confirmed yet where it is.
  bool is_doubtful() const { return doubtful_; }
  /// What the operator is asked to look at.
  /// @param position  where the joint is by its sensor now [rad]
  component::Reason question(double position) const;
  void be_sure() { doubtful_ = false; }
  void note_start() { stopped_.store(false, std::memory_order_relaxed); }
  void note_stop(const Stop& stop);

 private:
  bool is_believable(const component::KeepingMoment& moment, const base::Location& where,
                     base::Diagnostics& diagnostics) const;
  std::string objection(const component::KeepingMoment& moment) const;

  const component::Component& owner_;
  const JointProperties& settings_;
  component::Property<LastPosition> last_;
  LastPosition found_{};            ///< in the property file
  LastPosition begun_{};            ///< what it says while this run goes on
  std::optional<double> proposal_;  ///< of it, if that may be one
  bool doubtful_ = false;           ///< it is asked for, and the operator has not looked yet
  Stop stop_{};
  std::chrono::sys_seconds stopped_at_{};
  std::atomic<bool> stopped_{false};  ///< since the last start; `stop_` says how
};

}  // namespace armature::controllers
