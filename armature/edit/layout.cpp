// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/internal/layout.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "armature/document/value_tree.hpp"
#include "armature/edit/internal/scalar_text.hpp"

namespace armature::edit::internal {
namespace {

using document::Value;

constexpr std::size_t kUsualStep = 2;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

bool is_list_or_map(const Node& node) {
  return node.kind == Node::Kind::kList || node.kind == Node::Kind::kMap;
}

/// The item or key that `node` is, or is the value of.
const Node* first_of_element(const Node& node) {
  const Node* container = node.parent;
  if (container->kind == Node::Kind::kList) return &node;
  const auto at = std::find(container->children.begin(), container->children.end(), &node) -
                  container->children.begin();
  return container->children[static_cast<std::size_t>(at - at % 2)];
}

/// An empty list that overrides another says that there is nothing.
bool means_something_when_empty(const Node& container) {
  const Node* override =
      container.parent == nullptr ? nullptr : find_value(container.parent, "override");
  if (override == nullptr || override->text != "true") return false;
  const std::string& key = first_of_element(container)->text;
  return key != "properties" && key != "bind";  // which are overridden one by one
}

}  // namespace

std::string spaces(std::size_t count) { return std::string(count, ' '); }

bool is_in_flow(const Node& node) {
  for (const Node* around = node.parent; around != nullptr; around = around->parent) {
    if (around->flow) return true;
  }
  return false;
}

std::vector<Layout::Element> Layout::elements_of(const Node& container) const {
  std::vector<Element> elements;
  const std::size_t size = container.kind == Node::Kind::kMap ? 2 : 1;
  for (std::size_t i = 0; i + size <= container.children.size(); i += size) {
    const Node* first = container.children[i];
    const std::size_t end = std::max(first->end, container.children[i + size - 1]->end);
    elements.push_back({first, first->begin, end, removed_.contains(first)});
  }
  return elements;
}

void Layout::put(std::size_t begin, std::size_t end, std::string text) {
  replacements_.push_back({begin, end, std::move(text)});
}

std::size_t Layout::step() const {
  for (const Node& node : file_.nodes()) {
    const bool nested = node.kind == Node::Kind::kMap && !node.flow && node.parent == file_.root();
    if (nested && file_.column(node.begin) > 0) return file_.column(node.begin);
  }
  return kUsualStep;
}

std::size_t Layout::list_step() const {
  for (const Node& node : file_.nodes()) {
    const bool nested = node.kind == Node::Kind::kList && !node.flow && node.parent == file_.root();
    if (nested) return file_.column(node.begin);
  }
  return step();
}

std::string Layout::rendered(const std::string& beginning, const Value& value, std::size_t indent,
                             int levels) const {
  const bool is_map = value.kind == Value::Kind::kMap && !value.entries.empty();
  const bool is_list = value.kind == Value::Kind::kList && !value.items.empty();
  if (levels == 0 || (!is_map && !is_list)) {
    return beginning + (beginning.ends_with(' ') ? "" : " ") + written_in_block(value);
  }
  std::string text = beginning.substr(0, beginning.find_last_not_of(' ') + 1);
  const std::size_t inner = indent + (is_list ? list_step() : step());
  const std::string margin = std::string(file_.end_of_line()) + spaces(inner);
  for (const document::Property& entry : value.entries) {
    const std::string key = written_in_block(document::make_text(entry.name)) + ":";
    text += margin + rendered(key, entry.value, inner, levels - 1);
  }
  for (const Value& item : value.items) text += margin + rendered("-", item, inner, 0);
  return text;
}

/// The key with its colon and the blanks that put the value below those of its neighbours.
std::string Layout::aligned_key(const Node& map, const std::string& key) const {
  std::string text = written_in_block(document::make_text(key)) + ":";
  std::set<std::size_t> columns;
  std::size_t beside = 0;
  bool padded = false;
  for (std::size_t i = 0; i + 1 < map.children.size(); i += 2) {
    const Node& name = *map.children[i];
    const Node& value = *map.children[i + 1];
    if (value.is_empty() || file_.line_begin(name.begin) != file_.line_begin(value.begin)) continue;
    columns.insert(file_.column(value.begin));
    padded = padded || value.begin > name.end + 2;
    ++beside;
  }
  if (beside < 2 || columns.size() != 1 || !padded) return text;
  const std::size_t size = file_.column(map.begin) + text.size();
  return text + spaces(std::max<std::size_t>(*columns.begin(), size + 1) - size);
}

/// True if empty lines stand between the entries.
bool Layout::is_spaced(const std::vector<Element>& elements) const {
  if (elements.size() < 2) return false;
  const std::size_t begin = file_.line_end(elements[elements.size() - 2].end);
  const std::size_t end = file_.line_begin(elements.back().begin);
  const std::string between = file_.text().substr(begin, end - begin);
  return between.find("\n\n") != between.npos || between.find("\n\r\n") != between.npos;
}

void Layout::add_in_block(const Node& container, const Element& behind,
                          const std::string& rendered) {
  const std::string gap = is_spaced(elements_of(container)) ? std::string(file_.end_of_line()) : "";
  add_line_behind(behind.end, gap + spaces(file_.column(container.begin)) + rendered);
}

/// Behind the line of `offset`; the last line of a file may have no end.
void Layout::add_line_behind(std::size_t offset, const std::string& line) {
  const std::string end_of_line{file_.end_of_line()};
  const std::size_t newline = file_.text().find('\n', offset);
  if (newline != std::string::npos) return put(newline + 1, newline + 1, line + end_of_line);
  put(file_.text().size(), file_.text().size(), end_of_line + line);
}

void Layout::add_in_empty_flow(const Node& container, const std::string& text) {
  const std::size_t close = container.end - 1;
  const std::size_t open =
      file_.text().rfind(container.kind == Node::Kind::kMap ? '{' : '[', close);
  const std::string inside = file_.text().substr(open + 1, close - open - 1);
  const bool blank = std::all_of(inside.begin(), inside.end(), is_blank);
  put(blank ? open + 1 : close, close, text);
}

void Layout::add_in_flow(const Node& container, const std::string& text) {
  const std::vector<Element> elements = elements_of(container);
  if (elements.empty()) return add_in_empty_flow(container, text);
  const Element& last = elements.back();
  const std::size_t before = elements.size() > 1 ? elements[elements.size() - 2].end : last.begin;
  const bool own_lines = file_.line_begin(before) != file_.line_begin(last.begin);
  const std::string margin = std::string(file_.end_of_line()) + spaces(file_.column(last.begin));
  std::size_t at = last.end;
  while (at < container.end && is_blank(file_.text()[at])) ++at;
  const bool has_comma = file_.text()[at] == ',';
  const std::size_t behind = has_comma ? at + 1 : last.end;
  const std::size_t line_end = file_.line_end(behind);
  if (own_lines && line_end < container.end) {
    if (!has_comma) put(behind, behind, ",");
    put(line_end, line_end, margin + text + (has_comma ? "," : ""));
    return;
  }
  put(behind, behind,
      (has_comma ? "" : ",") + (own_lines ? margin : " ") + text + (has_comma ? "," : ""));
}

void Layout::add_entry(const Node& map, const std::string& key, const Value& value, int levels,
                       std::string_view after) {
  if (map.flow || map.children.empty()) {
    return add_in_flow(map,
                       written_in_flow(document::make_text(key)) + ": " + written_in_flow(value));
  }
  const std::vector<Element> elements = elements_of(map);
  auto behind = std::find_if(elements.begin(), elements.end(),
                             [&](const Element& one) { return one.first->text == after; });
  if (after.empty() || behind == elements.end()) behind = elements.end() - 1;
  add_in_block(map, *behind,
               rendered(aligned_key(map, key), value, file_.column(map.begin), levels));
}

void Layout::add_item(const Node& list, const Value& value) {
  if (list.flow || list.children.empty()) return add_in_flow(list, written_in_flow(value));
  add_in_block(list, elements_of(list).back(), rendered("-", value, file_.column(list.begin), 0));
}

void Layout::fill(const Node& empty, const Value& value, int levels) {
  if (!empty.is_empty()) return put(empty.begin, empty.end, written_in_flow(value));
  const Node* key = first_of_element(empty);
  const std::size_t at = levels > 0 ? file_.line_end(empty.begin) : empty.begin;
  put(at, at, rendered("", value, file_.column(key->begin), is_in_flow(empty) ? 0 : levels));
}

void Layout::begin_file(const std::string& key, const Value& value, int levels) {
  const std::string& text = file_.text();
  const std::string end_of_line{file_.end_of_line()};
  const bool on_line = !text.empty() && text.back() != '\n' && file_.column(text.size()) > 0;
  put(text.size(), text.size(),
      (on_line ? end_of_line : "") + rendered(key + ":", value, 0, levels) + end_of_line);
}

void Layout::replace(const Node& node, const Value& value) {
  const std::string text = text_in_place_of(node, value);
  const Node* key = node.parent == nullptr ? nullptr : first_of_element(node);
  const bool below = is_list_or_map(node) && !node.flow && key != nullptr && key != &node &&
                     file_.line_begin(key->begin) != file_.line_begin(node.begin);
  if (below) {
    const std::size_t colon = file_.text().find(':', key->end);
    put(colon + 1, colon + 1, " " + text);
    return remove_lines(node.begin, node.end);
  }
  const bool behind_colon = node.is_empty() && !is_blank(file_.text()[node.begin - 1]);
  put(node.begin, node.end, (behind_colon ? " " : "") + text);
}

void Layout::remove(const Node& node) { removed_.insert(first_of_element(node)); }

/// A list or map without content would be a mistake, or mean something else.
void Layout::let_empty_ones_go() {
  for (bool changed = true; changed;) {
    changed = false;
    for (const Node* one : std::vector<const Node*>(removed_.begin(), removed_.end())) {
      const Node* container = one->parent;
      const std::vector<Element> elements = elements_of(*container);
      const bool all = std::all_of(elements.begin(), elements.end(),
                                   [](const Element& element) { return element.removed; });
      if (!all || container->parent == nullptr || !removed_.contains(one)) continue;
      if (means_something_when_empty(*container)) continue;
      for (const Element& element : elements) removed_.erase(element.first);
      removed_.insert(first_of_element(*container));
      changed = true;
    }
  }
}

void Layout::remove_lines(std::size_t begin, std::size_t end) {
  const std::string& text = file_.text();
  std::size_t from = file_.line_begin(begin);
  const std::size_t newline = text.find('\n', end);
  if (newline != text.npos) return put(from, newline + 1, "");
  if (file_.column(from) == 0 && from > 0 && text[from - 1] == '\n') --from;
  if (from > 0 && text[from] == '\n' && text[from - 1] == '\r') --from;
  put(from, text.size(), "");
}

void Layout::remove_in_block(const Node& container, const std::vector<Element>& elements) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (!elements[i].removed) continue;
    const std::size_t line = file_.line_begin(elements[i].begin);
    const std::string before = file_.text().substr(line, elements[i].begin - line);
    const std::ptrdiff_t dashes = std::count(before.begin(), before.end(), '-');
    const bool shares_line = dashes > (container.kind == Node::Kind::kList ? 1 : 0);
    if (shares_line && i + 1 < elements.size()) {
      put(elements[i].begin, elements[i + 1].begin, "");
    } else {
      remove_lines(elements[i].begin, elements[i].end);
    }
  }
}

