// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "armature/component/author.hpp"
#include "armature/guardian/guardian.hpp"
#include "armature/types/enum.hpp"

namespace armature::controllers {

/// Whether a bus has a guardian.
enum class Guarding : std::uint8_t {
  kOff,
  kOn,        ///< where there can be one
  kRequired,  ///< nothing runs without it
};
ARMATURE_ENUM(Guarding, kOff, kOn, kRequired);

/// The guardian of a component's bus, and the property that says whether it has one. Another
/// process switches the drives off when this one dies, hangs or is stopped (docs/realtime.md).
class GuardedBus {
 public:
  explicit GuardedBus(component::Component* owner);

  /// To be called when the bus is there; ends the guardian that there was.
  /// @return refused if one is required and cannot be
  /// @thread configuration only
  component::Outcome start(const guardian::Orders& orders);
  /// The same where there cannot be one.
  /// @param why  such as "the emulated arm ends with this process"
  component::Outcome do_without(std::string_view why);
  void end() { guardian_.reset(); }
  /// What the two above have to say: who guards the bus, or why nobody does. Empty: it is not to.
  const std::string& said() const { return said_; }
  /// Whether that is no more than was asked for.
  bool complains() const { return complains_; }

  /// To be called in each cycle, before anything is sent.
  /// @return why the component has to go out of service; nothing if all is well
  /// @rt nonblocking, no allocation
  std::optional<component::Reason> beat(base::Time now);
  /// True once when a guardian that is not required has gone.
  bool take_loss() { return std::exchange(loss_, false); }
  /// The drives are off: no cycle is expected.
  /// @rt nonblocking, no allocation
  void rest();

 private:
  component::Outcome go_without(std::string_view why);

  component::Property<Guarding> wanted_;
  std::unique_ptr<guardian::Guardian> guardian_;
  std::string said_;
  bool complains_ = false;
  bool required_ = false;
  bool gone_ = false;
  bool loss_ = false;
};

}  // namespace armature::controllers
