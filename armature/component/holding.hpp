// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "armature/component/component.hpp"
#include "armature/component/events/event.hpp"
#include "armature/component/face.hpp"
#include "armature/component/operations/signature.hpp"

namespace armature::component {

/// Something that a component keeps from falling, rolling or opening while it runs: an arm's
/// weight. An orderly stop, of the component or of its application, asks first and lets go in no
/// silence (exec/application.hpp).
///
///     component::EventHandler<> sample_{this, "Sample", ...};
///     component::Holding holding_{this, component::serve<&Arm::held>, sample_};
class Holding {
 public:
  /// `Function` is `Reason f()`: what would move if the component stopped now, and what the
  /// operator can do; empty if nothing would. Never asked unless the component runs.
  /// @param kept_by  the event without which nothing is held any more: whoever raises it is not
  ///   stopped either
  template <auto Function, typename... Args>
  Holding(Component* owner, Serve<Function> function, const EventHandler<Args...>& kept_by)
      : Holding(owner, function, &internal::Inside::face(kept_by)) {}
  template <auto Function>
  Holding(Component* owner, Serve<Function> function) : Holding(owner, function, nullptr) {}
  Holding(const Holding&) = delete;
  Holding& operator=(const Holding&) = delete;

  /// @thread the component's own
  Reason held() const;
  /// The handler of the event without which nothing is held; nullptr if there is none.
  const EventHandlerBase* keeper() const { return kept_by_; }
  /// Who raises that event; nullptr if nobody has to, or does.
  const Component* kept_by() const;

 private:
  using Held = Reason (*)(Component&);
  template <auto Function>
  Holding(Component* owner, Serve<Function>, const EventHandlerBase* kept_by)
      : Holding(
            *owner,
            [](Component& component) -> Reason {
              return (static_cast<internal::OwnerOf<Function>&>(component).*Function)();
            },
            kept_by) {}
  Holding(Component& owner, Held function, const EventHandlerBase* kept_by);

  Component& owner_;
  Held held_;
  const EventHandlerBase* kept_by_;
};

}  // namespace armature::component
