// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/local_session.hpp"

#include "armature/base/seconds.hpp"
#include "armature/browser/internal/display.hpp"

namespace armature::browser::internal {

LocalSession::LocalSession(exec::Application& application, base::Duration duration,
                           const platform::StopSignal* stop, bool simulated, Surface& surface)
    : application_(application),
      simulated_(simulated),
      begin_(application.now()),
      course_(application, duration, stop),
      listener_(surface),
      interpreter_(
          lua::make_interpreter(application, course_, listener_,
                                {.simulated = simulated, .most_elements = kAskedElements})) {}

double LocalSession::seconds() const { return base::to_seconds(application_.now() - begin_); }

std::string LocalSession::prompt() const {
  const std::string& name = application_.blueprint().name;
  return name + (simulated_ ? number_text(" %.9g s> ", seconds()) : "> ");
}

std::string LocalSession::interrupted_text() const {
  return "interrupted at " + number_text("%.9g s", seconds());
}

}  // namespace armature::browser::internal
