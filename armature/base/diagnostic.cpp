// SPDX-License-Identifier: Apache-2.0
#include "armature/base/diagnostic.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "armature/base/severity_name.hpp"
#include "armature/base/visible_text.hpp"

namespace armature::base {

std::string_view name_of(Severity severity) {
  switch (severity) {
    case Severity::kNote:
      return "note";
    case Severity::kWarning:
      return "warning";
    case Severity::kError:
      return "error";
  }
  return "error";
}

namespace {

std::string place(const Location& where) {
  if (where.file.empty()) return {};
  std::string text = where.file;
  if (where.line > 0) text += ":" + std::to_string(where.line);
  if (where.line > 0 && where.column > 0) text += ":" + std::to_string(where.column);
  return text + ": ";
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// `text` with each number as `#`.
std::string without_numbers(std::string_view text) {
  std::string shape;
  bool in_number = false;
  for (const char c : text) {
    if (!is_digit(c)) shape += c;
    if (is_digit(c) && !in_number) shape += '#';
    in_number = is_digit(c);
  }
  return shape;
}

/// The next `'...'` at or after `from`, quotes included; empty if there is none.
std::string_view next_quoted(std::string_view text, std::size_t from) {
  const std::size_t begin = text.find('\'', from);
  if (begin == std::string_view::npos) return {};
  const std::size_t end = text.find('\'', begin + 1);
  return end == std::string_view::npos ? text.substr(begin) : text.substr(begin, end + 1 - begin);
}

/// The message without what it says of the single case: names in quotes and numbers.
std::string kind_of(const Diagnostic& diagnostic) {
  const std::string_view text = diagnostic.message;
  std::string kind(name_of(diagnostic.severity));
  std::size_t copied = 0;
  for (auto quoted = next_quoted(text, 0); !quoted.empty(); quoted = next_quoted(text, copied)) {
    const auto begin = static_cast<std::size_t>(quoted.data() - text.data());
    kind += without_numbers(text.substr(copied, begin - copied)) + "''";
    copied = begin + quoted.size();
  }
  return kind + without_numbers(text.substr(copied));
}

std::string place_and_shape(const Diagnostic& diagnostic) {
  return place(diagnostic.where) + std::string(name_of(diagnostic.severity)) +
         without_numbers(diagnostic.message);
}

/// The first part in quotes of `text` in which `other`, of the same shape, differs; empty if none.
std::string_view differing_name(std::string_view text, std::string_view other) {
  std::string_view mine = next_quoted(text, 0);
  std::string_view its = next_quoted(other, 0);
  while (!mine.empty() && mine == its) {
    mine = next_quoted(text, static_cast<std::size_t>(mine.data() - text.data()) + mine.size());
    its = next_quoted(other, static_cast<std::size_t>(its.data() - other.data()) + its.size());
  }
  return mine;
}

/// Has `kept` stand for `more`, too, and for those for which that one stands.
void join(Diagnostic& kept, const Diagnostic& more) {
  kept.unshown += more.unshown;
  const bool same = kept.message == more.message;
  const std::string name(differing_name(more.message, kept.message));
  Likewise& likewise = kept.likewise;
  if (likewise.count == 0) likewise.first = same ? more.likewise.first : name;
  if (!same) likewise.last = name;
  if (!more.likewise.last.empty()) likewise.last = more.likewise.last;
  likewise.count += (same ? 0 : 1) + more.likewise.count;
}

std::string to_text(const Likewise& likewise) {
  if (likewise.count == 0) return {};
  const bool named = !likewise.first.empty();
  if (likewise.count == 1 && named) return ", likewise " + likewise.first;
  const std::string count = std::to_string(likewise.count);
  const std::string others = ", likewise " + count + (likewise.count == 1 ? " other" : " others");
  return named ? others + ", " + likewise.first + " to " + likewise.last : others;
}

Diagnostic finding(Severity severity, Location where, std::string message, Hint hint) {
  Diagnostic found{severity, std::move(where), std::move(message), std::move(hint.text)};
  found.fix = std::move(hint.fix);
  return found;
}

}  // namespace

std::string to_text(const Diagnostic& diagnostic) {
  std::string text = place(diagnostic.where);
  text += name_of(diagnostic.severity);
  text += ": " + diagnostic.message + to_text(diagnostic.likewise);
  if (diagnostic.unshown > 0) {
    text += "; " + std::to_string(diagnostic.unshown) + " more are not shown";
  }
  if (!diagnostic.name.empty()) text += " [" + diagnostic.name + "]";
  if (!diagnostic.hint.empty()) text += " (" + diagnostic.hint + ")";
  return visible_text(text);
}

void Diagnostics::error(Location where, std::string message, Hint hint) {
  add(finding(Severity::kError, std::move(where), std::move(message), std::move(hint)));
}

void Diagnostics::warning(Location where, std::string message, Hint hint) {
  add(finding(Severity::kWarning, std::move(where), std::move(message), std::move(hint)));
}

void Diagnostics::named_warning(std::string_view name, Location where, std::string message,
                                Hint hint) {
  Diagnostic warning =
      finding(Severity::kWarning, std::move(where), std::move(message), std::move(hint));
  warning.name = name;
  add(std::move(warning));
}

bool Diagnostics::accept(std::string_view name) {
  bool found = false;
  for (Diagnostic& one : all_) {
    if (one.severity != Severity::kWarning || one.name.empty() || one.name != name) continue;
    found = true;
    one.severity = Severity::kNote;
    one.message = "accepted: " + one.message;
    one.hint.clear();
    one.fix.reset();
  }
  return found;
}

void Diagnostics::note(Location where, std::string message, Hint hint) {
  add(finding(Severity::kNote, std::move(where), std::move(message), std::move(hint)));
}

void Diagnostics::add(Diagnostic diagnostic) {
  if (diagnostic.severity == Severity::kError) ++errors_;
  put(std::move(diagnostic));
}

void Diagnostics::append(const Diagnostics& others) {
  for (const Diagnostic& one : others.all_) put(one);
  errors_ += others.errors_;
}

void Diagnostics::add_likewise(const Diagnostic& diagnostic) {
  Diagnostic* const like = find_like(diagnostic);
  if (like == nullptr) return;
  if (diagnostic.severity == Severity::kError) ++errors_;
  join(*like, diagnostic);
}

Diagnostic* Diagnostics::find_like(const Diagnostic& diagnostic) {
  if (diagnostic.where.line == 0) return nullptr;
  const auto found = by_place_.find(place_and_shape(diagnostic));
  return found == by_place_.end() ? nullptr : &all_[found->second];
}

void Diagnostics::put(Diagnostic diagnostic) {
  if (Diagnostic* const like = find_like(diagnostic)) return join(*like, diagnostic);
  const auto leave_out = [&](Diagnostic& last) {
    last.unshown += 1 + diagnostic.likewise.count + diagnostic.unshown;
  };
  if (all_.size() >= kMost) return leave_out(all_.back());
  Kind& kind = kinds_[kind_of(diagnostic)];
  if (kind.kept >= kMostOfAKind) return leave_out(all_[kind.last]);
  kind = {kind.kept + 1, all_.size()};
  if (diagnostic.where.line > 0) by_place_.emplace(place_and_shape(diagnostic), all_.size());
  all_.push_back(std::move(diagnostic));
}

std::string Diagnostics::to_text() const {
  std::vector<const Diagnostic*> ordered;
  for (const Diagnostic& one : all_) ordered.push_back(&one);
  // The address, last, keeps the order in which they were found.
  std::sort(ordered.begin(), ordered.end(), [](const Diagnostic* a, const Diagnostic* b) {
    return std::tie(a->where.file, a->where.line, a->where.column, a) <
           std::tie(b->where.file, b->where.line, b->where.column, b);
  });
  std::string text;
  for (const Diagnostic* one : ordered) text += base::to_text(*one) + "\n";
  return text;
}

}  // namespace armature::base
