// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <linux/tty.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "armature/can/internal/conformance.hpp"
#include "armature/can/internal/kernel_rig.hpp"

// Emulated controllers make no errors. A serial adapter tells the kernel of its errors in text, so
// a test that plays the adapter has the kernel go through error states and bus-off.

namespace armature::can::internal {
namespace {

/// A CAN interface of the kernel at one end of a pseudo-terminal, its adapter at the other.
class SerialInterface {
 public:
  SerialInterface() : adapter_(::posix_openpt(O_RDWR | O_NOCTTY)) {
    ::grantpt(adapter_);
    ::unlockpt(adapter_);
    line_ = ::open(::ptsname(adapter_), O_RDWR | O_NOCTTY);
    set_discipline(N_SLCAN);
    char name[64]{};
    EXPECT_GE(::ioctl(line_, kNameOfInterface, name), 0);
    name_ = name;
  }
  SerialInterface(const SerialInterface&) = delete;
  SerialInterface& operator=(const SerialInterface&) = delete;
  ~SerialInterface() {
    unplug();
    ::close(line_);
    ::close(adapter_);
  }
  /// The interface is gone.
  void unplug() { set_discipline(N_TTY); }
  const std::string& name() const { return name_; }
  int adapter() const { return adapter_; }

  /// What the adapter tells the kernel.
  void tell(const std::string& line) const {
    const std::string text = line + "\r";
    EXPECT_EQ(::write(adapter_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }

 private:
  static constexpr unsigned long kNameOfInterface = 0x8910;  // SIOCGIFNAME

  void set_discipline(int discipline) { EXPECT_EQ(::ioctl(line_, TIOCSETD, &discipline), 0); }

  int adapter_;
  int line_ = -1;
  std::string name_;
};

/// Two adapters on one bus: what the kernel sends to one comes in at the other.
class SerialBus {
 public:
  SerialBus() : firmware_([this] { run(); }) {
    set_links({" type can bitrate 1000000", " txqueuelen 64 up"});
  }
  ~SerialBus() {
    // Else the kernel waits a second for each adapter to take its leave.
    for (Adapter& each : adapters_) each.busy = false;
    set_links({" down"});
    done_ = true;
    firmware_.join();
  }

  const std::string& name(int which) const { return adapters_[which].interface.name(); }
  void tell(int which, const std::string& line) { adapters_[which].interface.tell(line); }
  /// The adapter does not listen to the kernel for a while, as if the bus were busy.
  void set_busy(int which, bool busy) { adapters_[which].busy = busy; }
  void unplug(int which) {
    adapters_[which].interface.unplug();
    adapters_[which].plugged = false;
  }
  void go_bus_off(int which) {
    adapters_[which].on_bus = false;
    tell(which, "sb000256");
  }
  void restart(int which) {
    set_busy(which, false);
    shell("ip link set " + name(which) + " down");
    shell("ip link set " + name(which) + " up");
  }

 private:
  struct Adapter {
    SerialInterface interface;
    std::string heard;
    std::atomic<bool> on_bus{false};
    std::atomic<bool> busy{false};
    bool plugged = true;
  };

  /// In one call of `ip`, which takes its time in emulation.
  void set_links(std::initializer_list<const char*> settings) {
    std::string commands;
    for (const Adapter& each : adapters_) {
      if (!each.plugged) continue;
      for (const char* const setting : settings) {
        commands += "link set " + each.interface.name() + setting + "\n";
      }
    }
    shell("echo '" + commands + "' | ip -batch -");
  }

  void run() {
    constexpr int kPatienceMs = 1;
    while (!done_) {
      pollfd lines[2];
      for (int i = 0; i < 2; ++i) {
        lines[i] = {adapters_[i].busy ? -1 : adapters_[i].interface.adapter(), POLLIN, 0};
      }
      ::poll(lines, 2, kPatienceMs);
      for (int i = 0; i < 2; ++i) {
        const bool spoken_to = (lines[i].revents & POLLIN) != 0 && !adapters_[i].busy;
        if (spoken_to) listen(adapters_[i], adapters_[1 - i]);
      }
    }
  }

  static void listen(Adapter& adapter, Adapter& other) {
    char text[256];
    const ssize_t size = ::read(adapter.interface.adapter(), text, sizeof text);
    for (ssize_t i = 0; i < size; ++i) {
      if (text[i] != '\r') {
        adapter.heard += text[i];
      } else {
        obey(adapter, std::exchange(adapter.heard, {}), other);
      }
    }
  }

  static void obey(Adapter& adapter, const std::string& line, Adapter& other) {
    if (line == "O") adapter.on_bus = true;
    if (line == "C") adapter.on_bus = false;
    const bool is_frame = line.find_first_of("tTrR") == 0;
    if (is_frame && adapter.on_bus && other.on_bus) other.interface.tell(line);
  }

  Adapter adapters_[2];
  std::atomic<bool> done_{false};
  std::thread firmware_;
};

class SerialRig final : private SerialBus, public SocketRig {
 public:
  SerialRig() : SocketRig(name(0), name(1)) {}
  bool force_bus_off() override {
    go_bus_off(0);
    return true;
  }
  void restart() override {
    EXPECT_EQ(first().restart(), RestartStatus::kNotHere);
    SerialBus::restart(0);
  }
};

INSTANTIATE_TEST_SUITE_P(SocketCan, BusConformance,
                         testing::Values(BusImplementation{
                             "serial", [] { return std::make_unique<SerialRig>(); }}),
                         [](const auto& test) { return test.param.name; });

class SocketCanErrors : public testing::Test {
 protected:
  SocketCanErrors() {
    BusOptions options;
    options.error_frames = true;
    options.send_capacity = kCapacity;
    open(first_, options);
    open(second_);
  }
  static void open(Bus& bus, const BusOptions& options = {}) {
    base::Diagnostics diagnostics;
    EXPECT_TRUE(bus.open(options, diagnostics)) << diagnostics.to_text();
  }
  std::vector<Frame> received(Bus& bus) {
    std::vector<Frame> all;
    Arrival arrival;
    while (bus.receive(arrival) == ReceiveStatus::kReceived) all.push_back(arrival.frame);
    return all;
  }
  /// Waits for one error frame at the first station.
  Frame error_frame() {
    Arrival arrival;
    EXPECT_TRUE(comes_true([&] { return first_.receive(arrival) == ReceiveStatus::kReceived; }));
    EXPECT_EQ(arrival.frame.kind, FrameKind::kError);
    return arrival.frame;
  }
  bool state_becomes(BusState state) {
    return comes_true([&] {
      received(first_);
      return first_.state() == state;
    });
  }

  static constexpr std::size_t kCapacity = 16;
  SerialBus bus_;
  SocketCan first_{bus_.name(0)};
  SocketCan second_{bus_.name(1)};
};

TEST_F(SocketCanErrors, TheStateFollowsWhatTheControllerTells) {
  bus_.tell(0, "sp000130");
  EXPECT_EQ(error_frame().data[1], controller_problem::kSendPassive);
  EXPECT_EQ(first_.state(), BusState::kPassive);
  EXPECT_EQ(first_.send(data_frame(1, {})), SendStatus::kSent) << "a passive station may send";
  bus_.tell(0, "sw000120");
  error_frame();
  EXPECT_EQ(first_.state(), BusState::kActive) << "a warning is below passive";
  bus_.tell(0, "sp130000");
  EXPECT_EQ(error_frame().data[1], controller_problem::kReceivePassive);
  EXPECT_EQ(first_.state(), BusState::kPassive);
  bus_.tell(0, "sa000000");
  EXPECT_EQ(error_frame().data[1], controller_problem::kActiveAgain);
  EXPECT_EQ(first_.state(), BusState::kActive);
  EXPECT_EQ(first_.counters().error_frames, 4u);
  EXPECT_EQ(second_.counters().error_frames, 0u);
}

TEST_F(SocketCanErrors, WhatGoesWrongOnTheBusIsCountedByItsKind) {
  bus_.tell(0, "e3abc");  // no acknowledgement, bit 0, checksum
  const Frame error = error_frame();
  EXPECT_EQ(error.id,
            error_class::kProtocol | error_class::kBusError | error_class::kNoAcknowledgement);
  EXPECT_EQ(first_.counters().lost, 0u);
  bus_.tell(0, "e3oaa");  // the controller had no room for a frame
  EXPECT_NE(error_frame().id & error_class::kController, 0u);
  EXPECT_EQ(first_.counters().lost, 1u);
  EXPECT_EQ(first_.counters().error_frames, 2u);
  EXPECT_EQ(first_.state(), BusState::kActive);
}

TEST_F(SocketCanErrors, AFullQueueRefusesAndEverythingTakenIsSentInOrder) {
  bus_.set_busy(0, true);
  std::uint32_t taken = 0;
  while (taken < 64 && first_.send(data_frame(taken, {})) == SendStatus::kSent) ++taken;
  EXPECT_GE(taken, kCapacity);
  EXPECT_LE(taken, 2 * kCapacity) << "a frame too many is a command too late";
  EXPECT_EQ(first_.send(data_frame(taken, {})), SendStatus::kQueueFull);
  EXPECT_EQ(first_.counters().refused, 2u);
  bus_.set_busy(0, false);
  std::vector<Frame> all;
  EXPECT_TRUE(comes_true([&] {
    for (const Frame& frame : received(second_)) all.push_back(frame);
    return all.size() == taken;
  }));
  for (std::uint32_t i = 0; i < taken; ++i) EXPECT_EQ(all[i].id, i);
  EXPECT_EQ(first_.send(data_frame(1, {})), SendStatus::kSent);
}

TEST_F(SocketCanErrors, WhatWaitsWhenTheBusGoesOffNeverComesOut) {
  bus_.set_busy(0, true);
  for (std::uint32_t i = 0; i < kCapacity; ++i) {
    ASSERT_EQ(first_.send(data_frame(i, {})), SendStatus::kSent);
  }
  bus_.go_bus_off(0);
  EXPECT_TRUE(state_becomes(BusState::kBusOff));
  bus_.restart(0);
  EXPECT_TRUE(state_becomes(BusState::kActive));
  ASSERT_EQ(first_.send(data_frame(0x7ff, {})), SendStatus::kSent);
  std::vector<Frame> all;
  EXPECT_TRUE(comes_true([&] { return !(all = received(second_)).empty(); }));
  EXPECT_EQ(all[0].id, 0x7ffu);
  EXPECT_EQ(first_.counters().bus_offs, 1u);
}

TEST_F(SocketCanErrors, TheInterfacesOwnQueueMayBeShorter) {
  constexpr std::uint32_t kShort = 4;
  shell("ip link set " + bus_.name(0) + " txqueuelen 4");
  bus_.set_busy(0, true);
  std::uint32_t taken = 0;
  while (taken < kCapacity && first_.send(data_frame(taken, {})) == SendStatus::kSent) ++taken;
  EXPECT_GE(taken, kShort);
  EXPECT_LE(taken, kShort + 3) << "some are on their way already";
  EXPECT_EQ(first_.send(data_frame(taken, {})), SendStatus::kQueueFull);
}

TEST_F(SocketCanErrors, ABusOffIsKnownWhenItReceives) {
  SocketCan other(bus_.name(0));
  open(other);
  bus_.go_bus_off(0);
  EXPECT_TRUE(comes_true([&] {
    received(other);
    return other.state() == BusState::kBusOff;
  }));
  EXPECT_EQ(first_.send(data_frame(1, {})), SendStatus::kSent) << "for all it knows";
  received(first_);
  EXPECT_EQ(first_.send(data_frame(1, {})), SendStatus::kBusOff);
}

// Not what a bus should do, but nobody can take it back from the kernel.
TEST_F(SocketCanErrors, WhatWaitsWhenItIsClosedStillGoesOut) {
  bus_.set_busy(0, true);
  for (std::uint32_t i = 0; i < 3; ++i)
    ASSERT_EQ(first_.send(data_frame(i, {})), SendStatus::kSent);
  first_.close();
  bus_.set_busy(0, false);
  std::size_t arrived = 0;
  EXPECT_TRUE(comes_true([&] { return (arrived += received(second_).size()) == 3; }));
  EXPECT_EQ(first_.counters().discarded, 0u);
}

TEST_F(SocketCanErrors, TheStateIsKnownWhenItIsOpened) {
  bus_.tell(0, "sp000130");
  EXPECT_TRUE(state_becomes(BusState::kPassive));
  SocketCan late(bus_.name(0));
  open(late);
  EXPECT_EQ(late.state(), BusState::kPassive);
  late.close();
  bus_.go_bus_off(0);
  EXPECT_TRUE(state_becomes(BusState::kBusOff));
  open(late);
  EXPECT_EQ(late.state(), BusState::kBusOff);
  EXPECT_EQ(late.send(data_frame(1, {})), SendStatus::kBusOff);
  EXPECT_EQ(late.counters().bus_offs, 0u) << "it was not there";
}

TEST_F(SocketCanErrors, AnAdapterThatIsUnpluggedIsDownForGood) {
  bus_.unplug(0);
  EXPECT_TRUE(state_becomes(BusState::kDown));
  Arrival arrival;
  EXPECT_EQ(first_.receive(arrival), ReceiveStatus::kDown);
  EXPECT_EQ(first_.send(data_frame(1, {})), SendStatus::kDown);
  first_.close();
  base::Diagnostics diagnostics;
  EXPECT_FALSE(first_.open({}, diagnostics));
  EXPECT_THAT(diagnostics.to_text(), HasSubstr("this interface does not exist"));
}

}  // namespace
}  // namespace armature::can::internal
