// SPDX-License-Identifier: Apache-2.0
// The cards of the Janus head on its simulated bus.
#include "armature/testing/drive_conformance.hpp"
#include "robots/janus/simulated_janus.hpp"

namespace armature::testing {
namespace {

janus::SimulatedJanus& janus_of(exec::Application& application) {
  return *static_cast<janus::SimulatedJanus*>(application.find("Cards"));
}

void pass_until(exec::Application& application, base::Time time) {
  janus::Simulation& simulation = janus_of(application).simulation();
  if (simulation.now() < time) simulation.advance_to(time);
}

DriveCase head(const std::string& file) {
  return {
      .name = file,
      .file = JANUS "/deployments/" + file + ".yaml",
      .library_folders = {LIBRARIES},
      .overrides = {"description=" JANUS "/janus.urdf"},
      .hardware = {"Cards", "AIC1", "AIC2"},
      .away = {2.0, 2.0},
      .arrives_within = 0.03,
      .rests_within = std::chrono::seconds(4),  // the first joint has no brake
      .positions =
          [](exec::Application& application) {
            return DriveCase::Joints{janus_of(application).position(0),
                                     janus_of(application).position(1)};
          },
      .powered =
          [](exec::Application& application) {
            janus::Simulation& simulation = janus_of(application).simulation();
            return simulation.card(0).state() == janus::AicState::kOn ||
                   simulation.card(1).state() == janus::AicState::kOn;
          },
      .time =
          [](exec::Application& application) { return janus_of(application).simulation().now(); },
      .pass = pass_until,
      .silence =
          [](exec::Application& application) {
            janus_of(application).simulation().bus().set_cut(true);
          },
      .mend =
          [](exec::Application& application) {
            janus_of(application).simulation().bus().set_cut(false);
          }};
}

INSTANTIATE_TEST_SUITE_P(Janus, DriveConformance,
                         ::testing::Values(head("pid"), head("pid_feed_forward")), by_name);

}  // namespace
}  // namespace armature::testing
