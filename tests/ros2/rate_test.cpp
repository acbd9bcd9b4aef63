// SPDX-License-Identifier: Apache-2.0
// 2000 samples at 1 kHz in real time, in both directions: none is lost; how late they are is
// printed.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "armature/deploy/deployment.hpp"
#include "fast_peer.hpp"
#include "models.hpp"

namespace armature::ros2 {
namespace {

constexpr int kDomain = 64;
constexpr int kSamples = 2000;

deploy::Deployment deployment() {
  deploy::DeploymentOptions options;
  options.library_folders = {LIBRARIES};
  options.models = [](component::Registry& registry) {
    registry.add<Ticker>("Ticker", "counts");
    registry.add<Listener>("Listener", "listens");
  };
  return deploy::load_deployment(TESTS "/rate.yaml", options);
}

double wall_clock_s() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

void print(const char* direction, std::vector<double> late_s, std::size_t lost) {
  std::sort(late_s.begin(), late_s.end());
  const auto share = [&](double part) {
    return 1e3 * late_s[static_cast<std::size_t>(part * static_cast<double>(late_s.size() - 1))];
  };
  std::cout << direction << ": " << late_s.size() << " samples at 1 kHz, " << lost << " lost; "
            << share(0.5) << " ms late (median), " << share(0.99) << " ms (99 %), "
            << late_s.back() * 1e3 << " ms at most\n";
}

/// Notes what comes in the thread of Fast DDS.
class Times final : public fast::DataReaderListener {
 public:
  void on_data_available(fast::DataReader* reader) override {
    sensor_msgs::msg::dds_::JointState_ message;
    while (take(*reader, message)) {
      const double sent =
          message.header().stamp().sec() + 1e-9 * message.header().stamp().nanosec();
      numbers.push_back(message.position().at(0));
      late_s.push_back(wall_clock_s() - sent);
      count.store(static_cast<int>(numbers.size()));
    }
  }
  std::vector<double> numbers;
  std::vector<double> late_s;
  std::atomic<int> count{0};
};

TEST(Rate, TwoThousandSamplesAtOneKilohertzInEachDirectionAndNoneIsLost) {
  auto deployed = deployment();
  ASSERT_TRUE(deployed.ok()) << deployed.diagnostics.to_text();
  exec::Application application(std::move(deployed.blueprint), deployed.options);
  ASSERT_TRUE(application.start().ok());
  FastPeer peer(kDomain);

  // From our ports to Fast DDS.
  auto* const reader =
      peer.read_from<sensor_msgs::msg::dds_::JointState_PubSubType>("rt/joint_states");
  Times times;
  reader->set_listener(&times);
  auto* const writer =
      peer.write_to<std_msgs::msg::dds_::Float64MultiArray_PubSubType>("rt/numbers");
  ASSERT_TRUE(wait_until([&] { return is_matched(*reader) && is_matched(*writer); }));
  std::this_thread::sleep_for(
      std::chrono::milliseconds(300));  // our writer may know of the reader a moment later
  ASSERT_TRUE(application.set_property("Ticker", "count", types::Value::of<double>(kSamples)));
  EXPECT_TRUE(wait_until([&] { return times.count.load() >= kSamples; }));
  reader->set_listener(nullptr);
  ASSERT_FALSE(times.numbers.empty());
  std::size_t lost = static_cast<std::size_t>(kSamples) - times.numbers.size();
  for (std::size_t i = 0; i < times.numbers.size(); ++i) {
    ASSERT_EQ(times.numbers[i], static_cast<double>(i + 1))
        << "a sample is missing, or out of order";
  }
  EXPECT_EQ(lost, 0u);
  print("ports to Fast DDS", times.late_s, lost);

  // From Fast DDS to our ports.
  std_msgs::msg::dds_::Float64MultiArray_ message;
  auto next = std::chrono::steady_clock::now();
  for (int i = 1; i <= kSamples; ++i) {
    message.data({static_cast<double>(i), wall_clock_s()});
    ASSERT_TRUE(writer->write(&message));
    next += std::chrono::milliseconds(1);
    std::this_thread::sleep_until(next);
  }
  const auto value = [&](const char* item) {
    return *static_cast<const int*>(application.value_of("Listener", item).value().data());
  };
  EXPECT_TRUE(wait_until([&] { return value("Came") >= kSamples; }));
  EXPECT_EQ(value("Came"), kSamples);
  EXPECT_EQ(value("Gaps"), 0);
  const auto latencies = application.call("Listener", "latencies", {});
  ASSERT_TRUE(latencies) << latencies.error();
  print("Fast DDS to ports", *static_cast<const std::vector<double>*>(latencies.value()->data()),
        static_cast<std::size_t>(kSamples - value("Came")));
  EXPECT_TRUE(application.stop().ok());
}

}  // namespace
}  // namespace armature::ros2
