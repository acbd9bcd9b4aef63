// SPDX-License-Identifier: Apache-2.0
// Numbers that a thread copies for whoever looks at them.
#include <memory>
#include <utility>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/component/face.hpp"
#include "armature/exec/engine.hpp"
#include "armature/exec/observing/log_history.hpp"
#include "armature/exec/thread_watch.hpp"
#include "tests/realtime/expect_realtime.hpp"

namespace armature::exec {
namespace {

using namespace std::chrono_literals;

class Source final : public component::Component {
 public:
  using Component::Component;
  component::Property<std::vector<double>> gains{this, "Gains", {1.0, 2.0}, ""};
  component::OutputPort<std::vector<double>> out{this, "Out", "", "", component::fixed_size(7)};
};

class WatchFunctions : public ::testing::Test {
 protected:
  WatchFunctions() {
    face(source_.out).prepare();
    const auto& port = source_.out;
    for (auto& place : types::NumberPlace::all_in(face(port).type(), face(port).current())) {
      numbers_.push_back({&source_, &face(port), nullptr, std::move(place)});
    }
    const auto& gains = source_.gains;
    for (auto& place : types::NumberPlace::all_in(gains.type(), gains.data())) {
      numbers_.push_back({&source_, nullptr, &gains, std::move(place)});
    }
  }

  Source source_{"Source"};
  std::vector<WatchedNumber> numbers_;
};

TEST_F(WatchFunctions, NumbersAreRead) {
  ASSERT_EQ(numbers_.size(), 9u);
  double sum = 0.0;
  expect_realtime("NumberPlace::read",
                  [&] { sum += numbers_.back().place.read(source_.gains.data()); });
  EXPECT_GE(sum, 2.0);
}

TEST_F(WatchFunctions, NumbersAreCopied) {
  ThreadWatch watch(numbers_, 0ms);
  base::Time now{};
  expect_realtime("ThreadWatch::due", [&] { watch.due(now += 1ms); });
  expect_realtime("ThreadWatch::copy", [&] { watch.copy(now += 1ms); });
  EXPECT_EQ(watch.newest().values.back(), 2.0);
}

TEST_F(WatchFunctions, EnginesTakeThemAndLetThemGo) {
  Engine engine("thread", Activity::triggered(), {&source_}, {});
  ThreadWatch first(numbers_, 0ms);
  ThreadWatch second(numbers_, 0ms);
  expect_realtime("Engine::attach", [&] {
    engine.attach(first);
    engine.attach(second);
    engine.detach(first);
    engine.detach(second);
  });
  expect_realtime("Engine::detach", [&] { engine.detach(first); });
}

TEST_F(WatchFunctions, TheLogIsKept) {
  LogHistory history;
  const rt::LogRecord record(rt::LogLevel::kInfo, base::Time(1ms), "Arm", "moves");
  expect_realtime("LogHistory::add", [&] {
    for (int i = 0; i < 10; ++i) history.add(record);
  });
  EXPECT_EQ(history.lines_after(0, 1000).size(), LogHistory::kCapacity);
}

TEST_F(WatchFunctions, EnginesTakeARecordForTheirNextCycle) {
  Engine engine("thread", Activity::triggered(), {&source_}, {});
  component::CycleRecord record(8);
  expect_realtime("Engine::record_next_cycle", [&] { engine.record_next_cycle(record); });
  EXPECT_FALSE(record.full());
}

}  // namespace
}  // namespace armature::exec
