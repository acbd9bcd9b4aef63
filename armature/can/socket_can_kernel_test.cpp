// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include <unistd.h>

#include "armature/can/internal/conformance.hpp"
#include "armature/can/internal/kernel_rig.hpp"
#include "armature/platform/sockets/can_socket.hpp"

// Interfaces vcan0, can0 and can1 as scripts/test-socketcan has them.

namespace armature::can::internal {
namespace {

class VirtualInterfaceRig final : public SocketRig {
 public:
  VirtualInterfaceRig() : SocketRig("vcan0", "vcan0") {}
};

/// Two controllers SJA1000 as qemu emulates them: every frame is acknowledged at once, at any bit
/// rate and with nobody there, and no error ever happens. Of a remote frame that asks for data the
/// emulation keeps as many bytes in its memory, out of step from then on.
class EmulatedControllerRig final : public SocketRig {
 public:
  EmulatedControllerRig() : SocketRig("can0", "can1") {}
  bool receives_remote_frames_for_data() const override { return false; }
};

template <typename Rig>
BusImplementation implementation(const char* name) {
  return {name, [] { return std::make_unique<Rig>(); }};
}

INSTANTIATE_TEST_SUITE_P(Kernel, BusConformance,
                         testing::Values(implementation<VirtualInterfaceRig>("vcan"),
                                         implementation<EmulatedControllerRig>("sja1000")),
                         [](const auto& test) { return test.param.name; });

void open(Bus& bus, const BusOptions& options = {}) {
  base::Diagnostics diagnostics;
  EXPECT_TRUE(bus.open(options, diagnostics)) << diagnostics.to_text();
}

std::string error_of_opening(const std::string& interface, const BusOptions& options = {}) {
  SocketCan bus(interface);
  base::Diagnostics diagnostics;
  EXPECT_FALSE(bus.open(options, diagnostics));
  EXPECT_EQ(diagnostics.error_count(), 1u);
  EXPECT_EQ(bus.state(), BusState::kClosed);
  return diagnostics.to_text();
}

/// Two emulated controllers on one bus.
class SocketCanOnControllers : public testing::Test {
 protected:
  bool arrives(Bus& bus) {
    return comes_true([&] { return bus.receive(arrival_) == ReceiveStatus::kReceived; });
  }

