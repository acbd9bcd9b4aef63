// SPDX-License-Identifier: Apache-2.0
// A component that runs periodically and says so.
#include "armature/component/author.hpp"

using namespace armature::component;

namespace {

/// Greets once in a while.
class Greeter final : public Component {
 public:
  using Component::Component;

 private:
  Outcome on_configure() override {
    if (whom_.get().empty()) return refused("the property Whom is empty: set it to a name");
    return accepted();
  }

  void on_update() override {
    ++greetings_;
    log_info("hello, {}! ({})", whom_.get(), greetings_);
  }

  void on_stop() override { log_info("goodbye after {} greetings", greetings_); }

  Property<std::string> whom_{this, "Whom", "world", "who is greeted"};

  int greetings_ = 0;
};

}  // namespace

ARMATURE_COMPONENT_LIBRARY(hello, registry) {
  registry.add<Greeter>("Greeter", "greets once in a while");
}
