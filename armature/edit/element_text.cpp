// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/internal/element_text.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "armature/edit/internal/scalar_text.hpp"
#include "armature/edit/replacement.hpp"

namespace armature::edit::internal {
namespace {

/// Collects what is different in a copy.
class CopyWriter {
 public:
  CopyWriter(const SourceText& file, const CopyChanges& changes) : file_(file), changes_(changes) {}

  void visit(const Node& node) {
    if (is_literal(file_, node)) return;
    if (!node.anchor.empty() && !changes_.anchors) drop_anchor(node);
    if (node.kind == Node::Kind::kScalar && changes_.new_value) rewrite(node);
    for (const Node* child : node.children) visit(*child);
  }

  std::vector<Replacement> take() {
    std::ranges::sort(replacements_, std::less<>(), &Replacement::begin);
    return std::move(replacements_);
  }

 private:
  void drop_anchor(const Node& node) {
    const std::string mark = "&" + node.anchor;
    const std::size_t begin = file_.text().find(mark, node.begin);
    std::size_t end = begin + mark.size();
    while (end < file_.text().size() && file_.text()[end] == ' ') ++end;
    replacements_.push_back({begin, end, {}});
  }

  void rewrite(const Node& node) {
    const std::optional<document::Value> value = changes_.new_value(node);
    if (!value) return;
    const std::string raw = file_.text().substr(node.begin, node.end - node.begin);
    const std::size_t blank = raw.find(' ');
    const std::size_t tag = raw.starts_with('!') && blank != raw.npos ? blank + 1 : 0;
    replacements_.push_back({node.begin + tag, node.end, text_in_place_of(node, *value)});
  }

  const SourceText& file_;
  const CopyChanges& changes_;
  std::vector<Replacement> replacements_;
};

bool is_comment_at(const SourceText& file, std::size_t line, std::size_t column) {
  const std::string_view text(file.text());
  const std::string_view begin = text.substr(line, file.line_end(line) - line);
  return begin.size() > column && begin.find_first_not_of(' ') == column && begin[column] == '#';
}

}  // namespace

bool is_literal(const SourceText& file, const Node& node) {
  return std::string_view(file.text()).substr(node.begin).starts_with("!literal");
}

const Node& value_of_element(const Node& first) {
  const Node& container = *first.parent;
  if (container.kind != Node::Kind::kMap) return first;
  return **(std::find(container.children.begin(), container.children.end(), &first) + 1);
}

std::size_t begin_with_comments(const SourceText& file, const Node& first) {
  const std::size_t column = file.column(first.parent->begin);
  std::size_t begin = file.line_begin(first.begin);
  if (first.parent->flow) return first.begin;
  while (begin > file.line_begin(0)) {
    const std::size_t above = file.line_begin(begin - 1);
    if (!is_comment_at(file, above, column)) break;
    begin = above;
  }
  return begin == file.line_begin(first.begin) ? first.begin : begin + column;
}

std::vector<std::string> comments_above(const SourceText& file, const Node& first) {
  std::vector<std::string> comments;
  if (first.parent->flow) return comments;
  const std::size_t own = file.line_begin(first.begin);
  std::size_t at = file.line_begin(begin_with_comments(file, first));
  for (; at < own; at = file.text().find('\n', at) + 1) {
    const std::string line = file.text().substr(at, file.line_end(at) - at);
    comments.push_back(line.substr(line.find('#')));
  }
  return comments;
}

std::string copied_element(const SourceText& file, const Node& first, const CopyChanges& changes) {
  const bool comment = changes.comment_behind && !first.parent->flow;
  const Node& value = value_of_element(first);
  const std::size_t begin = first.begin;
  const std::size_t last = std::max(first.end, value.end);
  const std::size_t end = comment ? file.line_end(last) : last;
  CopyWriter writer(file, changes);
  writer.visit(first);
  if (&value != &first) writer.visit(value);
  std::vector<Replacement> replacements = writer.take();
  for (Replacement& one : replacements) {
    one.begin -= begin;
    one.end -= begin;
  }
  return replaced(file.text().substr(begin, end - begin), replacements);
}

std::string moved_lines(const std::string& text, std::size_t from, std::size_t to) {
  std::string moved;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    std::string line = text.substr(at, end - at);
    const bool blank = line.find_first_not_of(" \r\n") == line.npos;
    if (at > 0 && !blank && to >= from) line.insert(0, to - from, ' ');
    if (at > 0 && !blank && to < from) {
      line.erase(0, std::min(from - to, line.find_first_not_of(' ')));
    }
    moved += line;
    at = end;
  }
  return moved;
}

}  // namespace armature::edit::internal
