// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "inspection_types.hpp"

namespace armature::studio::internal {

/// What somebody wants of a component that runs.
enum class Act {
  kUnknown,  ///< the component, or what is wanted of it, is not known
  kAnybodys,
  kOperators,  ///< `by_operator`
};

/// What the components of a run do for its operator alone, by their own descriptions.
class OperatorsActs {
 public:
  /// These are all that there are.
  void expect(const std::vector<remote::ComponentStatus>& components);
  void add(const remote::ComponentDetails& details);

  /// Those that were not added yet.
  std::vector<std::string> missing() const;
  /// All were added.
  bool complete() const { return expected_ && missing_.empty(); }

  Act of_operation(const std::string& component, const std::string& operation) const;
  /// @param item  a property or a part of it: `Settings.Gains.kp`
  Act of_item(std::string_view item) const;
  /// Components that an operator arms, and everybody disarms.
  std::vector<std::string> disarmed() const;

 private:
  struct Members {
    std::map<std::string, bool, std::less<>> operations;  ///< whether they are the operator's
    std::map<std::string, bool, std::less<>> properties;
  };

  bool expected_ = false;
  std::set<std::string> missing_;
  std::map<std::string, Members, std::less<>> components_;
};

}  // namespace armature::studio::internal
