// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "armature/browser/internal/answers.hpp"
#include "armature/browser/internal/plain_language.hpp"
#include "armature/browser/internal/remote_session.hpp"
#include "armature/browser/internal/task_browser.hpp"

namespace armature::browser::internal {

/// A task browser with all that it needs for an application of another process.
struct RemoteBrowsing {
  RemoteBrowsing(remote::PeerView& view, Surface& surface, RemoteSession::Pause pause)
      : answers(surface),
        session(view, answers, std::move(pause)),
        language(session, answers),
        browser(view, session, language, answers) {}

  Answers answers;
  RemoteSession session;
  PlainLanguage language;
  TaskBrowser browser;
};

}  // namespace armature::browser::internal
