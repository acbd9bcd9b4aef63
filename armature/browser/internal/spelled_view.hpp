// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/browser/internal/language.hpp"
#include "armature/inspect/view.hpp"

namespace armature::browser::internal {

/// `Joint1.Position` or `Generator:moveTo`, in its parts.
struct MemberName {
  std::string component;
  char separator = '.';
  std::string member;
  std::string rest;  ///< what stands behind it
};

/// A view of an application as lines have it: names are spelled as a language spells them, and
/// values are text for people, without their unit.
class SpelledView {
 public:
  /// Both outlive it.
  SpelledView(inspect::View& view, const Language& language) : view_(view), language_(language) {}

  std::vector<std::string> component_names() { return view_.component_names(); }
  /// The component whose name `text` is, as a line may spell it; empty if there is none.
  std::string find(std::string_view text);
  /// How a line spells the name of a component.
  std::string spelled(const std::string& component) const { return language_.spelled(component); }
  /// Why there is no such component, with the nearest name.
  std::string no_component(std::string_view text);
  /// The component with the longest name that `text` begins with, and the member of it that
  /// follows; the error says which of them is not there, and what is near.
  base::Result<MemberName> member_in(std::string_view text);

  inspect::ApplicationStatus status() { return view_.status(); }
  exec::Pace pace() { return view_.pace(); }
  exec::Pace set_pace(const exec::Pace& pace) { return view_.set_pace(pace); }
  exec::Pace step() { return view_.step(); }
  std::vector<inspect::ComponentStatus> components() { return view_.components(); }
  inspect::Faults faults() { return view_.faults(); }
  inspect::LogLines log(std::uint64_t after) { return view_.log(after); }
  /// A component with its values.
  inspect::ComponentDescription look_at(const std::string& component);
  /// A component without them: asks no thread of the application.
  inspect::ComponentDescription interface_of(const std::string& component) {
    return view_.describe(component, inspect::Values::kLeftOut);
  }
  /// @param most_elements  of a list that are shown
  std::vector<inspect::ItemValue> read(const std::vector<std::string>& items,
                                       std::size_t most_elements);
  /// Sets a property and returns what it is now.
  inspect::ItemValue write(const std::string& item, const std::string& value);

  /// What the operation gives; empty if it gives nothing.
  std::string call(const std::string& component, const std::string& operation,
                   const std::vector<std::string>& arguments);

  struct Changed {
    std::string refusal;  ///< empty if it was done
    std::string state;    ///< what it is in now
  };
  Changed change(const std::string& component, inspect::LifeCycleChange change);

 private:
  inspect::ItemValue for_people(inspect::ItemValue value, std::size_t most_elements);

  inspect::View& view_;
  const Language& language_;
};

/// `Running`; empty if nobody says.
std::string state_name(const inspect::ComponentStatus& component);

}  // namespace armature::browser::internal
