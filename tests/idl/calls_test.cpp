// SPDX-License-Identifier: Apache-2.0
// A generated placeholder calls a generated service through two nodes.
#include <atomic>
#include <chrono>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/ride/node.hpp"
#include "armature/types/type.hpp"
#include "chassis_client.hpp"
#include "chassis_service.hpp"
#include "everything_client.hpp"
#include "everything_service.hpp"
#include "tests/idl/echo.hpp"

namespace armature::idl {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

constexpr ride::CallOptions kPatient{.deadline = 20s, .priority = {}};

class Calls : public ::testing::Test {
 protected:
  Calls() : echo_(peer(), "echo") { EXPECT_TRUE(peer().wait_until_connected(20s).ok()); }

  ride::Peer& peer() {
    if (address_.empty()) {
      address_ = server_.listen("tcp://127.0.0.1:0").value().text();
      EXPECT_TRUE(server_.add("echo", service_).ok());
    }
    return client_.connect(address_);
  }

  template <typename T>
  static std::string text_of(const T& value) {
    return types::to_text(types::type_of<T>(), &value);
  }

  std::string address_;
  Echo service_;
  ride::Node server_;
  ride::Node client_;
  everything::EchoPlaceholder echo_;
};

everything::Ranges good() {
  everything::Ranges value;
  value.o = 1;
  value.ui = 3;
  value.l = -1;
  value.ul = 1ull << 63;
  value.d = 0.5;
  return value;
}

TEST_F(Calls, EverySingleTypeComesBack) {
  EXPECT_TRUE(echo_.echo_bool(true, kPatient).value());
  EXPECT_EQ(echo_.echo_char('x', kPatient).value(), 'x');
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

TEST_F(Calls, StructsAndArraysComeBack) {
  everything::Lists lists;
  lists.b = {1, 0};
  lists.text = {"a", "b"};
  lists.inner = {{true, 2.0}};
  EXPECT_EQ(text_of(echo_.echo_lists(lists, kPatient).value()), text_of(lists));
  everything::Fixed fixed;
  fixed.d = {1.0, 2.0, 3.0};
  EXPECT_EQ(text_of(echo_.echo_fixed(fixed, kPatient).value()), text_of(fixed));
  everything::Singles singles;
  singles.text = "x";
  EXPECT_EQ(text_of(echo_.echo_singles(singles, kPatient).value()), text_of(singles));
  EXPECT_EQ(echo_.echo_strings({"a", ""}, kPatient).value(), (std::vector<std::string>{"a", ""}));
  EXPECT_EQ(echo_.echo_inners({{true, 3.0}}, kPatient).value().at(0).value, 3.0);
  EXPECT_EQ(echo_.echo_two_flags({true, false}, kPatient).value(),
            (std::array<bool, 2>{true, false}));
}

TEST_F(Calls, EnumerationsComeBack) {
  using everything::Mode;
  EXPECT_EQ(echo_.echo_mode(Mode::kHoldPosition, kPatient).value(), Mode::kHoldPosition);
  EXPECT_EQ(echo_.echo_frame(geometry::Frame::kFloor, kPatient).value(), geometry::Frame::kFloor);
  const std::vector<Mode> modes{Mode::kPosition, Mode::kIdle};
  EXPECT_EQ(echo_.echo_modes(modes, kPatient).value(), modes);
  everything::Choices choices;
  choices.mode = Mode::kPosition;
  choices.l = everything::Long::kAfterLeast;
  choices.modes = modes;
  choices.two = {everything::Int::kClass, everything::Int::kLeast};
  choices.frame = geometry::Frame::kFloor;
  EXPECT_EQ(text_of(echo_.echo_choices(choices, kPatient).value()),
            "{mode: position, c: zero, s: zero, us: zero, i: zero, ui: zero, l: after_least, "
            "modes: [position, idle], two: [class, least], frame: floor}");
}

TEST_F(Calls, FlagsAreZeroOrOne) {
  EXPECT_EQ(echo_.echo_flags({0, 1, 9}, kPatient).value(), (ride::Flags{0, 1, 1}));
}

TEST_F(Calls, ParametersKeepTheirPlacesWhateverTheyAreCalled) {
  EXPECT_EQ(echo_.delete_(1, 2, 3, 4, 5, 6, kPatient).value(), 123456);
}

TEST_F(Calls, ACommandArrives) {
  EXPECT_EQ(echo_.request_("half", 0.5f), ride::Sent::kYes);
  auto requested = service_.requested.get_future();
  ASSERT_EQ(requested.wait_for(20s), std::future_status::ready);
  EXPECT_EQ(requested.get(), "half 0.500000");
}

TEST_F(Calls, ACommandOutsideItsRangeIsNotSent) {
  EXPECT_EQ(echo_.request_("most", 0.8f), ride::Sent::kMalformed);
}

TEST_F(Calls, ARequestOutsideItsRangeIsNotSent) {
  const auto elements = echo_.echo_ranged({good()}, {4}, kPatient);
  EXPECT_EQ(elements.code(), ride::Code::kMalformed);
  EXPECT_THAT(elements.error(), HasSubstr("echo_ranged"));
  EXPECT_THAT(elements.error(),
              HasSubstr("parameter small has an element outside its range, expected 0 to 3"));
  everything::Ranges bad = good();
  bad.c = 6;
  EXPECT_THAT(echo_.echo_ranges(bad, kPatient).error(),
              HasSubstr("parameter value has a member outside its range"));
  EXPECT_THAT(echo_.echo_ranged({bad}, {}, kPatient).error(), HasSubstr("outside its range"));
  EXPECT_EQ(echo_.echo_ranged({good()}, {3}, kPatient).value().size(), 1u);
}

/// A placeholder that sends whatever it is told to, as one of another language may.
class Unchecked : public ride::Placeholder {
 public:
  explicit Unchecked(ride::Peer& peer) : Placeholder(peer, "echo", everything::kEcho) {}
  template <typename... Parameters>
  std::string refusal(std::string_view canonical, const Parameters&... parameters) {
    const auto answer =
        request<std::int32_t>(ride::number_of(canonical), "asked", kPatient, parameters...);
    EXPECT_EQ(answer.code(), ride::Code::kMalformed);
    return answer.error();
  }
};

std::string_view canonical_of(std::string_view operation) {
  for (const ride::Declaration& declaration : everything::kEchoDeclarations) {
    if (declaration.canonical.find(operation) != std::string_view::npos) {
      return declaration.canonical;
    }
  }
  return {};
}

TEST_F(Calls, AServiceNamesWhatIsOutsideItsRangeWithItsLimits) {
  Unchecked echo(peer());
  const std::vector<everything::Ranges> none;
  EXPECT_THAT(echo.refusal(canonical_of("request("), std::string("most"), 0.8f),
              HasSubstr("parameter part is 0.8, expected 0.25 to 0.75"));
  EXPECT_THAT(echo.refusal(canonical_of("echo_ranged("), none, std::vector<std::uint8_t>{4}),
              HasSubstr("parameter small has an element outside its range, expected 0 to 3"));
}

TEST_F(Calls, AServiceNamesAMemberThatIsOutsideItsRangeWithItsLimits) {
  Unchecked echo(peer());
  everything::Ranges bad = good();
  bad.c = 6;
  EXPECT_THAT(echo.refusal(canonical_of("echo_ranges("), bad),
              HasSubstr("member Ranges.c is 6, expected -5 to 5"));
  bad = good();
  bad.later = {{0}, {2}};
  EXPECT_THAT(echo.refusal(canonical_of("echo_ranges("), bad),
              HasSubstr("member Later.bit is 2, expected 0 to 1"));
  bad = good();
  bad.ul = 7;
  EXPECT_THAT(echo.refusal(canonical_of("echo_ranges("), bad),
              HasSubstr("Ranges.ul is 7, expected 9223372036854775808 to 18446744073709551615"));
}

TEST_F(Calls, AnEventReachesItsSubscriber) {
  std::promise<everything::Everything> raised;
  const auto told =
      echo_.on_Everything([&](const everything::Everything& event) { raised.set_value(event); });
  EXPECT_TRUE(echo_.echo_bool(true, kPatient).ok());  // behind the subscription
  EXPECT_EQ(echo_.nothing(), ride::Sent::kYes);
  auto event = raised.get_future();
  ASSERT_EQ(event.wait_for(20s), std::future_status::ready);
  EXPECT_EQ(text_of(event.get()), text_of(everything::Everything{}));
}

constexpr auto kNoMode = static_cast<everything::Mode>(3);

TEST_F(Calls, AServiceRefusesANumberThatNoEnumeratorHas) {
  Unchecked echo(peer());
  const std::string why = "Mode is 3, expected idle, position or hold_position";
  EXPECT_THAT(echo.refusal(canonical_of(" echo_mode("), kNoMode), HasSubstr(why));
  EXPECT_THAT(echo.refusal(canonical_of(" echo_modes("), std::vector{kNoMode}), HasSubstr(why));
  everything::Choices choices;
  choices.mode = kNoMode;
  EXPECT_THAT(echo.refusal(canonical_of(" echo_choices("), choices), HasSubstr(why));
}

TEST_F(Calls, AnAnswerThatNoEnumeratorHasIsMalformed) {
  service_.answered_frame = static_cast<geometry::Frame>(2);
  const auto answer = echo_.echo_frame(geometry::Frame::kDock, kPatient);
  EXPECT_EQ(answer.code(), ride::Code::kMalformed);
}

TEST_F(Calls, CommandsAndEventsWithANumberThatNoEnumeratorHasAreDropped) {
  std::vector<everything::Mode> told;
  std::promise<void> ended;
  const auto subscription = echo_.on_ModeChanged([&](const everything::ModeChanged& event) {
    told.push_back(event.mode);
    if (event.mode == everything::Mode::kPosition) ended.set_value();
  });
  EXPECT_TRUE(echo_.echo_bool(true, kPatient).ok());  // behind the subscription
  EXPECT_EQ(echo_.change_mode(kNoMode), ride::Sent::kYes);
  service_.raise(everything::ModeChanged{everything::Mode::kIdle, {kNoMode}});
  EXPECT_EQ(echo_.change_mode(everything::Mode::kPosition), ride::Sent::kYes);
  ASSERT_EQ(ended.get_future().wait_for(20s), std::future_status::ready);
  EXPECT_THAT(told, ::testing::ElementsAre(everything::Mode::kPosition));
}

class Wheels final : public chassis::ChassisService {
 public:
  void setVelocity(float, float) override { ADD_FAILURE() << "outside its range"; }
  std::int32_t follow(const chassis::Route&, double) override { return 0; }
  geometry::Pose where() override { return {1.0, 2.0, 0.5}; }
  void whereItStands(double limit, ride::ReplyOf<geometry::Pose> reply) override {
    if (limit == 0.0) throw ride::Failure("it is driving");
    if (limit == 1.0) return;
    kept.push_back(reply.keep());
    if (limit == 2.0) kept.back().put({3.0, 0.0, 0.0});
    if (limit == 3.0) kept.back().fail("it fell over");
    if (limit == 4.0) kept.pop_back();
  }
  void touched(ride::ReplyOf<ride::Flags> reply) override {
    reply.demand("bumper", ride::Access::kConfigure);
    reply.put(reply.allows("bumper", ride::Access::kRead) ? ride::Flags{1} : ride::Flags{0});
  }

  std::vector<ride::PendingReplyOf<geometry::Pose>> kept;
};

/// What a service says to a message as another implementation could send it.
template <typename... Parameters>
ride::Executed executed(ride::Service& service, ride::Number number, const Parameters&... all) {
  ride::Body body;
  ride::Encoder to(body);
  (to.put(all), ...);
  ride::Decoder from(body.bytes());
  ride::Reply reply(nullptr, 0, {}, number, 1);
  return ride::ServiceAccess::execute(service, number, from, reply);
}

TEST(GeneratedService, RefusesWhatIsOutsideItsRange) {
  Wheels wheels;
  EXPECT_EQ(executed(wheels, 0x66e299df, 0.5f, 1.6f), ride::Executed::kMalformed);
  EXPECT_EQ(executed(wheels, 0x66e299df, -1.6f, 0.0f), ride::Executed::kMalformed);
}

TEST(GeneratedService, RefusesWhatIsTooShortOrTooLong) {
  Wheels wheels;
  EXPECT_EQ(executed(wheels, 0x66e299df, 0.5f), ride::Executed::kMalformed);
  EXPECT_EQ(executed(wheels, 0x66e299df, 0.5f, 0.5f, true), ride::Executed::kMalformed);
}

TEST(GeneratedService, RefusesAMemberOutsideItsRange) {
  Wheels wheels;
  const chassis::Route route{"", {{0.0, 0.0, 4.0}}};
  EXPECT_EQ(executed(wheels, chassis::kChassisDeclarations[1].number(), route, 0.5),
            ride::Executed::kMalformed);
}

TEST(GeneratedService, KnowsOnlyItsOwnOperations) {
  Wheels wheels;
  EXPECT_EQ(executed(wheels, 0x12345678), ride::Executed::kNoSuchOperation);
}

/// A Chassis whose operations answer later, and one who asks it.
class LaterTest : public ::testing::Test {
 protected:
  LaterTest() {
    ride::NodeOptions options;
    options.allows = [this](const ride::AccessQuestion& question) {
      return question.component == "wheels" || question.access <= most_;
    };
    server_.emplace(options);
    EXPECT_TRUE(server_->add("wheels", wheels_).ok());
    const std::string address = server_->listen("tcp://127.0.0.1:0").value().text();
    wheels.emplace(client_.connect(address), "wheels");
    EXPECT_TRUE(wheels->peer().wait_until_connected(20s).ok());
  }

  std::optional<chassis::ChassisPlaceholder> wheels;
  std::atomic<ride::Access> most_{ride::Access::kConfigure};

 private:
  ride::Node client_;
  Wheels wheels_;
  std::optional<ride::Node> server_;
};

TEST_F(LaterTest, AnOperationAnswersWhenItCan) {
  EXPECT_EQ(wheels->whereItStands(2.0, kPatient).value().x, 3.0);
  EXPECT_THAT(wheels->touched(kPatient).value(), ::testing::ElementsAre(1));
}

TEST_F(LaterTest, WhyItFailedIsToldWheneverThatIs) {
  EXPECT_THAT(wheels->whereItStands(0.0, kPatient).error(), HasSubstr("it is driving"));
  EXPECT_THAT(wheels->whereItStands(3.0, kPatient).error(), HasSubstr("it fell over"));
}

TEST_F(LaterTest, WhoForgetsToAnswerHasFailed) {
  for (const double limit : {1.0, 4.0}) {
    const auto answer = wheels->whereItStands(limit, kPatient);
    EXPECT_EQ(answer.code(), ride::Code::kFailed);
    EXPECT_THAT(answer.error(), HasSubstr("dropped the request without an answer"));
  }
}

TEST_F(LaterTest, ThePolicyIsAskedForOtherComponentsToo) {
  most_ = ride::Access::kCommand;
  const auto refused = wheels->touched(kPatient);
  EXPECT_EQ(refused.code(), ride::Code::kNotAllowed);
  EXPECT_THAT(refused.error(), HasSubstr("local may not configure 'bumper'"));
}

}  // namespace
}  // namespace armature::idl
