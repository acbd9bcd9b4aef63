// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <Ice/Ice.h>

#include "benchmarks/peers/peer.hpp"
#include "ice_wheels.h"

namespace armature::benchmarks::peers {
namespace {

/// Commands that go out together.
constexpr std::int64_t kBatch = 1000;

/// Ice sends without delay; one thread that executes keeps the order, and is its fastest setting.
std::shared_ptr<Ice::Communicator> make_communicator() {
  Ice::InitializationData data;
  data.properties = Ice::createProperties();
  data.properties->setProperty("Ice.ThreadPool.Server.Size", "1");
  data.properties->setProperty("Ice.ThreadPool.Client.Size", "1");
  data.properties->setProperty("Ice.ACM.Close", "0");
  data.properties->setProperty("Ice.BatchAutoFlushSize", "0");
  return Ice::initialize(data);
}

class Wheels final : public slice::Wheels {
 public:
  int setVelocity(float left, float right, const Ice::Current&) override {
    return peers::set_velocity(left, right);
  }
  int setAll(slice::Doubles all, const Ice::Current&) override { return set_all(all.size()); }
  void drive(float, float, const Ice::Current&) override {}
};

class IceServer final : public Server {
 public:
  IceServer() : communicator_(make_communicator()) {
    const auto adapter = communicator_->createObjectAdapterWithEndpoints("", "tcp -h 127.0.0.1");
    const auto proxy = adapter->add(std::make_shared<Wheels>(), Ice::stringToIdentity("Wheels"));
    adapter->activate();
    address_ = communicator_->proxyToString(proxy);
  }
  ~IceServer() override { communicator_->destroy(); }
  std::string address() const override { return address_; }

 private:
  std::shared_ptr<Ice::Communicator> communicator_;
  std::string address_;
};

class IceClient final : public Client {
 public:
  explicit IceClient(const std::string& address)
      : communicator_(make_communicator()),
        wheels_(Ice::checkedCast<slice::WheelsPrx>(communicator_->stringToProxy(address))),
        batch_(wheels_->ice_batchOneway()) {}
  ~IceClient() override { communicator_->destroy(); }

  std::int32_t set_velocity(float left, float right) override {
    return wheels_->setVelocity(left, right);
  }
  std::int32_t set_all(const std::vector<double>& all) override { return wheels_->setAll(all); }
  void drive(std::int64_t count) override {
    for (; count > 0; count -= kBatch) {
      for (std::int64_t i = std::min(count, kBatch); i > 0; --i) batch_->drive(0.5f, -0.25f);
      batch_->ice_flushBatchRequests();
    }
    wheels_->setVelocity(0.5f, 0.5f);  // after all of them: the connection is the same
  }

 private:
  std::shared_ptr<Ice::Communicator> communicator_;
  std::shared_ptr<slice::WheelsPrx> wheels_;
  std::shared_ptr<slice::WheelsPrx> batch_;
};

}  // namespace

Peer ice() {
  return {"ice", [] { return std::make_unique<IceServer>(); },
          [](const std::string& address) { return std::make_unique<IceClient>(address); }};
}

}  // namespace armature::benchmarks::peers
