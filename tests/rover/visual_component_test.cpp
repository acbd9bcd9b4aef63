// SPDX-License-Identifier: Apache-2.0
// The component Vision, in an application, as any program of RIDE sees it by rover.idl alone.
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/remote/interface_numbers.hpp"
#include "armature/ride/node.hpp"
#include "robots/rover/image_size.hpp"
#include "robots/rover/vision/vision.hpp"
#include "rover_client.hpp"
#include "tests/remote/processes.hpp"

namespace armature::rover {
namespace {

using namespace std::chrono_literals;
using remote::InterfaceNumbers;
using remote::NumberedMember;
using remote::test::Process;
using remote::test::serve_until;
using ::rover::VSPlaceholder;
using ::testing::Contains;
using ::testing::HasSubstr;

/// A red square with cut corners in the middle of the picture, until it is frozen.
class TestCamera final : public component::Component {
 public:
  using Component::Component;

  std::atomic<bool> frozen{false};

 private:
  component::Outcome on_configure() override {
    image_.assign(static_cast<std::size_t>(size_.bytes().get()), 90);
    for (int row = 8; row < 16; ++row) {
      for (int column = 12; column < 20; ++column) {
        const bool corner = (row == 8 || row == 15) && (column == 12 || column == 19);
        if (!corner) paint_red(column, row);
      }
    }
    return component::accepted();
  }
  void on_update() override {
    if (!frozen) ++image_[0];
    output_.write(image_);
  }
  void paint_red(int column, int row) {
    std::uint8_t* const pixel = image_.data() + 3 * static_cast<std::size_t>(row * width_ + column);
    pixel[0] = 220;
    pixel[1] = pixel[2] = 20;
  }

  component::Property<int> width_{this, "ImageWidth", 32, "", "px", kImageSide};
  component::Property<int> height_{this, "ImageHeight", 24, "", "px", kImageSide};
  ImageSize size_{this, width_, height_};
  component::OutputPort<std::vector<std::uint8_t>> output_{this, "Image", "", "",
                                                           component::size_of(size_.bytes())};
  std::vector<std::uint8_t> image_;
};

void add_models(component::Registry& models) {
  models.add<TestCamera>("TestCamera", "");
  models.add<Vision>("VS", "");
}

std::string robot(const std::string& activity = "{periodic: 5 ms}",
                  const std::string& height = "24") {
  return std::string("network: {listen: 'tcp://127.0.0.1:0', policy: ") + REMOTE_TESTDATA +
         "/all.policy}\n"
         "components:\n"
         "  Camera: {model: TestCamera, activity: {periodic: 5 ms}}\n"
         "  Vision: {model: VS, activity: " +
         activity + ", properties: {ImageWidth: 32, ImageHeight: " + height +
         "}}\n"
         "connections: [Camera.Image -> Vision.Image]\n";
}

std::string mistakes_in(const std::string& yaml) {
  return Process(yaml, add_models).deployment.diagnostics.to_text();
}

// --- its interface -------------------------------------------------------------------------------

TEST(VisualComponent, HasTheNumbersOfTable4) {
  const Vision vision("Vision");
  const InterfaceNumbers numbers("Vision", component::interface_of(vision));
  ASSERT_EQ(::rover::kVS.declarations.size(), 5u);
  for (const ride::Declaration& declared : ::rover::kVS.declarations) {
    const NumberedMember* const member = numbers.find(declared.number());
    ASSERT_NE(member, nullptr) << declared.canonical;
    const auto expected = declared.is_event() ? NumberedMember::Kind::kEvent
                          : declared.canonical.starts_with("void ")
                              ? NumberedMember::Kind::kCommand
                              : NumberedMember::Kind::kOperation;
    EXPECT_EQ(member->kind, expected) << declared.canonical;
  }
}

TEST(VisualComponent, TellsOfFailuresByTheEventOfRide) {
  const Vision vision("Vision");
  const InterfaceNumbers numbers("Vision", component::interface_of(vision));
  const NumberedMember* const member = numbers.find(ride::kFailedDeclaration.number());
  ASSERT_NE(member, nullptr);
  EXPECT_EQ(member->kind, NumberedMember::Kind::kEvent);
}

// --- as another process uses it ------------------------------------------------------------------

/// The application with the component, and a node that knows rover.idl only.
class VisualComponentTest : public ::testing::Test {
 protected:
  VisualComponentTest() {
    robot_.start();
    peer_ = &node_.connect(robot_.address());
    vision_ = std::make_unique<VSPlaceholder>(*peer_, "Vision");
    told_ = vision_->on_failed([this](const ride::Failed& failed) {
      const std::scoped_lock lock(mutex_);
      failures_.push_back(failed.operation + ": " + failed.text);
    });
    seen_ = vision_->on_ObjectPositionEvent([this](const ::rover::ObjectPositionEvent& position) {
      x_ = position.x;
      y_ = position.y;
      ++positions_;
    });
    EXPECT_TRUE(peer_->wait_until_connected(10s));
  }

