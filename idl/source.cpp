// SPDX-License-Identifier: Apache-2.0
#include "idl/source.hpp"

#include <algorithm>
#include <cctype>
#include <tuple>
#include <utility>

#include "armature/base/utf8.hpp"
#include "armature/base/visible_text.hpp"

namespace armature::idl {
namespace {

constexpr std::size_t kLongestShownLine = 200;
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // editors put it in front of UTF-8

bool is_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::size_t offset_of_column(std::string_view line, int column) {
  std::size_t at = 0;
  for (int i = 1; i < column && at < line.size(); ++i) {
    const auto next = base::code_point_at(line, at);
    at = next ? next->end : at + 1;
  }
  return at;
}

/// Tabs stay tabs, so that the caret stands below its place however wide they are.
std::string blank(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '\t') result += '\t';
  }
  std::string without_tabs(text);
  std::erase(without_tabs, '\t');
  return result + std::string(base::columns_of(without_tabs), ' ');
}

std::string caret(std::string_view line, int column) {
  const std::size_t begin = offset_of_column(line, column);
  std::size_t end = begin;
  while (end < line.size() && is_of_word(line[end])) ++end;
  const std::size_t rest = end > begin ? end - begin - 1 : 0;
  return blank(base::visible_text(line.substr(0, begin))) + "^" + std::string(rest, '~');
}

std::string excerpt(const base::Location& where, const Source& source) {
  const std::string_view line = source.line(where.line);
  if (line.empty() || line.size() > kLongestShownLine) return {};
  return base::visible_text(line) + "\n" + caret(line, where.column) + "\n";
}

const Source* source_of(const base::Location& where, const std::vector<const Source*>& sources) {
  const auto found = std::find_if(sources.begin(), sources.end(), [&](const Source* source) {
    return source->file() == where.file;
  });
  return found == sources.end() ? nullptr : *found;
}

std::string to_text(base::Diagnostic one, const std::vector<const Source*>& sources) {
  const std::string hint = std::exchange(one.hint, {});
  std::string text = base::to_text(one) + "\n";
  const Source* source = source_of(one.where, sources);
  if (source != nullptr && one.where.line > 0) text += excerpt(one.where, *source);
  if (!hint.empty()) text += "    hint: " + base::visible_text(hint) + "\n";
  return text;
}

}  // namespace

Source::Source(std::string file, std::string text)
    : file_(std::move(file)), text_(std::move(text)), line_begins_{0} {
  if (text_.starts_with(kByteOrderMark)) text_.erase(0, kByteOrderMark.size());
  for (std::size_t i = 0; i < text_.size(); ++i) {
    if (text_[i] == '\n') line_begins_.push_back(i + 1);
  }
}

base::Location Source::location(std::size_t offset) const {
  offset = std::min(offset, text_.size());
  const auto after = std::upper_bound(line_begins_.begin(), line_begins_.end(), offset);
  const std::size_t begin = *std::prev(after);
  int column = 1;
  for (std::size_t at = begin; at < offset; ++column) {
    const auto next = base::code_point_at(text_, at);
    at = next ? next->end : at + 1;
  }
  return {file_, static_cast<int>(after - line_begins_.begin()), column};
}

std::string_view Source::line(int number) const {
  if (number < 1 || static_cast<std::size_t>(number) > line_begins_.size()) return {};
  const std::size_t begin = line_begins_[static_cast<std::size_t>(number) - 1];
  std::string_view line = std::string_view(text_).substr(begin);
  line = line.substr(0, line.find('\n'));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::string to_text(const base::Diagnostics& diagnostics,
                    const std::vector<const Source*>& sources) {
  std::vector<base::Diagnostic> ordered = diagnostics.all();
  std::stable_sort(ordered.begin(), ordered.end(), [](const auto& a, const auto& b) {
    return std::tie(a.where.file, a.where.line, a.where.column) <
           std::tie(b.where.file, b.where.line, b.where.column);
  });
  std::string text;
  for (const base::Diagnostic& one : ordered) text += to_text(one, sources);
  return text;
}

}  // namespace armature::idl
