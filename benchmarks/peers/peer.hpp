// SPDX-License-Identifier: Apache-2.0
#pragma once

// What is measured beside each other: ways to call a component in another process, each with its
// own compiler, library and settings, and the same component behind them.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace armature::benchmarks::peers {

/// The component: what it answers is looked at by whoever asks.
inline std::int32_t set_velocity(float left, float) { return left > 0.0f ? 1 : 0; }
inline std::int32_t set_all(std::size_t count) { return static_cast<std::int32_t>(count); }

/// Serves the component as long as it lives.
class Server {
 public:
  virtual ~Server() = default;
  /// One line, by which a client finds it.
  virtual std::string address() const = 0;
};

/// Uses the component of a server in another process.
class Client {
 public:
  virtual ~Client() = default;
  virtual std::int32_t set_velocity(float left, float right) = 0;
  virtual std::int32_t set_all(const std::vector<double>& all) = 0;
  /// Sends so many commands; returns when all of them were executed.
  virtual void drive(std::int64_t count) = 0;
};

struct Peer {
  std::string name;
  std::function<std::unique_ptr<Server>()> serve;
  std::function<std::unique_ptr<Client>(const std::string& address)> connect;
};

Peer raw();  ///< sockets that send as many bytes as ride
Peer ride();
Peer omniorb();
Peer ice();
Peer zeromq();
Peer cyclonedds();

/// Ride and those whose packages were there when this was built.
std::vector<Peer> all_peers();

}  // namespace armature::benchmarks::peers