  /// The answer to a request while the application serves.
  std::int32_t ask(const std::function<ride::Answer<std::int32_t>(VSPlaceholder&)>& request) {
    auto answer = std::async(std::launch::async, [&] { return request(*vision_); });
    EXPECT_TRUE(
        serve_until({&robot_}, [&] { return answer.wait_for(0s) == std::future_status::ready; }));
    const auto given = answer.get();
    EXPECT_TRUE(given.ok()) << given.error();
    return given.ok() ? given.value() : -1;
  }
  std::int32_t initialize() {
    return ask([](VSPlaceholder& vision) { return vision.initialize(); });
  }
  bool wait_for_failure(const std::string& text) {
    return serve_until({&robot_}, [&] {
      const std::scoped_lock lock(mutex_);
      return ::testing::Value(failures_, Contains(HasSubstr(text)));
    });
  }

  Process robot_{robot(), add_models};
  ride::Node node_;
  ride::Peer* peer_ = nullptr;
  std::unique_ptr<VSPlaceholder> vision_;
  std::mutex mutex_;
  std::vector<std::string> failures_;
  std::atomic<int> x_{-1};
  std::atomic<int> y_{-1};
  std::atomic<int> positions_{0};
  ride::Subscription told_;
  ride::Subscription seen_;
};

TEST_F(VisualComponentTest, StartBeforeInitializeIsAnsweredByFailed) {
  vision_->start();
  EXPECT_TRUE(wait_for_failure("start: it is not initialized: call initialize first"));
  EXPECT_EQ(positions_, 0);
}

TEST_F(VisualComponentTest, ItsPositionsComeAfterInitializeSetThresholdAndStart) {
  EXPECT_EQ(initialize(), 0);
  EXPECT_EQ(ask([](VSPlaceholder& vision) { return vision.setThreshold(300, 0, 0); }), 1);
  EXPECT_EQ(ask([](VSPlaceholder& vision) { return vision.setThreshold(255, 0, 0); }), 0);
  vision_->start();
  EXPECT_TRUE(serve_until({&robot_}, [&] { return positions_ >= 3; }));
  EXPECT_EQ(x_, 16);
  EXPECT_EQ(y_, 24 - 12);
}

TEST_F(VisualComponentTest, AFrozenCameraIsToldByFailedOnce) {
  ASSERT_EQ(initialize(), 0);
  vision_->start();
  ASSERT_TRUE(serve_until({&robot_}, [&] { return positions_ >= 1; }));
  robot_.find<TestCamera>("Camera").frozen = true;
  EXPECT_TRUE(wait_for_failure("start: the camera sends the same image again and again"));
  EXPECT_EQ(initialize(), 1);
  const std::scoped_lock lock(mutex_);
  EXPECT_EQ(failures_.size(), 1u);
}

// --- as a deployment of another process uses it --------------------------------------------------

/// Its superior in another application: commands it, and hears its events.
class Superior final : public component::Component {
 public:
  using Component::Component;

  std::atomic<bool> begins{false};
  std::atomic<int> x{-1};
  std::atomic<int> failures{0};

 private:
  void on_update() override {
    if (!begins.exchange(false)) return;
    static_cast<void>(initialize_.send());
    static_cast<void>(start_.send());
  }
  void follow(std::int32_t right, std::int32_t) { x = right; }
  void note(const base::FixedText<31>&, const base::FixedText<127>&) { ++failures; }

  component::OperationCaller<std::int32_t()> initialize_{this, "initialize", ""};
  component::CommandCaller<> start_{this, "start", ""};
  component::EventHandler<std::int32_t, std::int32_t> position_{
      this, "ObjectPositionEvent", component::serve<&Superior::follow>, ""};
  component::EventHandler<base::FixedText<31>, base::FixedText<127>> failed_{
      this, "Failed", component::serve<&Superior::note>, ""};
};

TEST_F(VisualComponentTest, ASuperiorElsewhereKnowsItsModelOnly) {
  Process pilot("components:\n  Vision: {model: VS, remote: '" + robot_.address() +
                    "/Vision'}\n"
                    "  Superior: {model: Superior, activity: {periodic: 5 ms}, peers: [Vision]}\n",
                [](component::Registry& models) {
                  add_models(models);
                  models.add<Superior>("Superior", "");
                });
  auto started = std::async(std::launch::async, [&] { pilot.start(); });
  EXPECT_TRUE(
      serve_until({&robot_}, [&] { return started.wait_for(0s) == std::future_status::ready; }));
  auto& superior = pilot.find<Superior>("Superior");
  superior.begins = true;
  EXPECT_TRUE(serve_until({&robot_, &pilot}, [&] { return superior.x == 16; })) << pilot.log;
  robot_.find<TestCamera>("Camera").frozen = true;
  EXPECT_TRUE(serve_until({&robot_, &pilot}, [&] { return superior.failures == 1; })) << pilot.log;
}

// --- the check of a deployment -------------------------------------------------------------------

TEST(VisionCheck, AcceptsImagesOfItsSize) { EXPECT_EQ(mistakes_in(robot()), ""); }

TEST(VisionCheck, RefusesImagesOfAnotherSize) {
  EXPECT_THAT(mistakes_in(robot("{periodic: 5 ms}", "25")),
              HasSubstr("'Camera.Image' has 2304 elements, but 'Vision.Image' expects 2400"));
}

TEST(VisionCheck, WantsCyclesToSeeThatNoImageComes) {
  EXPECT_THAT(mistakes_in(robot("{triggered: true}")),
              HasSubstr("only cycles of its own show that no image comes"));
}

}  // namespace
}  // namespace armature::rover
