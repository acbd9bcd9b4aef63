// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "benchmarks/peers/peer.hpp"
#include "corba_wheels.hh"

namespace armature::benchmarks::peers {
namespace {

/// omniORB sends without delay, and its defaults are its fastest settings here: a thread for each
/// connection reads, executes and answers.
CORBA::ORB_var make_orb(bool serves) {
  const char* options[][2] = {{"endPoint", "giop:tcp:127.0.0.1:0"}, {nullptr, nullptr}};
  int count = 0;
  return CORBA::ORB_init(count, nullptr, "omniORB4", serves ? options : nullptr);
}

class Wheels final : public POA_orb::Wheels {
 public:
  CORBA::Long setVelocity(CORBA::Float left, CORBA::Float right) override {
    return set_velocity(left, right);
  }
  CORBA::Long setAll(const orb::Doubles& all) override { return set_all(all.length()); }
  void drive(CORBA::Float, CORBA::Float) override {}
};

class OmniOrbServer final : public Server {
 public:
  OmniOrbServer() : orb_(make_orb(true)) {
    const CORBA::Object_var object = orb_->resolve_initial_references("RootPOA");
    const PortableServer::POA_var adapter = PortableServer::POA::_narrow(object);
    const PortableServer::ObjectId_var id = adapter->activate_object(&wheels_);
    const CORBA::Object_var served = wheels_._this();
    const CORBA::String_var text = orb_->object_to_string(served);
    address_ = text.in();
    const PortableServer::POAManager_var manager = adapter->the_POAManager();
    manager->activate();
  }
  ~OmniOrbServer() override { orb_->destroy(); }
  std::string address() const override { return address_; }

 private:
  Wheels wheels_;
  CORBA::ORB_var orb_;
  std::string address_;
};

class OmniOrbClient final : public Client {
 public:
  explicit OmniOrbClient(const std::string& address) : orb_(make_orb(false)) {
    const CORBA::Object_var object = orb_->string_to_object(address.c_str());
    wheels_ = orb::Wheels::_narrow(object);
    if (CORBA::is_nil(wheels_)) throw std::runtime_error("omniORB: no Wheels at its address");
  }
  ~OmniOrbClient() override { orb_->destroy(); }

  std::int32_t set_velocity(float left, float right) override {
    return wheels_->setVelocity(left, right);
  }
  std::int32_t set_all(const std::vector<double>& all) override {
    const auto size = static_cast<CORBA::ULong>(all.size());
    // The sequence borrows them.
    const orb::Doubles borrowed(size, size, const_cast<double*>(all.data()), false);
    return wheels_->setAll(borrowed);
  }
  void drive(std::int64_t count) override {
    for (; count > 0; --count) wheels_->drive(0.5f, -0.25f);
    wheels_->setVelocity(0.5f, 0.5f);  // after all of them: the connection is the same
  }

 private:
  CORBA::ORB_var orb_;
  orb::Wheels_var wheels_;
};

}  // namespace

Peer omniorb() {
  return {"omniorb", [] { return std::make_unique<OmniOrbServer>(); },
          [](const std::string& address) { return std::make_unique<OmniOrbClient>(address); }};
}

}  // namespace armature::benchmarks::peers
