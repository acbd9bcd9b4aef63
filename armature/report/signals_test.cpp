// SPDX-License-Identifier: Apache-2.0
#include "armature/report/signals.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>

namespace armature::report {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;

class Recorded : public ::testing::Test {
 protected:
  void add(record::ChannelId channel, base::Duration time, const std::string& json) {
    recording.samples.push_back({channel, base::Time{} + time, 0, json});
  }
  record::McapRecording recording;
};

TEST_F(Recorded, NumbersFlagsVectorsAndStructsBecomeSignals) {
  recording.channels = {{"PID1.Out", "double", "", "V", "voltage"},
                        {"Sensor.sensor", "double[]", "", "rad", ""},
                        {"Head.pan", "Joint", "", "", ""}};
  add(0, 10ms, R"({"value": 1.5})");
  add(1, 10ms, R"({"value": [0.25, -1]})");
  add(2, 20ms, R"({"q": 3, "braked": true})");
  add(0, 20ms, R"({"value": null})");
  const Signals signals = signals_of(recording);
  std::vector<std::string> names;
  for (const Signal& signal : signals.all) names.push_back(signal.name);
  EXPECT_THAT(names, ElementsAre("PID1.Out", "Sensor.sensor[0]", "Sensor.sensor[1]",
                                 "Head.pan.braked", "Head.pan.q"));
  const Signal& out = *signals.find("PID1.Out");
  EXPECT_EQ(out.unit, "V");
  EXPECT_THAT(out.time_s, ElementsAre(0.01, 0.02));
  EXPECT_EQ(out.values[0], 1.5);
  EXPECT_TRUE(std::isnan(out.values[1])) << "null is what a recording has for nan";
  EXPECT_EQ(signals.find("Head.pan.braked")->values[0], 1.0);
  EXPECT_EQ(signals.find("Head.tilt"), nullptr);
}

TEST_F(Recorded, TextsAreNoCurves) {
  recording.channels = {{"Joint1.PeerName", "text", "", "", ""}};
  add(0, 0ms, R"({"value": "AIC1"})");
  const Signals signals = signals_of(recording);
  EXPECT_TRUE(signals.all.empty());
  EXPECT_EQ(signals.texts.at("Joint1.PeerName"), "AIC1");
}

TEST_F(Recorded, ASampleThatIsNoJsonObjectIsLeftOut) {
  recording.channels = {{"PID1.Out", "double", "", "V", ""}};
  add(0, 0ms, "1.5");
  add(0, 10ms, "{");
  EXPECT_TRUE(signals_of(recording).all.empty());
}

TEST(Names, AreSortedAsPeopleCount) {
  std::vector<std::string> names{"PID10", "PID2", "Joint3", "PID1", "PID", "PID02x"};
  std::sort(names.begin(), names.end(), before_by_number);
  EXPECT_THAT(names, ElementsAre("Joint3", "PID", "PID1", "PID2", "PID02x", "PID10"));
}

TEST(Thinned, KeepsEveryPeakAndTheOrderOfTime) {
  Signal signal;
  for (int i = 0; i < 10000; ++i) {
    signal.time_s.push_back(i);
    signal.values.push_back(i == 4321 ? 7.0 : i == 8765 ? -3.0 : 0.0);
  }
  const Signal thin = thinned(signal, 100);
  EXPECT_LE(thin.values.size(), 100u);
  EXPECT_EQ(thin.time_s.size(), thin.values.size());
  EXPECT_TRUE(std::is_sorted(thin.time_s.begin(), thin.time_s.end()));
  const auto peak = std::find(thin.values.begin(), thin.values.end(), 7.0);
  ASSERT_NE(peak, thin.values.end());
  EXPECT_EQ(thin.time_s[static_cast<std::size_t>(peak - thin.values.begin())], 4321.0);
  EXPECT_NE(std::find(thin.values.begin(), thin.values.end(), -3.0), thin.values.end());
}

TEST(Thinned, KeepsPeaksBesideWhatIsNoNumber) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  Signal signal;
  for (int i = 0; i < 1000; ++i) {
    signal.time_s.push_back(i);
    signal.values.push_back(i % 3 == 0 ? none : i == 500 ? 7.0 : i == 502 ? -3.0 : 1.0);
  }
  const Signal thin = thinned(signal, 10);
  EXPECT_NE(std::find(thin.values.begin(), thin.values.end(), 7.0), thin.values.end());
  EXPECT_NE(std::find(thin.values.begin(), thin.values.end(), -3.0), thin.values.end());
}

TEST(Limits, AreOneNumberOrAVectorForEachOrForAll) {
  const Signals signals{{{"A.Max", "", "", {0.0, 1.0}, {2.0, 3.0}},
                         {"B.Max[0]", "", "", {0.0}, {4.0}},
                         {"C.Max[0]", "", "", {0.0}, {5.0}},
                         {"C.Max[1]", "", "", {0.0}, {6.0}}},
                        {}};
  EXPECT_EQ(limit_in(signals, "A.Max", 4), 3.0) << "the last one";
  EXPECT_EQ(limit_in(signals, "B.Max", 4), 4.0);
  EXPECT_EQ(limit_in(signals, "C.Max", 1), 6.0);
  EXPECT_EQ(limit_in(signals, "C.Max", 2), std::nullopt);
  EXPECT_EQ(limit_in(signals, "D.Max", 0), std::nullopt);
}

TEST(Thinned, LeavesWhatFitsAsItIs) {
  const Signal signal{"x", "", "", {0.0, 1.0}, {1.0, 2.0}};
  EXPECT_EQ(thinned(signal, 2).values, signal.values);
}

TEST(Signals, OfARealRunBeginAtZero) {
  Signals signals{{{"A", "", "", {29000.5, 29001.0}, {1.0, 2.0}},
                   {"B", "", "", {29000.25}, {3.0}},
                   {"C", "", "", {}, {}}},
                  {}};
  EXPECT_EQ(begin_at_zero(signals), 29000.25);
  EXPECT_THAT(signals.all[0].time_s, ElementsAre(0.25, 0.75));
  EXPECT_THAT(signals.all[1].time_s, ElementsAre(0.0));
  begin_at(0.25, signals);
  EXPECT_THAT(signals.all[0].time_s, ElementsAre(0.0, 0.5));
}

TEST(Signals, AreOfTheJointThatTheirComponentIsByItsName) {
  EXPECT_EQ(joint_named("Joint12"), "12");
  EXPECT_EQ(joint_named("AIC2.Joint"), "2");
  EXPECT_EQ(joint_named("Pan.Joint"), "Pan");
  EXPECT_EQ(joint_named("AIC2.Card"), std::nullopt);
  EXPECT_EQ(joint_named("WAM"), std::nullopt);
}

}  // namespace
}  // namespace armature::report