  Arrival arrival_;
  SocketCan first_{"can0"};
  SocketCan second_{"can1"};
};

TEST_F(SocketCanOnControllers, AnInterfaceThatGoesDownAndUpIsFollowed) {
  std::atomic<int> news = 0;
  BusOptions options;
  options.on_news = [&news] { ++news; };
  open(first_, options);
  open(second_);
  shell("ip link set can0 down");
  EXPECT_TRUE(comes_true([&news] { return news >= 1; }));
  EXPECT_EQ(first_.receive(arrival_), ReceiveStatus::kDown);
  EXPECT_EQ(first_.receive(arrival_), ReceiveStatus::kDown) << "and stays so";
  EXPECT_EQ(first_.state(), BusState::kDown);
  EXPECT_EQ(first_.send(data_frame(1, {})), SendStatus::kDown);
  shell("ip link set can0 up");
  EXPECT_EQ(first_.receive(arrival_), ReceiveStatus::kNothing);
  EXPECT_EQ(first_.state(), BusState::kActive);
  EXPECT_EQ(first_.send(data_frame(2, {})), SendStatus::kSent);
  ASSERT_TRUE(arrives(second_));
  EXPECT_EQ(arrival_.frame, data_frame(2, {})) << "what was refused does not come later";
}

TEST_F(SocketCanOnControllers, SendingFindsAnInterfaceUpAgain) {
  open(first_);
  shell("ip link set can0 down");
  EXPECT_EQ(first_.send(data_frame(1, {})), SendStatus::kDown);
  EXPECT_EQ(first_.state(), BusState::kDown);
  shell("ip link set can0 up");
  EXPECT_EQ(first_.send(data_frame(1, {})), SendStatus::kSent);
  EXPECT_EQ(first_.state(), BusState::kActive);
}

TEST_F(SocketCanOnControllers, AnOwnFrameComesBackWhenItWasOnTheBus) {
  BusOptions options;
  options.own_frames = true;
  open(first_, options);
  const base::Time before = platform::monotonic_now();
  ASSERT_EQ(first_.send(data_frame(1, {7})), SendStatus::kSent);
  ASSERT_TRUE(arrives(first_));
  EXPECT_TRUE(arrival_.own);
  EXPECT_EQ(arrival_.frame, data_frame(1, {7}));
  EXPECT_GE(arrival_.time, before);
  EXPECT_LE(arrival_.time, platform::monotonic_now());
}

TEST_F(SocketCanOnControllers, TimesAreOnTheMonotonicClockWhateverTheWallClockDoes) {
  open(first_);
  open(second_);
  base::Time last = platform::monotonic_now();
  for (const char* const step : {"-3", "+3", "+3000000", "-3000000"}) {
    ASSERT_EQ(first_.send(data_frame(1, {})), SendStatus::kSent);
    ASSERT_EQ(first_.send(data_frame(2, {})), SendStatus::kSent);
    ASSERT_TRUE(arrives(second_));
    EXPECT_GE(arrival_.time, last) << step;
    last = arrival_.time;
    shell("date -s @$(($(date +%s) " + std::string(step) + ")) >/dev/null");
    ASSERT_TRUE(arrives(second_));
    EXPECT_GE(arrival_.time, last) << step;
    last = arrival_.time;
    EXPECT_LE(last, platform::monotonic_now());
  }
}

/// A virtual interface: what one socket sends, all others get, if not at once.
class SocketCanOnVirtualInterface : public testing::Test {
 protected:
  SocketCanOnVirtualInterface() {
    BusOptions all;
    all.error_frames = true;
    all.receive_capacity = 1000;
    open(listener_, all);
    open(sender_);
  }
  /// An error frame as a driver would make it.
  void send_error(std::uint32_t classes) {
    platform::CanSocketFrame frame;
    frame.id = platform::CanSocketFrame::kError | classes;
    frame.size = 8;
    EXPECT_EQ(driver_->send(frame), platform::CanSocket::Sent::kYes);
  }
  void send(std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
      ASSERT_TRUE(
          comes_true([this] { return sender_.send(data_frame(1, {})) == SendStatus::kSent; }));
    }
  }
  /// Returns when one who listens has got that many frames in all; then all others have.
  void settle(std::uint64_t count) {
    EXPECT_TRUE(comes_true([&] {
      Arrival arrival;
      while (listener_.receive(arrival) == ReceiveStatus::kReceived) continue;
      return listener_.counters().received == count;
    }));
  }

