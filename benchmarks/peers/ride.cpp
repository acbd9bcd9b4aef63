// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <stdexcept>

#include <sched.h>

#include "armature/ride/node.hpp"
#include "benchmarks/peers/peer.hpp"
#include "remote_client.hpp"
#include "remote_service.hpp"

namespace armature::benchmarks::peers {
namespace {

class Wheels final : public remote::WheelsService {
 public:
  std::int32_t setVelocity(float left, float right) override { return set_velocity(left, right); }
  std::int32_t setAll(const std::vector<double>& all) override { return set_all(all.size()); }
  void drive(float, float) override {}
};

class RideServer final : public Server {
 public:
  RideServer() {
    const auto address = node_.listen("tcp://127.0.0.1:0");
    if (!address) throw std::runtime_error(address.error());
    if (!node_.add("Wheels", wheels_)) throw std::runtime_error("cannot be added");
    address_ = address.value().text();
  }
  std::string address() const override { return address_; }

 private:
  Wheels wheels_;
  ride::Node node_;
  std::string address_;
};

class RideClient final : public Client {
 public:
  explicit RideClient(const std::string& address)
      : peer_(node_.connect(address)), wheels_(peer_, "Wheels") {
    const auto connected = peer_.wait_until_connected(std::chrono::seconds(5));
    if (!connected) throw std::runtime_error(connected.error());
    patient_.deadline = std::chrono::seconds(60);
  }
  std::int32_t set_velocity(float left, float right) override {
    return value_of(wheels_.setVelocity(left, right));
  }
  std::int32_t set_all(const std::vector<double>& all) override {
    return value_of(wheels_.setAll(all));
  }
  void drive(std::int64_t count) override {
    for (; count > 0; --count) {
      while (wheels_.drive(0.5f, -0.25f) != ride::Sent::kYes) sched_yield();
    }
    value_of(wheels_.setVelocity(0.5f, 0.5f, patient_));  // after all of them
  }

 private:
  static std::int32_t value_of(const ride::Answer<std::int32_t>& answer) {
    if (!answer.ok()) throw std::runtime_error(answer.error());
    return answer.value();
  }

  ride::Node node_;
  ride::Peer& peer_;
  remote::WheelsPlaceholder wheels_;
  ride::CallOptions patient_;
};

}  // namespace

Peer ride() {
  return {"ride", [] { return std::make_unique<RideServer>(); },
          [](const std::string& address) { return std::make_unique<RideClient>(address); }};
}

}  // namespace armature::benchmarks::peers
