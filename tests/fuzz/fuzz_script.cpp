// SPDX-License-Identifier: Apache-2.0
// Whatever a script says, it ends in time, and the application it commands stays as it is.
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "armature/component/author.hpp"
#include "armature/exec/application.hpp"
#include "armature/lua/script.hpp"

namespace {

using namespace armature;
using namespace std::chrono_literals;

class Axis final : public component::Component {
 public:
  using Component::Component;

 private:
  component::Outcome begin(double target) {
    if (!(target >= 0.0 && target <= 10.0)) return component::refused("outside");
    target_ = target;
    return component::accepted();
  }
  void on_update() override {
    position_ += position_ < target_ ? 1.0 : position_ > target_ ? -1.0 : 0.0;
    port_.write(position_);
    moved_.raise(position_, {1, 2});
  }
  bool arrived() { return position_ == target_; }

  component::Property<double> gain_{this, "Gain", 1.0, "", "", component::changeable_while_running};
  component::OutputPort<double> port_{this, "Position", ""};
  component::Event<double, std::array<int, 2>> moved_{this, "Moved", ""};
  component::Command<double> move_{this, "moveTo", component::serve<&Axis::begin>, "",
                                   component::done_when<&Axis::arrived>};
  double position_ = 0.0;
  double target_ = 0.0;
};

/// Patterns are the one thing that Lua does not interrupt.
bool matches_patterns(std::string_view text) {
  for (const std::string_view name : {"find", "match", "gsub"}) {
    if (text.find(name) != std::string_view::npos) return true;
  }
  return false;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (matches_patterns(text)) return 0;
  lua::Options options;
  options.time_limit = 20ms;
  options.memory_limit = 4u << 20;
  base::Diagnostics diagnostics;
  const auto script = lua::parse_script(text, "/nowhere/fuzz.lua", options, diagnostics);
  if (!diagnostics.ok()) return 0;
  exec::Blueprint blueprint;
  blueprint.add<Axis>("Axis", exec::Activity::periodic(10ms));
  exec::ApplicationOptions simulated;
  simulated.simulated = true;
  exec::Application application(std::move(blueprint), simulated);
  if (!application.start().ok()) std::abort();
  script->run(application, 1s, nullptr, diagnostics);
  if (application.faults() > 0) std::abort();
  return 0;
}
