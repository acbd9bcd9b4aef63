// SPDX-License-Identifier: Apache-2.0
#include "armature/bundle/internal/texts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::bundle::internal {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

Facts facts() {
  Facts facts;
  facts.name = "Two_Joints";
  facts.version = "0.1.0";
  facts.architecture = "amd64";
  facts.deployment = "deployment/arm.yaml";
  facts.packages = {"libc6", "libyaml-cpp0.7"};
  facts.stop_time = std::chrono::minutes(2);
  return facts;
}

TEST(Texts, ANameHasLettersDigitsAndLittleElse) {
  EXPECT_EQ(name_of_bundle("two-joint_arm.7"), "two-joint_arm.7");
  for (const char* const bad :
       {"", "two arms", "../arm", "-arm", ".arm", "arm/a", "böse", "a\nb"}) {
    EXPECT_EQ(name_of_bundle(bad), "") << bad;
  }
  EXPECT_EQ(name_of_archive(facts()), "armature-two-joints_0.1.0_amd64.deb");
}

TEST(Texts, TheScriptStartsTheDeploymentFromWhereverItLies) {
  Facts arm = facts();
  arm.deployment = "deployment/ann's $arm.yaml";
  arm.options = {"--mode", "pid"};
  arm.script = "deployment/move.lua";
  EXPECT_THAT(run_script(arm),
              EndsWith("exec \"$here/bin/armature\" run \"$here\"/'deployment/ann'\\''s $arm.yaml' "
                       "'--mode' 'pid' --script \"$here\"/'deployment/move.lua' \"$@\"\n"));
}

TEST(Texts, TheUnitRunsInRealTimeAndStopsInOrderOnce) {
  const std::string unit = unit_text(facts());
  for (const char* const line :
       {"ExecStart=/opt/armature/Two_Joints/run\n", "Restart=no\n", "KillSignal=SIGTERM\n",
        "KillMode=process\n", "TimeoutStopSec=120\n", "LimitRTPRIO=99\n", "LimitMEMLOCK=infinity\n",
        "ReadWritePaths=/run\n"}) {
    EXPECT_THAT(unit, HasSubstr(line));
  }
}

TEST(Texts, TheUnitMayWriteWhatARunSaves) {
  Facts arm = facts();
  arm.saved = {"deployment/arm.cpf"};
  EXPECT_THAT(unit_text(arm),
              HasSubstr("ReadWritePaths=/run /opt/armature/Two_Joints/deployment\n"));
}

TEST(Texts, TheReadmeSaysWhatIsToBeDoneByHand) {
  EXPECT_THAT(readme_text(facts()), Not(HasSubstr("rivate key")));
  Facts arm = facts();
  arm.keys = {"deployment/arm.key"};
  arm.strangers = {"libgripper.so.2"};
  EXPECT_THAT(readme_text(arm), HasSubstr("Put them by hand to:\n\n  deployment/arm.key\n"));
  EXPECT_THAT(readme_text(arm), HasSubstr("\n\n  libgripper.so.2\n"));
  EXPECT_THAT(readme_text(arm), HasSubstr("apt install libc6 libyaml-cpp0.7\n"));
}

TEST(Texts, ThePackageDependsOnWhatIsNotInIt) {
  EXPECT_THAT(control_text(facts(), 70), HasSubstr("Package: armature-two-joints\nVersion: 0.1.0\n"
                                                   "Architecture: amd64\n"));
  EXPECT_THAT(control_text(facts(), 70), HasSubstr("\nDepends: libc6, libyaml-cpp0.7\n"));
}

TEST(Texts, TheLicencesOfPackagesAreWhereDebianHasThem) {
  EXPECT_THAT(licences_text(facts()),
              HasSubstr("libyaml-cpp0.7: /usr/share/doc/libyaml-cpp0.7/copyright\n"));
}

}  // namespace
}  // namespace armature::bundle::internal
