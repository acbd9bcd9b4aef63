// SPDX-License-Identifier: Apache-2.0
#include "armature/base/diagnostic.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace armature::base {
namespace {

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

std::string place(const Location& where) {
  if (where.file.empty()) return {};
  std::string text = where.file;
  if (where.line > 0) text += ":" + std::to_string(where.line);
  if (where.line > 0 && where.column > 0) text += ":" + std::to_string(where.column);
  return text + ": ";
}

}  // namespace

std::string to_text(const Diagnostic& diagnostic) {
  std::string text = place(diagnostic.where);
  text += name_of(diagnostic.severity);
  text += ": " + diagnostic.message;
  if (!diagnostic.hint.empty()) text += " (" + diagnostic.hint + ")";
  return text;
}

void Diagnostics::error(Location where, std::string message, std::string hint) {
  add({Severity::kError, std::move(where), std::move(message), std::move(hint)});
}

void Diagnostics::warning(Location where, std::string message, std::string hint) {
  add({Severity::kWarning, std::move(where), std::move(message), std::move(hint)});
}

void Diagnostics::note(Location where, std::string message, std::string hint) {
  add({Severity::kNote, std::move(where), std::move(message), std::move(hint)});
}

void Diagnostics::add(Diagnostic diagnostic) {
  if (diagnostic.severity == Severity::kError) ++errors_;
  all_.push_back(std::move(diagnostic));
}

void Diagnostics::append(const Diagnostics& others) {
  all_.insert(all_.end(), others.all_.begin(), others.all_.end());
  errors_ += others.errors_;
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
