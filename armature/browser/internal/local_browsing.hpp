// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "armature/browser/internal/answers.hpp"
#include "armature/browser/internal/local_session.hpp"
#include "armature/browser/internal/lua_language.hpp"
#include "armature/browser/internal/task_browser.hpp"
#include "armature/inspect/application_view.hpp"

namespace armature::browser::internal {

/// A task browser with all that it needs for an application of this process.
struct LocalBrowsing {
  LocalBrowsing(exec::Application& application, base::Duration duration,
                const platform::StopSignal* stop, bool simulated, Surface& surface)
      : answers(surface),
        view(application),
        session(application, duration, stop, simulated, surface),
        language(application, view, session.interpreter(), answers),
        browser(view, session, language, answers) {}

  Answers answers;
  inspect::ApplicationView view;
  LocalSession session;
  LuaLanguage language;
  TaskBrowser browser;
};

}  // namespace armature::browser::internal
