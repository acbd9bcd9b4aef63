// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "armature/base/fixed_text.hpp"
#include "armature/base/time.hpp"
#include "armature/component/author.hpp"
#include "armature/rt/inbox.hpp"

namespace armature::exec {

inline constexpr const char* kModesName = "Modes";
using ModeName = base::FixedText<63>;

/// Goes over from one mode of an application to another while it runs (see Blueprint::add_mode).
///
/// All that happens between two cycles of the thread in which the switched components live. First
/// those start that only the new mode has, in the order of the flow; if one refuses, they are
/// stopped again, and the present mode goes on. Then those stop that the new mode has not. An
/// output that feeds the same input as one of the leaving mode can see in `on_start` what it takes
/// over, so that nothing jumps (component::OutputPort::taken_over).
/// @rt nonblocking, no allocation, O(switched components), as far as their on_start and on_stop are
class Modes final : public component::Component {
 public:
  using Component::Component;

  /// Two outputs that feed one input.
  struct Succession {
    component::OutputPortBase* entering;
    const component::OutputPortBase* leaving;
  };
  /// What is different in another mode.
  struct Way {
    std::vector<component::Component*> leaving;  ///< in the order of their stop
    std::vector<Succession> successions;
  };
  /// A mode and how it is left.
  struct Mode {
    ModeName name;
    std::vector<component::Component*> members;  ///< that not all modes have, in the order of start
    std::vector<Way> ways;                       ///< to each mode
  };

  /// @thread configuration only
  void set_modes(std::vector<Mode> modes, std::size_t initial);
  /// The application starts in its initial mode.
  void begin(base::Time now);

  /// Switches at once; an error says why everything is as it was.
  /// @thread its own, between two cycles
  component::Outcome switch_to(std::string_view name);
  /// @thread its own
  std::string_view present() const { return modes_[present_].name; }
  /// Refuses for a component that other modes have and the present one has not.
  /// @thread its own
  component::Outcome admit(const component::Component& component) const;

 private:
  /// On its way to the time between two cycles.
  struct Request final : rt::Signal {
    explicit Request(Modes& modes) : rt::Signal(&deliver), self(modes) {}
    static void deliver(rt::Message& message);
    Modes& self;
  };

  component::Outcome on_start() override;
  component::Outcome begin_switch(ModeName name);
  void carry_out();

  std::size_t find(std::string_view name) const;
  component::Outcome unknown(std::string_view name) const;
  component::Outcome go_to(std::size_t target);
  component::Outcome check_ready(std::size_t target) const;
  component::Outcome start_members(std::size_t target);
  void announce_successions(const Way& way, bool begins) const;

  component::Attribute<ModeName> mode_{this, "mode", {}, "the present one"};
  component::Command<ModeName> switch_{
      this, "switch", component::serve<&Modes::begin_switch>,
      "goes over to another mode between two cycles; refused or failed, everything is as it was",
      component::args("mode")};
  component::Event<ModeName> switched_{
      this, "Switched", "another mode runs", component::occasional, {"mode"}};

  std::vector<Mode> modes_;
  std::vector<component::Component*> started_;  ///< in this switch
  std::size_t present_ = 0;
  std::size_t wanted_ = 0;
  base::Time begun_{};
  Request request_{*this};
};

}  // namespace armature::exec
