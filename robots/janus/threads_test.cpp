// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "armature/rt/wakeup.hpp"
#include "robots/janus/aic/aic_driver.hpp"
#include "robots/janus/simulation.hpp"

namespace armature::janus {
namespace {

using namespace std::chrono_literals;

TEST(Threads, AHostInAnotherThreadThanTheRobotGetsAllItsAnswers) {
  std::atomic<base::Time> clock{base::Time{}};
  auto simulation = Simulation::make({.head = {.urdf_file = ROBOT_FOLDER "/janus.urdf"},
                                      .clock = [&clock] { return clock.load(); }})
                        .value();
  can::VirtualStation& host = simulation->bus().add_station("host");
  rt::Wakeup news;
  can::BusOptions options;
  options.on_news = [&news] { news.notify(); };
  base::Diagnostics diagnostics;
  ASSERT_TRUE(host.open(options, diagnostics));
  // The robot's time has nothing to do with that of the host's thread, so nobody is impatient.
  auto driver = AicDriver::make(host, {.cards = {1, 2}, .answer_timeout = 24h}).value();
  driver.start(clock.load());

  std::atomic<bool> done{false};
  std::thread robot([&] {
    while (!done) {
      clock = clock.load() + 50us;
      simulation->advance_to(clock.load());
      std::this_thread::yield();
    }
  });
  for (int i = 0; i < 200; ++i) {
    driver.begin_reading(clock.load());
    while (driver.poll(clock.load()) == AicReading::kWaiting) news.wait();
    driver.set_motor(0, 0.1);
    driver.send_motors();
  }
  done = true;
  robot.join();
  EXPECT_EQ(driver.card(0).counters.lost_answers, 0u);
  EXPECT_TRUE(driver.card(0).counts_exact);
  EXPECT_TRUE(driver.card(1).counts_exact);
}

}  // namespace
}  // namespace armature::janus
