// SPDX-License-Identifier: Apache-2.0
// Seven drives by CiA 402 on a bus of 1 Mbit/s, which follow positions 500 times a second: what a
// cycle takes on the bus beside its frames' own time, and what its host computes.
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include "armature/can/link.hpp"
#include "benchmarks/suite.hpp"
#include "drives/cia402/drive_group.hpp"
#include "drives/cia402/emulated_bus.hpp"
#include "drives/cia402/prepare_drive.hpp"

namespace armature::benchmarks {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kDrives = 7;
constexpr base::Duration kPeriod = 2ms;
constexpr double kMostOfTheFrames = 1.05;
constexpr double kMostComputing = 20'000.0;  // [ns], a hundredth of the period

/// Emulated drives and their host in simulated time.
class SevenDrives final : public can::Link {
 public:
  SevenDrives() {
    cia402::EmulatedBus::Config config;
    config.drives = kDrives;
    config.clock = [this] { return now_; };
    drives_ = cia402::EmulatedBus::make(config).value();
    host_ = &drives_->bus().add_station("host");
    base::Diagnostics diagnostics;
    if (!open({.receive_capacity = 1024}, diagnostics)) throw std::runtime_error("no bus");
    advance(1ms);
    group_.emplace(cia402::DriveGroup::make(prepare()).value());
    bus().send(canopen::nmt_frame(canopen::NmtCommand::kStart, canopen::kEveryNode));
    advance(1ms);
    cycle(2);
    for (std::size_t i = 0; i < kDrives; ++i) group_->set_goal(i, cia402::PowerGoal::kEnabled);
    cycle(10);
  }

  can::Bus& bus() override { return *host_; }
  bool open(can::BusOptions options, base::Diagnostics& diagnostics) override {
    return host_->open(options, diagnostics);
  }
  void begin_cycle(base::Time /*time*/) override {}
  base::Time now() override { return now_; }
  void wait_for_news(base::Time deadline) override {
    const std::uint64_t seen = host_->counters().received;
    while (now_ < deadline && host_->counters().received == seen) advance(50us);
  }

  cia402::DriveGroup& group() { return *group_; }
  can::VirtualBus& wire() { return drives_->bus(); }
  void cycle(int count) {
    for (int i = 0; i < count; ++i) {
      for (const can::Arrival& arrival : answers()) group_->take(arrival);
      for (std::size_t drive = 0; drive < kDrives; ++drive) group_->set_target(drive, 0.0);
      group_->step(bus(), now_);
      advance(kPeriod);
    }
  }
  std::vector<can::Arrival> answers() {
    std::vector<can::Arrival> all;
    can::Arrival arrival;
    while (bus().receive(arrival) == can::ReceiveStatus::kReceived) all.push_back(arrival);
    return all;
  }

 private:
  std::vector<cia402::DriveConfig> prepare() {
    std::vector<cia402::DriveConfig> configs;
    base::Diagnostics diagnostics;
    for (canopen::NodeId node = 1; node <= kDrives; ++node) {
      canopen::SdoChannel channel(*this, node);
      const auto config = cia402::prepare_drive(channel, {.node = node, .name = "J"}, diagnostics);
      if (!config) throw std::runtime_error(diagnostics.to_text());
      configs.push_back(*config);
    }
    return configs;
  }
  void advance(base::Duration by) {
    const base::Time until = now_ + by;
    while (now_ < until) {
      now_ += 50us;
      drives_->advance_to(now_);
    }
  }

  base::Time now_{};
  std::unique_ptr<cia402::EmulatedBus> drives_;
  can::VirtualStation* host_ = nullptr;
  std::optional<cia402::DriveGroup> group_;
};

/// From the first target until the last answer, and all frames' own time; of the wire alone, so it
/// is the same on each machine.
void measure_bus(benchmark::State& state) {
  SevenDrives drives;
  base::Duration frames{};
  base::Time last{};
  drives.wire().set_tap([&](const can::WireEvent& event) {
    frames += event.end - event.begin;
    last = event.end;
  });
  base::Duration cycles{};
  int count = 0;
  for ([[maybe_unused]] auto _ : state) {
    const base::Time begin = drives.now();
    drives.cycle(1);
    cycles += last - begin;
    ++count;
  }
  Result result;
  result.value = std::chrono::duration<double, std::micro>(cycles).count() / count;
  result.unit = "us";
  result.reference = std::chrono::duration<double, std::micro>(frames).count() / count;
  result.bound = ratio_at_most(kMostOfTheFrames);
  publish(state, result);
}

/// Takes what is sent, and nothing comes.
class TakingBus final : public can::Bus {
 public:
  TakingBus() : Bus("taking") {}
  bool open(const can::BusOptions&, base::Diagnostics&) override { return true; }
  void close() override {}
  can::SendStatus send(const can::Frame& frame) override {
    benchmark::DoNotOptimize(frame);
    return can::SendStatus::kSent;
  }
  can::ReceiveStatus receive(can::Arrival&) override { return can::ReceiveStatus::kNothing; }
  can::BusState state() const override { return can::BusState::kActive; }
  can::RestartStatus restart() override { return can::RestartStatus::kNotNeeded; }
  can::BusCounters counters() const override { return {}; }
};

/// Answers of a cycle are used, and targets and SYNC made, without what the bus takes for it.
void measure_computing(benchmark::State& state) {
  constexpr int kCycles = 100;
  SevenDrives drives;
  const std::vector<can::Arrival> answers = drives.answers();
  TakingBus bus;
  std::vector<double> each;
  for ([[maybe_unused]] auto _ : state) {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < kCycles; ++i) {
      for (const can::Arrival& arrival : answers) drives.group().take(arrival);
      for (std::size_t drive = 0; drive < kDrives; ++drive) drives.group().set_target(drive, 1e-3);
      drives.group().step(bus, drives.now());
    }
    const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - begin;
    each.push_back(spent.count() / kCycles);
  }
  Result result;
  result.value = median(each);
  result.unit = "ns";
  result.bound = value_at_most(kMostComputing);
  publish(state, result);
}

}  // namespace

void add_drives(const Suite& suite) {
  suite.add("cia402/bus_of_wire", 500, measure_bus);
  suite.add("cia402/computing", 200, measure_computing);
}

}  // namespace armature::benchmarks
