// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/component/check.hpp"

namespace armature::component {

/// What a deployment's `Check` knows of threads, for components that may not run in every one: code
/// that works for milliseconds or waits keeps out of threads that are real-time.
/// @thread configuration only
class CheckOfThreads {
 public:
  /// The activity of the component that is checked asks for a real-time scheduler.
  virtual bool is_real_time() const = 0;
  /// `other` runs in the same thread: it waits while the component works.
  virtual bool shares_thread_with(const Component& other) const = 0;

  /// That of a check; nullptr where nobody planned threads, as in a test of one component.
  static const CheckOfThreads* of(const Check& check) {
    return dynamic_cast<const CheckOfThreads*>(&check);
  }

 protected:
  ~CheckOfThreads() = default;
};

}  // namespace armature::component
