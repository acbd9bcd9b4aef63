// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

#include "armature/base/diagnostic.hpp"

namespace armature::component {

class PropertyBase;

/// Whose it is what a component keeps, and when.
struct KeepingMoment {
  std::string owner;             ///< `application/component`
  std::chrono::sys_seconds now;  ///< on the wall clock, UTC
};

/// What a component leaves for its next run where the deployment says `autosave`, and that is no
/// setting but was measured, such as where a joint is. It travels in persistent properties, which
/// the component itself fills: before the start as "a run has begun", after the end with what was
/// measured. So a run that died leaves a file that says so.
/// @thread the program's, while the component does not run; all of them
class Keeping {
 public:
  /// Whether it fills this property of the component: a file that has all settings may lack it.
  virtual bool fills(const PropertyBase& property) const = 0;
  /// The property file was read, or does not exist yet.
  /// @param where        of the property file in the deployment
  /// @param diagnostics  what cannot be believed; an error refuses the deployment
  virtual void take(const KeepingMoment& moment, const base::Location& where,
                    base::Diagnostics& diagnostics) = 0;
  /// The properties say that a run has begun.
  virtual void begin(const KeepingMoment& moment) = 0;
  /// They say again what `take` found: nothing has started.
  virtual void give_back() = 0;
  /// They say what is kept.
  /// @return why nothing is kept; empty: it is
  virtual std::string end(const KeepingMoment& moment) = 0;

 protected:
  ~Keeping() = default;
};

/// A component that keeps something.
class Keeps {
 public:
  virtual Keeping& keeping() = 0;

 protected:
  ~Keeps() = default;
};

}  // namespace armature::component
