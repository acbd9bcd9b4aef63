// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/component/author.hpp"
#include "armature/control/dynamics/inverse_dynamics.hpp"
#include "armature/controllers/base/changes.hpp"

namespace armature::controllers {

/// The properties that say which robot a component computes the dynamics of. Gains, limits and who
/// holds the weight are checked by them when the deployment is checked: from then on they stay.
class RobotDescription final : public component::Checked, public component::PropertyFollower {
 public:
  /// Whether a deployment must give the file.
  enum class Need : std::uint8_t { kMandatory, kOptional };

  explicit RobotDescription(component::Component* owner, Need need = Need::kMandatory);

  /// Refuses a gravity that is none: of another size than on earth, unless it is 0.
  void check(component::Check& check) const override;

  /// Reads the description; an error if it cannot be read, is no URDF, or has another number of
  /// movable joints than `joints`.
  /// @param warnings  what else there is to say of it
  /// @thread configuration only
  base::Result<control::InverseDynamics> load(std::size_t joints,
                                              std::vector<std::string>& warnings) const;

  const std::string& file() const { return file_.get(); }
  const std::array<double, 3>& gravity() const { return gravity_.get(); }
  /// Whether a property was set since this was asked.
  bool take_change() const { return changes_.take(); }

  // For the properties.
  void follow() override {}
  std::string objection() const override;

 private:
  component::Property<std::string> file_;
  component::Property<std::string> base_link_;
  component::Property<std::string> tip_link_;
  component::Property<std::array<double, 3>> gravity_;
  mutable bool checked_ = false;
  mutable Changes changes_{file_, base_link_, tip_link_, gravity_};
};

}  // namespace armature::controllers
