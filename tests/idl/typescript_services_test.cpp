// SPDX-License-Identifier: Apache-2.0
// Generated placeholders in C++ call generated services in TypeScript: served.ts starts this
// program, and says in SERVICE where they are.
#include <chrono>
#include <cstdlib>
#include <future>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/ride/node.hpp"
#include "armature/types/type.hpp"
#include "chassis_client.hpp"
#include "everything_client.hpp"

namespace armature::idl {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr ride::CallOptions kPatient{.deadline = 20s, .priority = {}};

template <typename T>
std::string text_of(const T& value) {
  return types::to_text(types::type_of<T>(), &value);
}

class TypescriptServices : public ::testing::Test {
 protected:
  TypescriptServices() { EXPECT_TRUE(peer().wait_until_connected(20s).ok()); }
  ride::Peer& peer() { return node_.connect(std::getenv("SERVICE")); }

 private:
  ride::Node node_;

 protected:
  everything::EchoPlaceholder echo_{peer(), "echo"};
  chassis::ChassisPlaceholder wheels_{peer(), "wheels"};
};

everything::Ranges good_ranges() {
  everything::Ranges value;
  value.o = 1;
  value.ui = 3;
  value.l = -1;
  value.ul = 1ull << 63;
  value.d = 0.5;
  return value;
}

TEST_F(TypescriptServices, AreFoundByTheirNames) {
  const auto all = peer().components(20s);
  ASSERT_TRUE(all.ok());
  std::vector<std::string> names;
  for (const auto& each : all.value()) names.push_back(each.name + ":" + each.interface);
  EXPECT_THAT(names, ElementsAre("echo:Echo", "wheels:Chassis", "workshop:ChassisService_"));
}

TEST_F(TypescriptServices, GiveEverySingleTypeBack) {
  EXPECT_TRUE(echo_.echo_bool(true, kPatient).value());
  EXPECT_EQ(echo_.echo_char(-128, kPatient).value(), -128);
  EXPECT_EQ(echo_.echo_byte(255, kPatient).value(), 255);
  EXPECT_EQ(echo_.echo_short(-32768, kPatient).value(), -32768);
  EXPECT_EQ(echo_.echo_unsigned_short(65535, kPatient).value(), 65535);
  EXPECT_EQ(echo_.echo_int(-2000000000, kPatient).value(), -2000000000);
  EXPECT_EQ(echo_.echo_unsigned_int(4000000000, kPatient).value(), 4000000000);
  EXPECT_EQ(echo_.echo_long(-(1ll << 62), kPatient).value(), -(1ll << 62));
  EXPECT_EQ(echo_.echo_unsigned_long(1ull << 63, kPatient).value(), 1ull << 63);
  EXPECT_EQ(echo_.echo_float(0.1f, kPatient).value(), 0.1f);
  EXPECT_EQ(echo_.echo_double(0.1, kPatient).value(), 0.1);
  EXPECT_EQ(echo_.echo_string("grüße", kPatient).value(), "grüße");
}

TEST_F(TypescriptServices, GiveStructsArraysAndEnumerationsBack) {
  everything::Lists lists;
  lists.b = {1, 0};
  lists.o = {1, 255};
  lists.text = {"a", "b"};
  lists.inner = {{true, 2.0}};
  EXPECT_EQ(text_of(echo_.echo_lists(lists, kPatient).value()), text_of(lists));
  everything::Fixed fixed;
  fixed.d = {1.0, 2.0, 3.0};
  EXPECT_EQ(text_of(echo_.echo_fixed(fixed, kPatient).value()), text_of(fixed));
  EXPECT_EQ(text_of(echo_.echo_ranges(good_ranges(), kPatient).value()), text_of(good_ranges()));
  using everything::Mode;
  const std::vector<Mode> modes{Mode::kPosition, Mode::kIdle};
  EXPECT_EQ(echo_.echo_modes(modes, kPatient).value(), modes);
  EXPECT_EQ(echo_.echo_frame(geometry::Frame::kFloor, kPatient).value(), geometry::Frame::kFloor);
  EXPECT_EQ(echo_.delete_(1, 2, 3, 4, 5, 6, kPatient).value(), 123456);
}

TEST_F(TypescriptServices, TakeABodyOfManyMessagesAndRefuseOneThatIsTooLarge) {
  const std::string text(700'000, 'x');
  EXPECT_EQ(echo_.echo_string(text, kPatient).value(), text);
  const auto refused = echo_.echo_string(std::string(1'100'000, 'x'), kPatient);
  EXPECT_EQ(refused.code(), ride::Code::kTooLarge);
  EXPECT_EQ(echo_.echo_string("next", kPatient).value(), "next");
}

/// What comes first of an event.
template <typename Event>
struct First {
  std::promise<Event> came;
  bool done = false;
  void take(const Event& event) {
    if (!std::exchange(done, true)) came.set_value(event);
  }
  bool wait() { return got.wait_for(20s) == std::future_status::ready; }
  std::future<Event> got = came.get_future();
};

TEST_F(TypescriptServices, ExecuteCommandsAndRaiseEvents) {
  First<everything::Everything> all;
  First<everything::ModeChanged> changed;
  const auto first = echo_.on_Everything([&](const auto& event) { all.take(event); });
  const auto second = echo_.on_ModeChanged([&](const auto& event) { changed.take(event); });
  EXPECT_TRUE(echo_.echo_bool(true, kPatient).ok());  // behind the subscriptions
  EXPECT_EQ(echo_.nothing(), ride::Sent::kYes);
  EXPECT_EQ(echo_.change_mode(everything::Mode::kPosition), ride::Sent::kYes);
  ASSERT_TRUE(all.wait() && changed.wait());
  EXPECT_EQ(text_of(all.got.get()), text_of(everything::Everything{}));
  EXPECT_EQ(changed.got.get().mode, everything::Mode::kPosition);
  EXPECT_EQ(wheels_.setVelocity(0.5f, -0.5f), ride::Sent::kYes);
  const auto pose = wheels_.where(kPatient).value();
  EXPECT_EQ(pose.x, 0.5);
  EXPECT_EQ(pose.y, -0.5);
}

TEST_F(TypescriptServices, TellOfACommandThatFails) {
  std::promise<std::string> failed;
  const auto told = echo_.on_failed(
      [&](const ride::Failed& event) { failed.set_value(event.operation + ": " + event.text); });
  EXPECT_TRUE(echo_.echo_bool(true, kPatient).ok());  // behind the subscription
  EXPECT_EQ(echo_.request_("fail", 0.5f), ride::Sent::kYes);
  auto why = failed.get_future();
  ASSERT_EQ(why.wait_for(20s), std::future_status::ready);
  EXPECT_EQ(why.get(), "request: no part of 0.5");
}

TEST_F(TypescriptServices, AnswerWhenTheyCanAndSayWhyTheyFailed) {
  First<chassis::Arrived> arrived;
  const auto told = wheels_.on_Arrived([&](const auto& event) { arrived.take(event); });
  EXPECT_TRUE(wheels_.where(kPatient).ok());
  EXPECT_EQ(wheels_.whereItStands(3.0, kPatient).value().x, 3.0);
  ASSERT_TRUE(arrived.wait());
  EXPECT_EQ(arrived.got.get().pose.heading, 0.5);
  const auto failed = wheels_.whereItStands(0.0, kPatient);
  EXPECT_EQ(failed.code(), ride::Code::kFailed);
  EXPECT_THAT(failed.error(), HasSubstr("it is driving"));
}

TEST_F(TypescriptServices, RefuseWhoMayNot) {
  EXPECT_THAT(wheels_.touched(kPatient).value(), ElementsAre(1, 0));
  const auto follow = wheels_.follow({"", {}}, 0.5, kPatient);
  EXPECT_EQ(follow.code(), ride::Code::kNotAllowed);
  EXPECT_THAT(follow.error(), HasSubstr("local may not configure 'map'"));
  chassis::ChassisService_Placeholder workshop(peer(), "workshop");
  const auto gains = workshop.setGains({}, {}, {}, kPatient);
  EXPECT_EQ(gains.code(), ride::Code::kNotAllowed);
  EXPECT_THAT(gains.error(), HasSubstr("local may not configure 'workshop'"));
}

/// A placeholder that sends whatever it is told to, as one of another language may.
class Unchecked : public ride::Placeholder {
 public:
  explicit Unchecked(ride::Peer& peer) : Placeholder(peer, "echo", everything::kEcho) {}
  template <typename... Parameters>
  ride::Answer<std::int32_t> ask(std::string_view operation, const Parameters&... parameters) {
    for (const ride::Declaration& each : everything::kEchoDeclarations) {
      if (each.canonical.find(operation) == std::string_view::npos) continue;
      return request<std::int32_t>(each.number(), "asked", kPatient, parameters...);
    }
    return request<std::int32_t>(ride::number_of(operation), "asked", kPatient, parameters...);
  }
};

TEST_F(TypescriptServices, RefuseWhatIsNoneOfAnOperationsParameters) {
  Unchecked echo(peer());
  const auto refusal = [&](std::string_view operation, const auto&... parameters) {
    const auto answer = echo.ask(operation, parameters...);
    EXPECT_EQ(answer.code(), ride::Code::kMalformed);
    return answer.error();
  };
  EXPECT_THAT(refusal("request(", std::string("most"), 0.8f), HasSubstr("parameter part is 0.8"));
  everything::Ranges bad = good_ranges();
  bad.later = {{0}, {2}};
  EXPECT_THAT(refusal("echo_ranges(", bad), HasSubstr("Later.bit is 2, expected 0 to 1"));
  EXPECT_THAT(refusal(" echo_mode(", static_cast<everything::Mode>(3)),
              HasSubstr("expected one of idle, position, hold_position"));
  EXPECT_THAT(refusal(" echo_int("), HasSubstr("parameter value ends at byte"));
  EXPECT_THAT(refusal(" echo_int(", std::int32_t{1}, true), HasSubstr("left over"));
  EXPECT_EQ(echo.ask("int no_such_operation()").code(), ride::Code::kNoSuchOperation);
}

TEST_F(TypescriptServices, AreToldOfTheEndOfAConnection) {
  const double before = wheels_.where(kPatient).value().heading;
  {
    ride::Node other;
    ride::Peer& there = other.connect(std::getenv("SERVICE"));
    ASSERT_TRUE(there.wait_until_connected(20s).ok());
    chassis::ChassisPlaceholder waiting(there, "wheels");
    EXPECT_EQ(waiting.whereItStands(60.0, {.deadline = 50ms, .priority = {}}).code(),
              ride::Code::kDeadline);
  }
  double after = before;
  while (after == before) after = wheels_.where(kPatient).value().heading;
  EXPECT_EQ(after, before + 1.0);
}

}  // namespace
}  // namespace armature::idl
