// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "inspection_types.hpp"

namespace armature::browser::internal {

/// Thrown by a Robot that is asked for what it has not, refuses, or does not answer.
class NoAnswer : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The application that the task browser shows and commands: of this process or of another. Its
/// values are text for people, without their unit.
class Robot {
 public:
  virtual ~Robot() = default;

  virtual std::vector<std::string> component_names() = 0;
  /// The component whose name `text` is, as a line may spell it; empty if there is none.
  virtual std::string find(std::string_view text) = 0;
  /// How a line spells the name of a component.
  virtual std::string spelled(const std::string& component) const = 0;

  virtual remote::ApplicationStatus status() = 0;
  virtual std::vector<remote::ComponentStatus> components() = 0;
  virtual remote::Faults faults() = 0;
  /// A component with its values.
  virtual remote::ComponentDetails look_at(const std::string& component) = 0;
  /// A component without them: asks no thread of the application.
  virtual remote::ComponentDetails interface_of(const std::string& component) = 0;
  /// Values, with an age where it is to be told.
  /// @param most_elements  of a list that are shown
  virtual std::vector<remote::ItemValue> read(const std::vector<std::string>& items,
                                              std::size_t most_elements) = 0;

  struct Changed {
    std::string refusal;  ///< empty if it was done
    std::string state;    ///< what it is in now
  };
  /// @param change  start, stop, reset, recover or cleanup
  virtual Changed change(const std::string& component, const std::string& change) = 0;
};

/// Why there is no such component, with the nearest name.
std::string no_component(Robot& robot, std::string_view text);

/// `Joint1.Position` or `Generator:moveTo`, in its parts.
struct MemberName {
  std::string component;
  char separator = '.';
  std::string member;
  std::string rest;  ///< what stands behind it
};
/// The component with the longest name that `text` begins with, and the member of it that follows;
/// the error says which of them is not there, and what is near.
base::Result<MemberName> member_in(Robot& robot, std::string_view text);

}  // namespace armature::browser::internal
