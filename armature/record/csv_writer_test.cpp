// SPDX-License-Identifier: Apache-2.0
#include "armature/record/csv_writer.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/platform/file.hpp"
#include "armature/record/internal/test_types.hpp"

namespace armature::record {

struct Leg {
  std::vector<double> q;
  bool on_ground = false;
  base::FixedText<8> name;
};
ARMATURE_STRUCT(Leg, (q, "rad", "of the joints"), on_ground, name);

namespace {

using testing::AllOf;
using testing::HasSubstr;

class Csv : public testing::Test {
 protected:
  Csv() {
    auto created = CsvWriter::create(path_);
    EXPECT_TRUE(created) << created.error();
    writer_ = std::move(created).value();
  }

  std::string content() const { return platform::read_file(path_).value(); }
  std::string closed_content() {
    EXPECT_TRUE(writer_->close());
    return content();
  }
  /// The rows, without names and comments.
  std::string closed_rows() {
    std::string text = closed_content();
    const std::size_t last_comment = text.rfind("\n#");
    return text.substr(text.find('\n', last_comment + 1) + 1);
  }

  const std::string path_ = testing::TempDir() + "/recording.csv";
  std::unique_ptr<CsvWriter> writer_;
};

TEST_F(Csv, EnumerationsAreNumbersForNumpyAndTheCommentNamesThem) {
  ASSERT_TRUE(writer_->add_channel(channel_of("Legs.gait", Gait::kStanding, {}, "of all legs")));
  ASSERT_TRUE(write(*writer_, 0, 0, Gait::kWalking));
  EXPECT_EQ(closed_content(),
            "time_s,Legs_gait\n"
            "# time_s: time_s [s]\n"
            "# Legs_gait: Legs.gait, of all legs (standing = 0, walking = 300, "
            "turning_on_the_spot = -2)\n"
            "0.000000000,300\n");
}

TEST_F(Csv, HasARowForEachTimeAndNanForWhatIsMissing) {
  ASSERT_TRUE(writer_->add_channel(channel_of("PID1.Out", 0.0, "rad", "what\nit says")));
  ASSERT_TRUE(writer_->add_channel(channel_of("Count", 0)));
  ASSERT_TRUE(write(*writer_, 0, 0, 0.5));
  ASSERT_TRUE(write(*writer_, 1, 0, 7));
  ASSERT_TRUE(write(*writer_, 1, 1'000'000, 8));
  ASSERT_TRUE(write(*writer_, 0, 12'000'000'001, -1e-9));
  EXPECT_EQ(closed_content(),
            "time_s,PID1_Out,Count\n"
            "# time_s: time_s [s]\n"
            "# PID1_Out: PID1.Out [rad], what it says\n"
            "# Count: Count\n"
            "0.000000000,0.5,7\n"
            "0.001000000,nan,8\n"
            "12.000000001,-1e-09,nan\n");
}

TEST_F(Csv, StructsAndVectorsBecomeColumns) {
  Leg leg;
  leg.q = {1, 2};
  leg.name = "left";
  ASSERT_TRUE(writer_->add_channel(channel_of("Leg", leg)));
  ASSERT_TRUE(writer_->add_channel(channel_of("Sensor.sensor", std::array<Pose, 2>{})));
  leg.on_ground = true;
  ASSERT_TRUE(write(*writer_, 0, 0, leg));
  ASSERT_TRUE(write(*writer_, 1, 0, std::array<Pose, 2>{Pose{1, 2}, Pose{3, 4}}));
  EXPECT_EQ(closed_content(),
            "time_s,Leg_q_0,Leg_q_1,Leg_on_ground,Sensor_sensor_0_x,Sensor_sensor_0_y,"
            "Sensor_sensor_1_x,Sensor_sensor_1_y\n"
            "# time_s: time_s [s]\n"
            "# Leg_q_0: Leg.q[0] [rad], of the joints\n"
            "# Leg_q_1: Leg.q[1] [rad], of the joints\n"
            "# Leg_on_ground: Leg.on_ground\n"
            "# Sensor_sensor_0_x: Sensor.sensor[0].x [m], ahead of the dock\n"
            "# Sensor_sensor_0_y: Sensor.sensor[0].y [m]\n"
            "# Sensor_sensor_1_x: Sensor.sensor[1].x [m], ahead of the dock\n"
            "# Sensor_sensor_1_y: Sensor.sensor[1].y [m]\n"
            "0.000000000,1,2,1,1,2,3,4\n");
}

TEST_F(Csv, EveryKindOfNumberIsWritten) {
  ASSERT_TRUE(writer_->add_channel(channel_of("All", make_everything())));
  ASSERT_TRUE(write(*writer_, 0, 1, make_everything()));
  EXPECT_EQ(
      closed_rows(),
      "0.000000001,1,-128,255,-32768,65535,-2147483648,4294967295,-9223372036854775808,"
      "18446744073709551615,0.1,-0.3333333333333333,-2,1,0,1,1.5,-2.5e-30,1,-2,1,2,3,4,1e+300,"
      "5e-324,1,2,3\n");
}

TEST_F(Csv, NumbersThatAreNotFiniteAreWrittenAsNumpyReadsThem) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  ASSERT_TRUE(writer_->add_channel(channel_of("A", std::array<double, 3>{})));
  ASSERT_TRUE(write(*writer_, 0, 0, std::array{kInfinity, -kInfinity, -std::nan("")}));
  EXPECT_EQ(closed_rows(), "0.000000000,inf,-inf,nan\n");
}

TEST_F(Csv, NamesThatWouldBeTheSameGetANumber) {
  for (const char* name : {"a.b", "a b", "a[b]", "time_s", "µ"}) {
    ASSERT_TRUE(writer_->add_channel(channel_of(name, 0)));
  }
  EXPECT_THAT(closed_content(), AllOf(HasSubstr("time_s,a_b,a_b_2,a_b_3,time_s_2,column\n"),
                                      HasSubstr("# a_b_3: a[b]\n")));
}

TEST_F(Csv, TextsAreLeftOutAndItSaysSo) {
  ASSERT_TRUE(writer_->add_channel(channel_of("State", base::FixedText<8>{})));
  ASSERT_TRUE(write(*writer_, 0, 0, base::FixedText<8>("a,b\n#")));
  EXPECT_EQ(closed_content(),
            "time_s\n# time_s: time_s [s]\n# State: left out, no number\n0.000000000\n");
}

TEST_F(Csv, OfTwoSamplesAtATimeTheLastStaysAndIsCounted) {
  ASSERT_TRUE(writer_->add_channel(channel_of("A", 0)));
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(write(*writer_, 0, 5, i));
  ASSERT_TRUE(write(*writer_, 0, 6, 9));
  EXPECT_EQ(writer_->replaced(), 2u);
  EXPECT_EQ(closed_rows(), "0.000000005,2\n0.000000006,9\n");
}

TEST_F(Csv, ASampleThatDoesNotFitIsRefusedAndTheRecordingContinues) {
  ASSERT_TRUE(writer_->add_channel(channel_of("V", std::vector<double>(2))));
  ASSERT_TRUE(write(*writer_, 0, 10, std::vector<double>{1, 2}));
  EXPECT_THAT(write(*writer_, 0, 9, std::vector<double>{1, 2}).error(),
              AllOf(HasSubstr("recording.csv"),
                    HasSubstr("channel 'V' is expected to have samples from 0.000000010 s on, but "
                              "one is of 0.000000009 s")));
  EXPECT_THAT(write(*writer_, 0, 11, std::vector<double>{1}).error(),
              HasSubstr("samples of 2 numbers as when it was added, but one has 1"));
  EXPECT_THAT(write(*writer_, 1, 11, 0).error(), HasSubstr("one of 1 channels"));
  ASSERT_TRUE(write(*writer_, 0, 12, std::vector<double>{3, 4}));
  EXPECT_EQ(closed_rows(), "0.000000010,1,2\n0.000000012,3,4\n");
}

TEST_F(Csv, AChannelAfterTheFirstRowIsRefused) {
  ASSERT_TRUE(writer_->add_channel(channel_of("A", 0)));
  ASSERT_TRUE(write(*writer_, 0, 0, 1));
  EXPECT_THAT(writer_->add_channel(channel_of("B", 0)).error(),
              HasSubstr("channel 'B' is expected before the first sample"));
}

TEST_F(Csv, FlushHandsOverAllRowsButTheLast) {
  ASSERT_TRUE(writer_->add_channel(channel_of("A", 0)));
  ASSERT_TRUE(write(*writer_, 0, 0, 1));
  ASSERT_TRUE(write(*writer_, 0, 1, 2));
  EXPECT_EQ(writer_->unsaved(), 2u);
  ASSERT_TRUE(writer_->flush());
  EXPECT_EQ(writer_->unsaved(), 1u);
  EXPECT_THAT(content(), testing::EndsWith("\n0.000000000,1\n"));
  EXPECT_THAT(closed_content(), testing::EndsWith("\n0.000000000,1\n0.000000001,2\n"));
}

TEST_F(Csv, RefusesToWriteOnceItIsClosed) {
  ASSERT_TRUE(writer_->add_channel(channel_of("A", 0)));
  EXPECT_THAT(closed_content(), HasSubstr("time_s,A\n"));
  EXPECT_TRUE(writer_->close());
  EXPECT_THAT(write(*writer_, 0, 0, 0).error(), HasSubstr("is closed already"));
  EXPECT_FALSE(writer_->flush());
  EXPECT_FALSE(writer_->add_channel(channel_of("B", 0)));
}

TEST(CsvWriter, SaysThatTheFileCannotBeMade) {
  EXPECT_THAT(CsvWriter::create("/no/such/folder/a.csv").error(),
              HasSubstr("cannot write '/no/such/folder/a.csv': No such file or directory"));
}

}  // namespace
}  // namespace armature::record