  base::Diagnostics diagnostics_;
  std::unique_ptr<platform::CanSocket> driver_ =
      platform::CanSocket::open({.interface = "vcan0"}, diagnostics_);
  SocketCan listener_{"vcan0"};
  SocketCan sender_{"vcan0"};
  SocketCan bus_{"vcan0"};
  Arrival arrival_;
};

TEST_F(SocketCanOnVirtualInterface, AfterABusOffTheSystemsRestartIsNoticed) {
  open(bus_);
  send_error(error_class::kBusOff);
  settle(1);
  EXPECT_EQ(bus_.receive(arrival_), ReceiveStatus::kNothing) << "error frames were not asked for";
  EXPECT_EQ(bus_.state(), BusState::kBusOff);
  EXPECT_EQ(bus_.send(data_frame(1, {})), SendStatus::kBusOff);
  EXPECT_EQ(bus_.restart(), RestartStatus::kNotHere);
  send_error(error_class::kRestarted);
  settle(2);
  EXPECT_EQ(bus_.receive(arrival_), ReceiveStatus::kNothing);
  EXPECT_EQ(bus_.state(), BusState::kActive);
  EXPECT_EQ(bus_.send(data_frame(1, {})), SendStatus::kSent);
  EXPECT_EQ(bus_.counters().bus_offs, 1u);
  EXPECT_EQ(bus_.counters().error_frames, 2u);
}

TEST_F(SocketCanOnVirtualInterface, ErrorFramesPassEveryFilterButOnlyIfAskedFor) {
  BusOptions options;
  options.filters = {{0x100, 0x7ff, false}};
  options.error_frames = true;
  open(bus_, options);
  send_error(error_class::kProtocol);
  settle(1);
  ASSERT_EQ(bus_.receive(arrival_), ReceiveStatus::kReceived);
  EXPECT_EQ(arrival_.frame.kind, FrameKind::kError);
  EXPECT_EQ(arrival_.frame.id, error_class::kProtocol);
}

TEST_F(SocketCanOnVirtualInterface, WhatDoesNotFitIsCountedWithTheNextFrame) {
  constexpr std::uint64_t kMany = 500;
  BusOptions options;
  options.receive_capacity = 8;
  open(bus_, options);
  send(kMany);
  settle(kMany);
  while (bus_.receive(arrival_) == ReceiveStatus::kReceived) continue;
  const std::uint64_t had_room = bus_.counters().received;
  EXPECT_GE(had_room, options.receive_capacity);
  EXPECT_LT(had_room, kMany);
  send(1);
  settle(kMany + 1);
  ASSERT_EQ(bus_.receive(arrival_), ReceiveStatus::kReceived);
  EXPECT_EQ(bus_.counters().received, had_room + 1);
  EXPECT_EQ(bus_.counters().lost, kMany - had_room);
}

TEST_F(SocketCanOnVirtualInterface, WhatWaitsWhenItIsClosedIsCountedAsLost) {
  open(bus_);
  send(3);
  settle(3);
  bus_.close();
  EXPECT_EQ(bus_.counters().received, 0u);
  EXPECT_EQ(bus_.counters().lost, 3u);
}

TEST(SocketCanMistakes, AnInterfaceThatIsNotThere) {
  EXPECT_THAT(error_of_opening("can7"),
              testing::AllOf(HasSubstr("CAN interface 'can7': this interface does not exist"),
                             HasSubstr("list them with 'ip link'")));
}

TEST(SocketCanMistakes, AnInterfaceOfAnotherKind) {
  EXPECT_THAT(error_of_opening("lo"),
              testing::AllOf(HasSubstr("CAN interface 'lo': "), HasSubstr("type can or vcan")));
}

TEST(SocketCanMistakes, AnInterfaceThatIsDown) {
  shell("ip link set can1 down");
  EXPECT_THAT(error_of_opening("can1"),
              testing::AllOf(HasSubstr("CAN interface 'can1': "), HasSubstr("is down"),
                             HasSubstr("'ip link set can1 up'")));
  shell("ip link set can1 up");
}

TEST(SocketCanMistakes, MoreFiltersThanTheKernelTakes) {
  BusOptions options;
  options.filters.resize(513);
  EXPECT_THAT(error_of_opening("vcan0", options), HasSubstr("at most 512"));
}

/// For the whole process, as long as a test runs.
class OrdinaryUser : public testing::Test {
 protected:
  OrdinaryUser() { EXPECT_EQ(::seteuid(kNobody), 0); }
  ~OrdinaryUser() override { EXPECT_EQ(::seteuid(0), 0); }

 private:
  static constexpr uid_t kNobody = 65534;
};

TEST_F(OrdinaryUser, MaySendAndReceive) {
  SocketCan first("can0");
  SocketCan second("can1");
  open(first);
  open(second);
  ASSERT_EQ(first.send(data_frame(1, {2})), SendStatus::kSent);
  Arrival arrival;
  ASSERT_TRUE(comes_true([&] { return second.receive(arrival) == ReceiveStatus::kReceived; }));
  EXPECT_EQ(arrival.frame, data_frame(1, {2}));
}

TEST_F(OrdinaryUser, IsToldWhatTheWatcherDidNotGet) {
  platform::ThreadRequest urgent;
  urgent.scheduler = platform::Scheduler::kFifo;
  urgent.priority = 80;
  SocketCan bus("can0", urgent);
  BusOptions options;
  options.on_news = [] {};
  base::Diagnostics diagnostics;
  EXPECT_TRUE(bus.open(options, diagnostics)) << "it works all the same";
  EXPECT_THAT(diagnostics.to_text(),
              testing::AllOf(HasSubstr("warning: bus 'can0': "), HasSubstr("SCHED_FIFO")));
}

}  // namespace
}  // namespace armature::can::internal