void Layout::remove_in_flow(const std::vector<Element>& elements) {
  const auto is_kept = [](const Element& element) { return !element.removed; };
  for (auto at = elements.begin(); at != elements.end();) {
    const auto first = std::find_if_not(at, elements.end(), is_kept);
    const auto kept = std::find_if(first, elements.end(), is_kept);
    if (first == elements.end()) return;
    if (first != elements.begin()) {
      const std::size_t begin = (first - 1)->end;
      const std::string between = file_.text().substr(begin, first->begin - begin);
      if (between.find('#') == between.npos) {
        put(begin, (kept - 1)->end, "");
      } else {  // the comment is about what stays
        const std::size_t comma = file_.text().find(',', begin);
        put(comma, comma + 1, "");
        put(first->begin, (kept - 1)->end, "");
      }
    } else if (kept != elements.end()) {
      put(first->begin, kept->begin, "");
    }
    at = kept;
  }
}

/// It loses all it has, and stays.
void Layout::empty(const Node& container) {
  if (!container.flow) {
    const bool is_map = container.kind == Node::Kind::kMap;
    return replace(container, is_map ? document::make_map() : document::make_list());
  }
  const std::vector<Element> elements = elements_of(container);
  put(elements.front().begin, elements.back().end, "");
}

std::vector<Replacement> Layout::take() {
  let_empty_ones_go();
  std::map<const Node*, std::vector<Element>> containers;
  for (const Node* one : removed_) containers.try_emplace(one->parent, elements_of(*one->parent));
  for (const auto& [container, elements] : containers) {
    const bool all = std::all_of(elements.begin(), elements.end(),
                                 [](const Element& element) { return element.removed; });
    if (all && (container->flow || container->parent != nullptr)) {
      empty(*container);
    } else if (container->flow) {
      remove_in_flow(elements);
    } else {
      remove_in_block(*container, elements);
    }
  }
  std::stable_sort(replacements_.begin(), replacements_.end(),
                   [](const Replacement& a, const Replacement& b) {
                     return std::pair(a.begin, a.end) < std::pair(b.begin, b.end);
                   });
  return std::move(replacements_);
}

}  // namespace armature::edit::internal
