// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "armature/foxglove/internal/outlet.hpp"
#include "armature/foxglove/internal/shape.hpp"
#include "armature/inspect/view.hpp"

namespace armature::foxglove::internal {

/// The properties and attributes of an application as a client's parameters, `Joint1.Kp`.
class Parameters {
 public:
  Parameters(inspect::View& view, Outlet& outlet) : view_(view), outlet_(outlet) {}

  /// These are all that there are; which the client wants to be told of stays.
  void replace(const std::vector<inspect::ComponentDescription>& components);

  // What the client asks for. Throws inspect::NoAnswer where nothing can be asked.
  void get(const GetParameters& request);
  /// Sets what the application's policy lets it set, one after the other. No input of a component
  /// is set, and nothing that only its operator may set.
  void set(const SetParameters& request);
  void subscribe(const SubscribeParameters& request);
  void unsubscribe(const UnsubscribeParameters& request);

  /// Tells what has changed of those that the client wants to be told of.
  void look();

 private:
  struct Known {
    Shape shape;
    bool by_operator = false;
  };

  std::vector<std::string> named(const std::vector<std::string>& names) const;
  std::vector<Parameter> read(const std::vector<std::string>& names);
  base::Result<void> set(const Parameter& parameter);

  inspect::View& view_;
  Outlet& outlet_;
  std::map<std::string, Known> known_;
  bool told_of_all_ = false;
  std::map<std::string, std::optional<Json>> told_;  ///< of those it is told of: the last value
};

}  // namespace armature::foxglove::internal
