// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/arm_parts.hpp"

#include <utility>

#include "armature/control/transmission.hpp"

namespace armature::wam {

base::Result<ArmParts> ArmParts::make(const ArmNumbers& numbers, WamParameters& parameters,
                                      const controllers::RobotDescription& description,
                                      std::vector<std::string>& warnings) {
  const auto config = parameters.torque_path(numbers);
  if (!config) return base::Error{config.error()};
  parameters.show_gains(config.value().hold);
  auto links = description.load(numbers.joints(), warnings);
  if (!links) return base::Error{links.error()};
  auto transmission = control::Transmission::make(numbers.transmission);
  if (!transmission) return base::Error{transmission.error()};
  auto own = JointController::make(
      {.gains = config.value().hold, .period_s = parameters.period().seconds()});
  if (!own) return base::Error{own.error()};
  auto path = TorquePath::make(config.value(), transmission.value(), std::move(links).value());
  if (!path) return base::Error{path.error()};
  const auto standing_bounds = parameters.standing_watch(numbers);
  if (!standing_bounds) return base::Error{standing_bounds.error()};
  auto standing = StandingWatch::make(standing_bounds.value());
  if (!standing) return base::Error{standing.error()};
  const auto driven_bounds = parameters.driven_watch(numbers);
  if (!driven_bounds) return base::Error{driven_bounds.error()};
  auto driven = DrivenWatch::make(driven_bounds.value());
  if (!driven) return base::Error{driven.error()};
  auto max_load = parameters.weightless_load(numbers);
  if (!max_load) return base::Error{max_load.error()};
  FloatGate float_gate({std::move(max_load).value(), parameters.period().seconds()});
  return ArmParts{WamMotion(std::move(transmission).value()),
                  std::move(path).value(),
                  std::move(standing).value(),
                  std::move(driven).value(),
                  std::move(own).value(),
                  std::move(float_gate)};
}

}  // namespace armature::wam
