// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "armature/edit/internal/element_text.hpp"
#include "armature/edit/internal/layout.hpp"
#include "armature/edit/internal/scalar_text.hpp"

namespace armature::edit::internal {
namespace {

std::string margin_of(std::size_t column) { return std::string(column, ' '); }

}  // namespace

/// What stands between two elements that are written one after the other.
std::string Layout::separator_behind(const Node& container) const {
  const std::vector<Element> elements = elements_of(container);
  const std::string margin =
      std::string(file_.end_of_line()) + margin_of(file_.column(container.begin));
  if (!container.flow)
    return is_spaced(elements) ? std::string(file_.end_of_line()) + margin : margin;
  const bool lines = elements.size() > 1 &&
                     file_.line_begin(elements[0].begin) != file_.line_begin(elements[1].begin);
  if (!lines) return ", ";
  return "," + std::string(file_.end_of_line()) + margin_of(file_.column(elements[1].begin));
}

void Layout::replace_element(const Node& first, const std::vector<std::string>& texts) {
  const Node& container = *first.parent;
  const std::size_t end = std::max(first.end, value_of_element(first).end);
  put(first.begin, end, texts.front());
  if (texts.size() == 1) return;
  const std::string separator = separator_behind(container);
  std::string others;
  for (std::size_t i = 1; i < texts.size(); ++i) others += separator + texts[i];
  const std::size_t behind = container.flow ? end : file_.line_end(end);
  put(behind, behind, others);
}

void Layout::replace_with_comments(const Node& first, const std::string& text) {
  if (first.parent->flow) return replace_element(first, {text});
  const std::size_t end = std::max(first.end, value_of_element(first).end);
  put(begin_with_comments(file_, first), file_.line_end(end), text);
}

void Layout::remove_with_comments(const Node& first) {
  remove(first);
  if (first.parent->flow) return;
  const std::size_t begin = file_.line_begin(begin_with_comments(file_, first));
  const std::size_t own = file_.line_begin(first.begin);
  if (begin < own) put(begin, own, "");
}

void Layout::add_entry_text(const Node& map, const std::string& text, std::string_view after) {
  const std::vector<Element> elements = elements_of(map);
  auto behind = std::find_if(elements.begin(), elements.end(),
                             [&](const Element& one) { return one.first->text == after; });
  if (behind == elements.end()) behind = elements.end() - 1;
  add_in_block(map, *behind, text);
}

void Layout::add_item_texts(const Node& list, const std::vector<std::string>& texts) {
  const bool in_brackets = list.flow || list.children.empty();
  std::string all;
  for (const std::string& text : texts) {
    if (in_brackets) all += (all.empty() ? "" : ", ") + text;
    const std::string margin =
        std::string(file_.end_of_line()) + margin_of(file_.column(list.begin));
    if (!in_brackets) all += (all.empty() ? "- " : margin + "- ") + text;
  }
  if (in_brackets) return add_in_flow(list, all);
  add_in_block(list, elements_of(list).back(), all);
}

void Layout::insert_item(const Node& list, std::size_t index, const document::Value& value) {
  const std::vector<Element> elements = elements_of(list);
  if (index >= elements.size()) return add_item(list, value);
  const std::size_t at = elements[index].begin;
  if (list.flow) return put(at, at, written_in_flow(value) + separator_behind(list));
  const std::string margin = margin_of(file_.column(list.begin)) + "- ";
  const std::string text = written_in_block(value);
  if (index > 0) return add_line_behind(elements[index - 1].end, margin + text);
  put(at, at, text + std::string(file_.end_of_line()) + margin);
}

void Layout::add_section_text(const Node& key, const std::string& text) {
  const std::size_t own = file_.line_begin(key.begin);
  const std::size_t above = file_.line_begin(begin_with_comments(file_, key));
  const std::size_t at = above == file_.line_begin(0) ? own : above;
  const std::string end_of_line{file_.end_of_line()};
  const bool spaced =
      at > 0 && file_.line_end(file_.line_begin(at - 1)) == file_.line_begin(at - 1);
  put(at, at, text + end_of_line + (spaced ? end_of_line : ""));
}

void Layout::remove_section(const Node& key) {
  remove(key);
  const std::size_t begin = file_.line_begin(key.begin);
  const std::size_t next = file_.text().find('\n', value_of_element(key).end);
  if (next == std::string::npos || next + 1 >= file_.text().size()) return;
  const bool blank_before =
      begin == 0 || file_.line_end(file_.line_begin(begin - 1)) == file_.line_begin(begin - 1);
  const bool blank_behind = file_.line_end(next + 1) == next + 1;
  if (blank_before && blank_behind) put(next + 1, file_.text().find('\n', next + 1) + 1, "");
}

}  // namespace armature::edit::internal
