// SPDX-License-Identifier: Apache-2.0
#include "armature/script/browser.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "armature/platform/terminal.hpp"
#include "armature/script/internal/line_editor.hpp"
#include "armature/script/internal/surface.hpp"
#include "armature/script/internal/task_browser.hpp"

namespace armature::script {
namespace {

using internal::LineEditor;
using internal::Paper;
using internal::TaskBrowser;
using platform::kStandardError;
using platform::kStandardInput;
using platform::kStandardOutput;

constexpr int kUsualWidth = 80;
constexpr base::Duration kIdlePeriod = std::chrono::milliseconds(20);

void write_line(std::FILE* file, std::string_view text) {
  std::fprintf(file, "%.*s\n", static_cast<int>(text.size()), text.data());
  std::fflush(file);
}

/// Lines out and in, and nothing else.
class Pipe final : public internal::Surface {
 public:
  Paper paper() const override { return {kUsualWidth, false}; }
  bool live() const override { return false; }
  void say(std::string_view text) override { write_line(stdout, text); }
  void complain(std::string_view text) override { write_line(stderr, text); }
  void show(std::string_view) override {}
  bool interrupted() const override { return false; }
  bool take_interrupt() override { return false; }
  void begin_keys() override {}
  bool take_key() override { return false; }
  void end_keys() override {}
};

bool wants_colour() {
  const char* const no_colour = std::getenv("NO_COLOR");
  const char* const terminal = std::getenv("TERM");
  const bool dumb = terminal == nullptr || std::string_view(terminal) == "dumb";
  return !dumb && (no_colour == nullptr || *no_colour == '\0');
}

class Terminal final : public internal::Surface {
 public:
  Paper paper() const override {
    return {static_cast<std::size_t>(platform::terminal_width(kStandardOutput, kUsualWidth)),
            colour_};
  }
  bool live() const override { return true; }
  void say(std::string_view text) override {
    beside([&] { write_line(stdout, text); });
  }
  void complain(std::string_view text) override {
    beside([&] { write_line(stdout, inked(paper(), internal::Ink::kBad, text)); });
  }
  void show(std::string_view text) override {
    erase();
    shown_ = text;
    draw();
  }
  bool interrupted() const override { return interrupt_ && interrupt_->received(); }
  bool take_interrupt() override { return interrupt_ && interrupt_->take(); }
  void begin_keys() override { keys_.emplace(kStandardInput); }
  bool take_key() override {
    if (!platform::wait_readable(kStandardInput, base::Duration::zero())) return false;
    platform::read_some(kStandardInput, 64);
    return true;
  }
  void end_keys() override { keys_.reset(); }

  void beside(const std::function<void()>& write) {
    erase();
    if (editor_ != nullptr) {
      editor_->beside(write);
    } else {
      write();
    }
    draw();
  }
  /// From then on Ctrl-C is for the browser; without an editor it stops the program again.
  void set_editor(LineEditor* editor) {
    editor_ = editor;
    if (editor != nullptr) {
      interrupt_.emplace();
    } else {
      interrupt_.reset();
    }
  }

 private:
  void draw() {
    const std::size_t width = paper().width;
    std::string_view rest = shown_;
    rows_ = 0;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      const std::size_t columns = internal::columns_of(rest.substr(0, end));
      write_line(stdout, rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
      rows_ += columns == 0 ? 1 : (columns + width - 1) / width;
    }
  }
  void erase() {
    if (rows_ == 0) return;
    std::printf("\x1b[%zuA\r\x1b[J", rows_);
    std::fflush(stdout);
    rows_ = 0;
  }

  bool colour_ = wants_colour();
  std::optional<platform::InterruptSignal> interrupt_;
  std::optional<platform::SingleKeys> keys_;
  LineEditor* editor_ = nullptr;
  std::string shown_;
  std::size_t rows_ = 0;  ///< of the screen that what is shown takes
};

/// Lines of a pipe, as they come; the application goes on while none does.
class PipedLines {
 public:
  /// Nothing at the end of the input, or of the run.
  std::optional<std::string> next(TaskBrowser& browser) {
    while (true) {
      const std::size_t end = text_.find('\n');
      if (end != std::string::npos) {
        std::string line = text_.substr(0, end);
        text_.erase(0, end + 1);
        return line;
      }
      if (at_end_ || !browser.idle()) return last();
      if (!platform::wait_readable(kStandardInput, kIdlePeriod)) continue;
      const auto more = platform::read_some(kStandardInput, 4096);
      if (!more) continue;
      at_end_ = more->empty();
      text_ += *more;
    }
  }

