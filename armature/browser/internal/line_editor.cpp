// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/line_editor.hpp"

#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <cwchar>
#include <filesystem>
#include <optional>
#include <system_error>

#include <histedit.h>

#include "armature/platform/printer.hpp"
#include "armature/platform/terminal.hpp"

namespace armature::browser::internal {

struct LineEditor::State {
  Typing typing;
  std::string file;
  std::string prompt;
  EditLine* editor = nullptr;
  History* history = nullptr;
  bool typing_now = false;
  bool interrupted = false;
  int width = 0;
};

namespace {

using Editing = LineEditor::State;

constexpr int kMostLines = 1000;
constexpr char kEscapeMark = '\1';
constexpr char kEndOfInput = '\4';
constexpr base::Duration kIdlePeriod = std::chrono::milliseconds(20);

Editing& state_of(EditLine* editor) {
  void* data = nullptr;
  el_get(editor, EL_CLIENTDATA, &data);
  return *static_cast<Editing*>(data);
}

/// libedit holds each character as a wide one, of whichever locale there is.
void make_characters_utf8() {
  const char* const name = std::setlocale(LC_CTYPE, "");
  const bool good = name != nullptr && std::strstr(name, "UTF-8") != nullptr;
  if (!good) std::setlocale(LC_CTYPE, "C.UTF-8");
}

char* prompt_of(EditLine* editor) { return state_of(editor).prompt.data(); }

/// A character more of one that takes several bytes; nothing if it is whole or none.
std::optional<wchar_t> add_byte(char byte, std::mbstate_t& parts) {
  wchar_t character = 0;
  const std::size_t result = std::mbrtowc(&character, &byte, 1, &parts);
  if (result == static_cast<std::size_t>(-2)) return std::nullopt;
  if (result == static_cast<std::size_t>(-1)) {
    parts = {};
    return L'?';
  }
  return character;
}

/// Gives libedit the next character; meanwhile the application goes on.
int next_character(EditLine* editor, wchar_t* character) {
  Editing& state = state_of(editor);
  std::mbstate_t parts{};
  while (true) {
    if (!state.typing.idle()) return 0;
    if (state.typing.interrupted()) {
      state.typing.forget_interrupt();
      state.interrupted = true;
      return 0;
    }
    const int width = platform::terminal_width(platform::kStandardOutput, 80);
    if (std::exchange(state.width, width) != width) el_resize(editor);
    const bool typed = platform::wait_readable(platform::kStandardInput, kIdlePeriod);
    if (!typed || state.typing.interrupted()) continue;
    const auto byte = platform::read_some(platform::kStandardInput, 1);
    if (!byte) continue;
    if (byte->empty()) return 0;
    // What Ctrl-D left in the terminal that was typed ahead, before the line was edited.
    const char typed_byte = byte->front() == '\0' ? kEndOfInput : byte->front();
    if (const auto whole = add_byte(typed_byte, parts)) {
      *character = *whole;
      return 1;
    }
  }
}

/// libedit writes past the printer: what was printed before comes first, unless the terminal
/// blocks.
void let_catch_up() { platform::Printer::flush(std::chrono::milliseconds(50)); }

void erase_line(const Editing& state) {
  const LineInfo* const line = el_line(state.editor);
  const auto before = static_cast<std::size_t>(line->cursor - line->buffer);
  std::string prompt;
  bool escape = false;
  for (const char c : state.prompt) {
    if (c == kEscapeMark) {
      escape = !escape;
    } else if (!escape) {
      prompt += c;
    }
  }
  const std::size_t columns = columns_of(prompt) + columns_of({line->buffer, before});
  const std::size_t rows = state.width > 0 ? columns / static_cast<std::size_t>(state.width) : 0;
  std::string text;
  if (rows > 0) text = "\x1b[" + std::to_string(rows) + "A";
  platform::print(platform::kStandardOutput, text + "\r\x1b[J");
}

unsigned char list_words(const Editing& state, const Completion& completion) {
  const Paper paper{static_cast<std::size_t>(state.width > 0 ? state.width : 80), false};
  platform::print(platform::kStandardOutput, "\n" + in_columns(paper, completion.words) + "\n");
  let_catch_up();
  return CC_REDISPLAY;
}

unsigned char complete_word(EditLine* editor, int) {
  Editing& state = state_of(editor);
  const LineInfo* const line = el_line(editor);
  const std::string_view before(line->buffer,
                                static_cast<std::size_t>(line->cursor - line->buffer));
  const Completion completion = state.typing.complete(before);
  if (completion.words.empty()) return CC_ERROR;
  const std::string common = completion.common();
  const std::string_view typed = before.substr(completion.begin);
  if (common == typed) {
    return completion.words.size() == 1 ? CC_NORM : list_words(state, completion);
  }
  std::string_view missing = common;
  if (common.starts_with(typed)) {
    missing.remove_prefix(typed.size());
  } else if (common.empty()) {
    return list_words(state, completion);
  } else {
    el_deletestr(editor, static_cast<int>(columns_of(typed)));
  }
  if (el_insertstr(editor, std::string(missing).c_str()) != 0) return CC_ERROR;
  return CC_REFRESH;
}

/// libedit forgets a colour that no character follows.
std::string with_marked_colour(const Paper& paper, const std::string& prompt) {
  if (!paper.colour) return prompt;
  const std::string mark(1, kEscapeMark);
  return mark + "\x1b[1m" + mark + prompt.substr(0, prompt.size() - 1) + mark + "\x1b[0m" + mark +
         prompt.back();
}

}  // namespace

LineEditor::LineEditor(Typing typing, std::string file) : state_(std::make_unique<Editing>()) {
  make_characters_utf8();
  Editing& state = *state_;
  state.typing = std::move(typing);
  state.file = std::move(file);
  state.editor = el_init("armature", stdin, stdout, stderr);
  state.history = history_init();
  HistEvent event{};
  history(state.history, &event, H_SETSIZE, kMostLines);
  history(state.history, &event, H_SETUNIQUE, 1);
  if (!state.file.empty()) history(state.history, &event, H_LOAD, state.file.c_str());
  el_set(state.editor, EL_CLIENTDATA, &state);
  el_set(state.editor, EL_EDITOR, "emacs");
  el_set(state.editor, EL_SIGNAL, 0);
  el_set(state.editor, EL_PROMPT_ESC, &prompt_of, kEscapeMark);
  el_set(state.editor, EL_HIST, history, state.history);
  el_set(state.editor, EL_GETCFN, &next_character);
  // The narrow el_set would copy both texts, and never free them.
  el_wset(state.editor, EL_ADDFN, L"armature-complete", L"completes a name", &complete_word);
  el_set(state.editor, EL_BIND, "^I", "armature-complete", nullptr);
  el_set(state.editor, EL_BIND, "^R", "em-inc-search-prev", nullptr);
  el_set(state.editor, EL_BIND, "^W", "ed-delete-prev-word", nullptr);
  el_set(state.editor, EL_BIND, "\\e[3~", "ed-delete-next-char", nullptr);
  el_set(state.editor, EL_BIND, "\\e[H", "ed-move-to-beg", nullptr);
  el_set(state.editor, EL_BIND, "\\e[F", "ed-move-to-end", nullptr);
  el_set(state.editor, EL_BIND, "\\e[1~", "ed-move-to-beg", nullptr);
  el_set(state.editor, EL_BIND, "\\e[4~", "ed-move-to-end", nullptr);
}

LineEditor::~LineEditor() {
  HistEvent event{};
  if (!state_->file.empty()) {
    std::error_code failure;
    std::filesystem::create_directories(std::filesystem::path(state_->file).parent_path(), failure);
    history(state_->history, &event, H_SAVE, state_->file.c_str());
  }
  history_end(state_->history);
  el_end(state_->editor);
}

LineEditor::Outcome LineEditor::read(const std::string& prompt, const Paper& paper,
                                     std::string& line) {
  Editing& state = *state_;
  state.prompt = with_marked_colour(paper, prompt);
  state.width = platform::terminal_width(platform::kStandardOutput, 80);
  state.interrupted = false;
  state.typing_now = true;
  let_catch_up();
  int count = 0;
  const char* const typed = el_gets(state.editor, &count);
  // A signal, Ctrl-C for one, ends a write of libedit's, which is no error: what is left goes with
  // the next write, and that fails, too, when the terminal is gone.
  std::clearerr(stdout);
  state.typing_now = false;
  if (typed == nullptr || count <= 0) {
    const LineInfo* const rest = el_line(state.editor);
    line.assign(rest->buffer, static_cast<std::size_t>(rest->lastchar - rest->buffer));
    return state.interrupted ? Outcome::kInterrupted : Outcome::kEnd;
  }
  line.assign(typed, static_cast<std::size_t>(count));
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.pop_back();
  HistEvent event{};
  if (line.find_first_not_of(' ') != std::string::npos) {
    history(state.history, &event, H_ENTER, line.c_str());
  }
  return Outcome::kLine;
}

void LineEditor::beside(const std::function<void()>& write) {
  if (!state_->typing_now) {
    write();
    return;
  }
  erase_line(*state_);
  write();
  let_catch_up();
  el_set(state_->editor, EL_REFRESH);
}

std::string history_file() {
  if (const char* const state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state == '/') {
    return std::string(state) + "/armature/history";
  }
  const char* const home = std::getenv("HOME");
  if (home == nullptr || *home == '\0') return {};
  return std::string(home) + "/.local/state/armature/history";
}

}  // namespace armature::browser::internal
