// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/browser/internal/answers.hpp"
#include "armature/browser/internal/local_robot.hpp"
#include "armature/browser/internal/local_session.hpp"
#include "armature/browser/internal/lua_language.hpp"
#include "armature/browser/internal/task_browser.hpp"

namespace armature::browser::internal {

/// A task browser with all that it needs for an application of this process.
struct LocalBrowsing {
  LocalBrowsing(exec::Application& application, base::Duration duration,
                const platform::StopSignal* stop, bool simulated, Surface& surface)
      : answers(surface),
        robot(application),
        session(application, duration, stop, simulated, surface),
        language(application, session.interpreter(), answers),
        browser(robot, session, language, answers) {}

  Answers answers;
  LocalRobot robot;
  LocalSession session;
  LuaLanguage language;
  TaskBrowser browser;
};

}  // namespace armature::browser::internal
