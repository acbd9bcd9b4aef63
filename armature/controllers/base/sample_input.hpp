// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/component/author.hpp"
#include "armature/component/face.hpp"

namespace armature::controllers {

/// Checks how a component is told that a sampling period begins: by the event Sample of a peer, or
/// by the port SamplePort (paper 3, figure 4), and by one of them alone.
///
/// Whose data triggers others is sampled after them, since each of them computes at once. Events
/// are told in that order by themselves, ports in the order of the connections.
class SampleInput final : public component::Checked {
 public:
  /// @param event, port  of `owner`; either begins a sampling period
  SampleInput(component::Component* owner, const component::EventHandler<>& event,
              const component::InputPort<std::uint64_t>& port)
      : Checked(owner), event_(face(event)), port_(face(port)) {}

  void check(component::Check& check) const override;

 private:
  void check_order(component::Check& check) const;

  const component::EventHandlerBase& event_;
  const component::InputPortBase& port_;
};

}  // namespace armature::controllers
