// SPDX-License-Identifier: Apache-2.0
// The last positions of the head as its next initial ones, by the deployment of paper 2 with
// autosave. The simulated head begins at 0 in every run: it has moved since the run before.
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>

#include "armature/deploy/saved_properties.hpp"
#include "tests/janus/experiment.hpp"

namespace armature::janus {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

namespace fs = std::filesystem;

class KeptPositions : public ::testing::Test {
 protected:
  KeptPositions() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~KeptPositions() override { fs::remove_all(folder_); }

  std::string file(int joint) const {
    return (folder_ / ("aic" + std::to_string(joint) + ".cpf")).string();
  }
  std::vector<std::string> settings() const {
    return {"AIC1.autosave=true", "AIC1.property_file=" + file(1), "AIC2.autosave=true",
            "AIC2.property_file=" + file(2)};
  }
  std::string told() const { return Robot::load("paper2.yaml", settings()).diagnostics.to_text(); }

  static std::string begin(Robot& robot) {
    base::Diagnostics diagnostics;
    deploy::begin_kept(robot.document(), robot.application().blueprint(), diagnostics);
    return diagnostics.to_text();
  }
  static std::string end(Robot& robot) {
    base::Diagnostics diagnostics;
    EXPECT_TRUE(robot.application().stop().ok());
    deploy::save_properties(robot.document(), robot.application().blueprint(), diagnostics);
    return diagnostics.to_text();
  }
  /// A run that moves both joints to `position` and ends in order.
  void run_to(double position) {
    Robot robot("paper2.yaml", settings());
    ASSERT_EQ(begin(robot), "");
    robot.start_armed();
    ASSERT_EQ(robot.move_to({position, position}, 1.0), "");
    robot.run_for(3s);
    EXPECT_EQ(end(robot), "");
  }
  std::string content(int joint) const {
    std::ifstream in(file(joint));
    return {std::istreambuf_iterator<char>(in), {}};
  }

  fs::path folder_ = fs::path(::testing::TempDir()) / "kept_positions";
};

TEST_F(KeptPositions, AreWhereTheNextRunBeginsAndMoveNothingBeforeTheOperatorHasConfirmedThem) {
  EXPECT_THAT(told(), AllOf(HasSubstr("'AIC1.Joint' begins at InitialPos, 0 rad: no position is "
                                      "kept yet"),
                            HasSubstr("'AIC2.Joint' begins")));
  run_to(0.5);
  EXPECT_EQ(told(), "");
  Robot robot("paper2.yaml", settings());
  ASSERT_EQ(begin(robot), "");
  robot.start();
  robot.run_for(1s);
  EXPECT_NEAR(robot.value<double>("AIC1.Joint", "Position"), 0.5, 1e-3);
  EXPECT_NEAR(robot.value<double>("AIC2.Joint", "Position"), 0.5, 1e-3);
  EXPECT_FALSE(robot.value<bool>("AIC1.Card", "position_exact"));
  robot.call("Arming", "arm");
  robot.run_for(3s);
  EXPECT_FALSE(robot.value<bool>("Arming", "armed"));
  robot.confirm_positions();
  robot.arm();
}

TEST_F(KeptPositions, OfARunThatDiedAreNotBelieved) {
  run_to(0.5);
  {
    Robot robot("paper2.yaml", settings());
    ASSERT_EQ(begin(robot), "");
    robot.start_armed();
    robot.run_for(1s);
  }  // and nothing is written at its end
  EXPECT_THAT(told(), AllOf(HasSubstr("warning: 'AIC1.Joint' begins at InitialPos, 0 rad: the run "
                                      "of 20"),
                            HasSubstr("did not end with the joint at rest where it is known to "
                                      "be")));
}

TEST_F(KeptPositions, OfARunThatWasStoppedInMotionAreNotBelieved) {
  run_to(0.5);
  Robot robot("paper2.yaml", settings());
  ASSERT_EQ(begin(robot), "");
  robot.start_armed();
  ASSERT_EQ(robot.move_to({2.0, 2.0}, 2.0), "");
  robot.run_for(1s);
  EXPECT_THAT(end(robot), HasSubstr("warning: 'AIC1.Joint' keeps no position: it was not measured "
                                    "at rest when it stopped"));
  EXPECT_THAT(told(), HasSubstr("'AIC1.Joint' begins at InitialPos"));
}

TEST_F(KeptPositions, OfAStartThatWasRefusedAreKept) {
  run_to(0.5);
  const std::string before = content(1);
  {
    Robot robot("paper2.yaml", settings());
    ASSERT_EQ(begin(robot), "");
    EXPECT_NE(content(1), before);
    base::Diagnostics diagnostics;
    deploy::give_back_kept(robot.document(), robot.application().blueprint(), diagnostics);
  }
  EXPECT_EQ(content(1), before);
}

TEST_F(KeptPositions, InAFileThatIsHalfWrittenRefuseTheRun) {
  run_to(0.5);
  const std::string whole = content(1);
  std::ofstream(file(1)) << whole.substr(0, whole.size() / 2);
  EXPECT_THAT(told(), AllOf(HasSubstr("aic1.cpf:"), HasSubstr("error: ")));
}

TEST_F(KeptPositions, OfAnotherJointRefuseTheRun) {
  run_to(0.5);
  fs::copy_file(file(1), file(2), fs::copy_options::overwrite_existing);
  EXPECT_THAT(told(), HasSubstr("error: 'AIC2.Joint': LastPosition is of "
                                "'janus-paper-2/AIC1.Joint', expected "
                                "'janus-paper-2/AIC2.Joint'"));
}

TEST_F(KeptPositions, ThatCannotBeMarkedAsBegunRefuseTheStart) {
  run_to(0.5);
  Robot robot("paper2.yaml", settings());
  fs::remove_all(folder_);
  EXPECT_THAT(begin(robot), HasSubstr("error: the properties of 'AIC1.Joint' were not saved: "
                                      "cannot write"));
}

}  // namespace
}  // namespace armature::janus
