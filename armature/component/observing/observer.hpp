// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "armature/component/component.hpp"
#include "armature/component/observing/tap.hpp"

namespace armature::component {

/// What an observer sees of its application.
struct Surroundings {
  std::vector<Component*> components;  ///< all of them, as declared
  std::string folder;                  ///< where its files go; empty: the working directory
};

/// Part of a component that looks at others which it is not connected to, such as a recorder. It
/// needs a period of its own; it starts before all others and stops after them.
class Observer {
 public:
  /// Why it cannot observe what it was told to.
  struct Objection {
    std::string message;  ///< what it was to look at and what is wrong with that
    std::string hint;
  };

  explicit Observer(Component* owner);
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;

  /// Why it cannot look at what its properties say; changes nothing.
  virtual std::vector<Objection> check_view(const std::vector<Component*>& components) const = 0;

  /// Taps what it looks at. All are configured and connected, and nobody runs. The taps end when
  /// the application has cleaned up.
  virtual void observe(const Surroundings& surroundings) = 0;

  /// What runs, for files that outlive it: `deployment`, `version`, `machine`, ...
  using About = std::map<std::string, std::string>;
  void set_about(About about) { about_ = std::move(about); }

 protected:
  ~Observer() = default;
  const About& about() const { return about_; }

 private:
  About about_;
};

}  // namespace armature::component
