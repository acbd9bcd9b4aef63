// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "armature/browser/internal/answers.hpp"
#include "armature/browser/internal/language.hpp"
#include "armature/browser/internal/remote_session.hpp"
#include "armature/browser/internal/spelled_view.hpp"
#include "armature/browser/internal/words.hpp"

namespace armature::browser::internal {

/// Values to set and operations to call, for an application of another process, which runs no
/// statements of others.
class PlainLanguage final : public Language {
 public:
  /// All outlive it.
  PlainLanguage(RemoteSession& session, Answers& answers)
      : session_(session), view_(session.view(), *this), answers_(answers) {}

  const Vocabulary& vocabulary() const override { return plain_vocabulary(); }
  bool goes_on(std::string_view) const override { return false; }
  bool is_statement(std::string_view line) const override;
  void take(std::string_view line) override;
  std::string plain(std::string_view text) const override;
  std::string spelled(const std::string& component) const override { return component; }
  std::vector<std::string> names_in(const std::string&) override { return {}; }

 private:
  void take_call(std::string_view line);
  void take_assignment(const Assignment& assignment);
  void explain(const std::string& line);

  RemoteSession& session_;
  SpelledView view_;
  Answers& answers_;
};

}  // namespace armature::browser::internal