 private:
  std::optional<std::string> last() {
    if (!at_end_ || text_.empty()) return std::nullopt;
    return std::exchange(text_, {});
  }

  std::string text_;
  bool at_end_ = false;
};

class StandardBrowser final : public Browser {
 public:
  explicit StandardBrowser(bool simulated) : simulated_(simulated) {
    if (platform::is_terminal(kStandardInput) && platform::is_terminal(kStandardOutput)) {
      terminal_ = std::make_unique<Terminal>();
    }
  }

  exec::RunEnd run(exec::Application& application, base::Duration duration,
                   const platform::StopSignal* stop) override;
  void beside(const std::function<void()>& write) override {
    if (terminal_) {
      terminal_->beside(write);
    } else {
      write();
    }
  }
  std::size_t mistakes() const override { return mistakes_; }

 private:
  void run_at_terminal(TaskBrowser& browser);
  void run_by_pipe(TaskBrowser& browser);

  bool simulated_;
  std::unique_ptr<Terminal> terminal_;
  std::size_t mistakes_ = 0;
};

exec::RunEnd StandardBrowser::run(exec::Application& application, base::Duration duration,
                                  const platform::StopSignal* stop) {
  Pipe pipe;
  internal::Surface& surface = terminal_ ? static_cast<internal::Surface&>(*terminal_) : pipe;
  TaskBrowser browser(application, duration, stop, simulated_, surface);
  browser.idle();
  if (terminal_) {
    run_at_terminal(browser);
  } else {
    run_by_pipe(browser);
  }
  return browser.end();
}

void StandardBrowser::run_by_pipe(TaskBrowser& browser) {
  PipedLines lines;
  while (!browser.has_ended()) {
    const std::optional<std::string> line = lines.next(browser);
    if (!line) break;
    browser.take(*line);
  }
  if (browser.wants_more()) {
    write_line(stderr, "error: the input ends within a statement");
    ++mistakes_;
  }
  mistakes_ += browser.mistakes();
  browser.stop();
}

/// Ctrl-C empties the line; on an empty one it says how to leave, and a second one leaves: whoever
/// hammers on it wants the robot to stop.
void StandardBrowser::run_at_terminal(TaskBrowser& browser) {
  LineEditor editor({[&] { return browser.idle(); }, [&] { return terminal_->interrupted(); },
                     [&] { terminal_->take_interrupt(); },
                     [&](std::string_view before) { return browser.complete(before); }},
                    internal::history_file());
  terminal_->set_editor(&editor);
  terminal_->say("`help` says what there is to type; `quit` or Ctrl-D stops the application");
  bool warned = false;
  while (!browser.has_ended()) {
    std::string line;
    const LineEditor::Outcome outcome = editor.read(browser.prompt(), terminal_->paper(), line);
    const bool warned_before = std::exchange(warned, false);
    if (outcome == LineEditor::Outcome::kLine) {
      browser.take(line);
      continue;
    }
    const bool empty = line.empty() && !browser.wants_more();
    terminal_->say(outcome == LineEditor::Outcome::kInterrupted ? "^C" : "");
    browser.forget_lines();
    if (outcome == LineEditor::Outcome::kEnd || (empty && warned_before)) {
      browser.stop();
    } else if (empty) {
      terminal_->say("Ctrl-C again, Ctrl-D or `quit` stops the application");
      warned = true;
    }
  }
  terminal_->set_editor(nullptr);
}

}  // namespace
}  // namespace armature::script

extern "C" armature::script::Browser* armature_make_browser(bool simulated) {
  return new armature::script::StandardBrowser(simulated);
}
