// SPDX-License-Identifier: Apache-2.0
// From idle to the cycle, every frame that was on the wire, beside testdata/conversations/NAME.txt.
// UPDATE_EXPECTED=1 in the environment writes the files, to be read before they are committed.
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "robots/wam/driver/test_conversation_text.hpp"
#include "robots/wam/driver/test_hosted_bench.hpp"

namespace armature::wam {
namespace {

struct Case {
  const char* name;
  std::size_t motors;
  int puck_version;
  int board_version;

  friend std::ostream& operator<<(std::ostream& out, const Case& tested) {
    return out << tested.name;
  }
};

class WamConversation : public ::testing::TestWithParam<Case> {};

TEST_P(WamConversation, IsThisFrameByFrame) {
  const Case& tested = GetParam();
  auto config = Emulator::standard(tested.motors, tested.puck_version);
  config.board.version = tested.board_version;
  Hosted bench(config);
  bench.power_up();
  const base::Time begin = bench.now();
  ASSERT_EQ(bench.connect(), WamProgress::kDone) << bench.said();
  ASSERT_EQ(bench.zero(), WamProgress::kDone) << bench.said();
  bench.driver = WamDriver::make(bench.host, bench.startup->record(), {}).value();
  bench.driver->start(bench.now());
  bench.run(2);
  const ConversationText text(tested.puck_version, tested.board_version);
  const std::string said = text.lines(bench.log, begin);

  const std::string path =
      std::string(ROBOT_FOLDER "/testdata/conversations/") + tested.name + ".txt";
  if (std::getenv("UPDATE_EXPECTED") != nullptr) std::ofstream(path) << said;
  std::stringstream expected;
  expected << std::ifstream(path).rdbuf();
  EXPECT_EQ(said, expected.str()) << path;
}

INSTANTIATE_TEST_SUITE_P(Arms, WamConversation,
                         ::testing::Values(Case{"wam7_firmware_175", 7, 175, 200},
                                           Case{"wam7_firmware_130", 7, 130, 200},
                                           Case{"wam7_firmware_64", 7, 64, 61},
                                           Case{"wam4_firmware_175", 4, 175, 200},
                                           Case{"wam4_firmware_120", 4, 120, 150},
                                           Case{"wam4_firmware_55", 4, 55, 55}),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace armature::wam
