// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "armature/base/time.hpp"
#include "armature/platform/clock.hpp"
#include "armature/ride/wire.hpp"

namespace armature::rover {

/// A message that passed.
struct Passed {
  ride::Header header;
  bool to_robot = false;
  ride::Number first = 0;   ///< the first number of its body: which operation or event it is
  ride::Number second = 0;  ///< the second one: of a request the call
};

/// Between a pilot and a robot on this machine: passes on what both say, and keeps what passed.
class Wiretap {
 public:
  /// @param port   of the robot
  /// @param delay  of all that passes, in each direction
  explicit Wiretap(std::uint16_t port, base::Duration delay = {})
      : robot_(port), delay_(delay), listener_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in here = local(0);
    static_cast<void>(::bind(listener_, reinterpret_cast<sockaddr*>(&here), sizeof here));
    static_cast<void>(::listen(listener_, 8));
    socklen_t size = sizeof here;
    static_cast<void>(::getsockname(listener_, reinterpret_cast<sockaddr*>(&here), &size));
    port_ = ntohs(here.sin_port);
    thread_ = std::thread([this] { run(); });
  }
  ~Wiretap() {
    done_ = true;
    thread_.join();
    for (const auto& line : lines_) close(*line);
    ::close(listener_);
  }
  Wiretap(const Wiretap&) = delete;
  Wiretap& operator=(const Wiretap&) = delete;

  std::string address() const { return "tcp://127.0.0.1:" + std::to_string(port_); }
  /// Sends a command with this number to a component of this identifier, which nobody may have.
  void send_command(std::uint32_t component, ride::Number operation) const {
    const int line = ::socket(AF_INET, SOCK_STREAM, 0);
    const sockaddr_in here = local(port_);
    std::array<std::byte, ride::Header::kSize + 4> message{};
    ride::Header header;
    header.type = ride::Type::kCommand;
    header.length = static_cast<std::uint16_t>(message.size());
    header.identifier = component;
    ride::write_header(message.data(), header);
    for (std::size_t k = 0; k < 4; ++k) {
      message[ride::Header::kSize + k] = static_cast<std::byte>(operation >> 8 * k & 0xFFU);
    }
    if (::connect(line, reinterpret_cast<const sockaddr*>(&here), sizeof here) == 0) {
      static_cast<void>(::send(line, message.data(), message.size(), MSG_NOSIGNAL));
      std::array<std::byte, 256> answer{};
      static_cast<void>(::recv(line, answer.data(), answer.size(), 0));
    }
    ::close(line);
  }
  /// Ends all connections that there are; others may come.
  void cut() { cuts_ = true; }
  std::vector<Passed> passed() const {
    const std::scoped_lock lock(mutex_);
    return passed_;
  }

 private:
  /// What has come, and goes on when its time has.
  struct Late {
    base::Time due;
    bool to_robot;
    std::vector<std::byte> bytes;
  };
  /// A connection: what comes from one side, until it is whole messages.
  struct Line {
    int from = -1;
    int to = -1;
    std::array<std::vector<std::byte>, 2> pending{};
    std::deque<Late> late{};
  };

  static sockaddr_in local(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
  }

  void run() {
    while (!done_) {
      std::vector<pollfd> all{{listener_, POLLIN, 0}};
      for (const auto& line : lines_) {
        all.push_back({line->from, POLLIN, 0});
        all.push_back({line->to, POLLIN, 0});
      }
      static_cast<void>(::poll(all.data(), all.size(), 1));
      for (std::size_t i = 1; i < all.size(); ++i) {
        if (all[i].revents != 0) pass(*lines_[(i - 1) / 2], (i - 1) % 2 == 0);
      }
      if (all[0].revents != 0) accept();
      const bool cuts = cuts_.exchange(false);
      for (const auto& line : lines_) cuts ? close(*line) : pass_late(*line);
      std::erase_if(lines_, [](const auto& line) { return line->from < 0; });
    }
  }
  void accept() {
    auto line = std::make_unique<Line>();
    line->from = ::accept(listener_, nullptr, nullptr);
    line->to = ::socket(AF_INET, SOCK_STREAM, 0);
    const sockaddr_in there = local(robot_);
    if (::connect(line->to, reinterpret_cast<const sockaddr*>(&there), sizeof there) == 0) {
      lines_.push_back(std::move(line));
      return;
    }
    ::close(line->from);
    ::close(line->to);
  }
  void pass(Line& line, bool to_robot) {
    std::array<std::byte, 4096> bytes{};
    const ssize_t count = ::recv(to_robot ? line.from : line.to, bytes.data(), bytes.size(), 0);
    if (count <= 0) return close(line);
    auto& pending = line.pending[to_robot ? 0 : 1];
    pending.insert(pending.end(), bytes.begin(), bytes.begin() + count);
    take_messages(pending, to_robot);  // first: who gets it looks at what has passed
    line.late.push_back(
        {platform::monotonic_now() + delay_, to_robot, {bytes.begin(), bytes.begin() + count}});
    pass_late(line);
  }
  static void pass_late(Line& line) {
    const base::Time now = platform::monotonic_now();
    while (!line.late.empty() && line.late.front().due <= now) {
      const Late& first = line.late.front();
      const int to = first.to_robot ? line.to : line.from;
      if (::send(to, first.bytes.data(), first.bytes.size(), MSG_NOSIGNAL) < 0) return close(line);
      line.late.pop_front();
    }
  }
  static void close(Line& line) {
    if (line.from >= 0) ::close(std::exchange(line.from, -1));
    if (line.to >= 0) ::close(std::exchange(line.to, -1));
    line.late.clear();
  }
  static ride::Number number_at(const std::vector<std::byte>& message, std::size_t place) {
    ride::Number number = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      number |= std::to_integer<ride::Number>(message[ride::Header::kSize + place + k]) << 8 * k;
    }
    return number;
  }
  void take_messages(std::vector<std::byte>& pending, bool to_robot) {
    while (pending.size() >= ride::Header::kSize) {
      const auto header = ride::read_header(pending.data());
      if (!header || pending.size() < header->length) return;
      Passed message;
      message.header = *header;
      message.to_robot = to_robot;
      if (header->length >= ride::Header::kSize + 4) message.first = number_at(pending, 0);
      if (header->length >= ride::Header::kSize + 8) message.second = number_at(pending, 4);
      const std::scoped_lock lock(mutex_);
      passed_.push_back(message);
      pending.erase(pending.begin(), pending.begin() + header->length);
    }
  }

  const std::uint16_t robot_;
  const base::Duration delay_;
  const int listener_;
  std::uint16_t port_ = 0;
  std::atomic<bool> done_{false};
  std::atomic<bool> cuts_{false};
  mutable std::mutex mutex_;
  std::vector<Passed> passed_;
  std::vector<std::unique_ptr<Line>> lines_;
  std::thread thread_;
};

}  // namespace armature::rover
