// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/console.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <utility>

#include "armature/browser/internal/line_editor.hpp"
#include "armature/platform/printer.hpp"
#include "armature/platform/terminal.hpp"

namespace armature::browser::internal {

using platform::kStandardError;
using platform::kStandardInput;
using platform::kStandardOutput;

namespace {

constexpr int kUsualWidth = 80;
constexpr base::Duration kPipePeriod = std::chrono::milliseconds(20);

void write_line(int descriptor, std::string_view text) {
  platform::print(descriptor, std::string(text) + '\n');
}

/// Lines out and in, and nothing else.
class Pipe final : public Surface {
 public:
  Paper paper() const override { return {kUsualWidth, false}; }
  bool live() const override { return false; }
  void say(std::string_view text) override { write_line(kStandardOutput, text); }
  void complain(std::string_view text) override { write_line(kStandardError, text); }
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

}  // namespace

class Terminal final : public Surface {
 public:
  Paper paper() const override {
    return {static_cast<std::size_t>(platform::terminal_width(kStandardOutput, kUsualWidth)),
            colour_};
  }
  bool live() const override { return true; }
  void say(std::string_view text) override {
    beside([&] { write_line(kStandardOutput, text); });
  }
  void complain(std::string_view text) override {
    beside([&] { write_line(kStandardOutput, inked(paper(), Ink::kBad, text)); });
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
      const std::size_t columns = columns_of(rest.substr(0, end));
      write_line(kStandardOutput, rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
      rows_ += columns == 0 ? 1 : (columns + width - 1) / width;
    }
  }
  void erase() {
    if (rows_ == 0) return;
    platform::print(kStandardOutput, "\x1b[" + std::to_string(rows_) + "A\r\x1b[J");
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
  bool at_end() const { return at_end_ && text_.empty(); }
  /// Nothing at the end of the input, or of the run.
  std::optional<std::string> next(LineTaker& taker) {
    while (true) {
      const std::size_t end = text_.find('\n');
      if (end != std::string::npos) {
        std::string line = text_.substr(0, end);
        text_.erase(0, end + 1);
        return line;
      }
      if (at_end_ || !taker.idle()) return last();
      if (!platform::wait_readable(kStandardInput, kPipePeriod)) continue;
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

Console::Console() {
  if (platform::is_terminal(kStandardInput) && platform::is_terminal(kStandardOutput)) {
    auto terminal = std::make_unique<Terminal>();
    terminal_ = terminal.get();
    surface_ = std::move(terminal);
  } else {
    surface_ = std::make_unique<Pipe>();
    lines_ = std::make_unique<PipedLines>();
  }
}

Console::~Console() = default;

bool Console::at_end() const { return lines_ != nullptr && lines_->at_end(); }

std::size_t Console::run(LineTaker& taker, std::string_view quitting) {
  if (terminal_ == nullptr) return run_by_pipe(taker);
  run_at_terminal(taker, std::string(quitting));
  return 0;
}

void Console::beside(const std::function<void()>& write) {
  if (terminal_ != nullptr) {
    terminal_->beside(write);
  } else {
    write();
  }
}

std::size_t Console::run_by_pipe(LineTaker& taker) {
  while (!taker.has_ended()) {
    const std::optional<std::string> line = lines_->next(taker);
    if (!line) break;
    taker.take(*line);
  }
  const bool unfinished = taker.wants_more();
  if (unfinished) write_line(kStandardError, "error: the input ends within a statement");
  taker.stop();
  return taker.mistakes() + (unfinished ? 1 : 0);
}

/// Ctrl-C empties the line; on an empty one it says how to leave, and a second one leaves: whoever
/// hammers on it wants the robot to stop.
void Console::run_at_terminal(LineTaker& taker, const std::string& quitting) {
  LineEditor editor({[&] { return taker.idle(); }, [&] { return terminal_->interrupted(); },
                     [&] { terminal_->take_interrupt(); },
                     [&](std::string_view before) { return taker.complete(before); }},
                    history_file());
  terminal_->set_editor(&editor);
  terminal_->say("`help` lists what you can type; `quit` or Ctrl-D " + quitting);
  bool warned = false;
  while (!taker.has_ended()) {
    std::string line;
    const LineEditor::Outcome outcome = editor.read(taker.prompt(), terminal_->paper(), line);
    const bool warned_before = std::exchange(warned, false);
    if (outcome == LineEditor::Outcome::kLine) {
      taker.take(line);
      continue;
    }
    const bool empty = line.empty() && !taker.wants_more();
    terminal_->say(outcome == LineEditor::Outcome::kInterrupted ? "^C" : "");
    taker.forget_lines();
    if (outcome == LineEditor::Outcome::kEnd || (empty && warned_before)) {
      taker.stop();
    } else if (empty) {
      terminal_->say("Ctrl-C again, Ctrl-D or `quit` " + quitting);
      warned = true;
    }
  }
  terminal_->set_editor(nullptr);
}

}  // namespace armature::browser::internal
