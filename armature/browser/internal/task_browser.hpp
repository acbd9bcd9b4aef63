// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "armature/browser/internal/answers.hpp"
#include "armature/browser/internal/completion.hpp"
#include "armature/browser/internal/console.hpp"
#include "armature/browser/internal/language.hpp"
#include "armature/browser/internal/life_cycle.hpp"
#include "armature/browser/internal/session.hpp"
#include "armature/browser/internal/spelled_view.hpp"
#include "armature/browser/internal/words.hpp"

namespace armature::browser::internal {

class Watch;

/// What the operator's lines mean: commands of the browser, values to show, else the language.
/// Knows neither the terminal nor whether the application is of this process.
class TaskBrowser final : public LineTaker {
 public:
  /// All outlive it.
  TaskBrowser(inspect::View& view, Session& session, Language& language, Answers& answers)
      : view_(view, language),
        session_(session),
        language_(language),
        answers_(answers),
        life_cycle_(view_, answers) {}

  void take(std::string_view line) override;
  bool idle() override { return session_.keep_up(); }
  bool wants_more() const override { return language_.wants_more(); }
  void forget_lines() override { language_.forget_lines(); }
  std::string prompt() const override { return wants_more() ? "... " : session_.prompt(); }
  Completion complete(std::string_view before_cursor) override;
  void stop() override { session_.stop(); }
  bool has_ended() const override { return session_.has_ended(); }
  std::size_t mistakes() const override { return answers_.mistakes(); }

 private:
  struct Command;
  static const Command* find_command(std::string_view name);
  const Command* command_of(std::string_view line) const;
  void take_whole(const std::string& line);
  bool take_item(const std::string& line);
  bool takes_nothing(std::string_view command, const Words& arguments);

  void list(const Words& names);
  void help(const Words& subjects);
  void threads(const Words& arguments);
  void log(const Words& arguments);
  void faults(const Words& arguments);
  void start(const Words& names) { life_cycle_.start(names); }
  void stop_components(const Words& names) { life_cycle_.stop(names, vocabulary().quitting); }
  void reset(const Words& names) { life_cycle_.reset(names); }
  void recover(const Words& names) { life_cycle_.recover(names); }
  void clean_up(const Words& names) { life_cycle_.clean_up(names); }
  void watch(const Words& words);
  void run(const Words& arguments);
  void wait(const Words& arguments);
  void pace(const Words& arguments);
  void cancel(const Words& arguments);
  void quit(const Words& arguments);

  void let_pass(const Words& duration, std::string_view wanted);
  const Vocabulary& vocabulary() const { return language_.vocabulary(); }
  Surface& surface() { return answers_.surface(); }
  Paper paper() const { return answers_.paper(); }

  SpelledView view_;
  Session& session_;
  Language& language_;
  Answers& answers_;
  LifeCycle life_cycle_;
};

}  // namespace armature::browser::internal
