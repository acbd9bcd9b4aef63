// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/source_text.hpp"

#include <algorithm>
#include <utility>

#include <yaml.h>

namespace armature::edit {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

/// Byte offsets of characters, which are what libyaml counts.
class CharacterOffsets {
 public:
  explicit CharacterOffsets(std::string_view text) {
    const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; };
    if (std::none_of(text.begin(), text.end(), continues)) return;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (!continues(text[i])) begins_.push_back(i);
    }
    begins_.push_back(text.size());
  }

  std::size_t at(std::size_t character) const {
    return begins_.empty() ? character : begins_[std::min(character, begins_.size() - 1)];
  }

 private:
  std::vector<std::size_t> begins_;  ///< empty: every character is a byte
};

Node::Style style_of(yaml_scalar_style_t style) {
  switch (style) {
    case YAML_SINGLE_QUOTED_SCALAR_STYLE:
      return Node::Style::kSingleQuoted;
    case YAML_DOUBLE_QUOTED_SCALAR_STYLE:
      return Node::Style::kDoubleQuoted;
    case YAML_LITERAL_SCALAR_STYLE:
    case YAML_FOLDED_SCALAR_STYLE:
      return Node::Style::kBlock;
    default:
      return Node::Style::kPlain;
  }
}

std::string text_of(const yaml_char_t* text) {
  return text == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(text));
}

}  // namespace

/// Makes the nodes of libyaml's events.
class TreeReader {
 public:
  TreeReader(SourceText& source, base::Diagnostics& diagnostics)
      : source_(source),
        diagnostics_(diagnostics),
        offsets_(std::string_view(source.text_).substr(source.mark_size_)) {
    yaml_parser_initialize(&parser_);
    const std::string_view text = std::string_view(source.text_).substr(source.mark_size_);
    yaml_parser_set_encoding(&parser_, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&parser_, reinterpret_cast<const unsigned char*>(text.data()),
                                 text.size());
  }
  TreeReader(const TreeReader&) = delete;
  TreeReader& operator=(const TreeReader&) = delete;
  ~TreeReader() { yaml_parser_delete(&parser_); }

  bool read() {
    for (bool done = false; !done;) {
      yaml_event_t event;
      if (yaml_parser_parse(&parser_, &event) == 0) return refuse();
      done = event.type == YAML_STREAM_END_EVENT;
      add(event);
      yaml_event_delete(&event);
    }
    return true;
  }

 private:
  bool refuse() {
    const std::size_t at = offset(parser_.problem_mark);
    Node node;
    node.begin = at;
    diagnostics_.error(source_.place_of(node),
                       std::string("libyaml cannot read the file: ") +
                           (parser_.problem == nullptr ? "no memory" : parser_.problem),
                       "write it so that YAML 1.1 and 1.2 agree; armature edit needs both");
    return false;
  }

  std::size_t offset(const yaml_mark_t& mark) const {
    return std::min(source_.mark_size_ + offsets_.at(mark.index), source_.text_.size());
  }

  void add(const yaml_event_t& event) {
    switch (event.type) {
      case YAML_SCALAR_EVENT:
        add_scalar(event);
        break;
      case YAML_ALIAS_EVENT:
        put(event, Node::Kind::kAlias).text = text_of(event.data.alias.anchor);
        break;
      case YAML_SEQUENCE_START_EVENT: {
        const auto& data = event.data.sequence_start;
        open(event, Node::Kind::kList, data.style == YAML_FLOW_SEQUENCE_STYLE, data.anchor);
        break;
      }
      case YAML_MAPPING_START_EVENT: {
        const auto& data = event.data.mapping_start;
        open(event, Node::Kind::kMap, data.style == YAML_FLOW_MAPPING_STYLE, data.anchor);
        break;
      }
      case YAML_SEQUENCE_END_EVENT:
      case YAML_MAPPING_END_EVENT:
        close(event);
        break;
      default:
        break;
    }
  }

  void add_scalar(const yaml_event_t& event) {
    const auto& data = event.data.scalar;
    Node& node = put(event, Node::Kind::kScalar);
    node.style = style_of(data.style);
    node.anchor = text_of(data.anchor);
    node.text.assign(reinterpret_cast<const char*>(data.value), data.length);
    if (node.style == Node::Style::kBlock) trim(node);
  }

  /// libyaml ends a block scalar where the next thing begins.
  void trim(Node& node) const {
    constexpr std::string_view kBlanks = " \t\r\n";
    while (node.end > node.begin && kBlanks.find(source_.text_[node.end - 1]) != kBlanks.npos) {
      --node.end;
    }
  }

  Node& put(const yaml_event_t& event, Node::Kind kind) {
    Node& node = source_.nodes_.emplace_back();
    node.kind = kind;
    node.begin = offset(event.start_mark);
    node.end = offset(event.end_mark);
    node.parent = open_;
    if (open_ != nullptr) {
      open_->children.push_back(&node);
    } else {
      source_.root_ = &node;
    }
    return node;
  }

  void open(const yaml_event_t& event, Node::Kind kind, bool flow, const yaml_char_t* anchor) {
    Node& node = put(event, kind);
    node.flow = flow;
    node.anchor = text_of(anchor);
    open_ = &node;
  }

  void close(const yaml_event_t& event) {
    if (open_->flow) {
      open_->end = offset(event.end_mark);
    } else if (!open_->children.empty()) {
      open_->end = std::max(open_->end, open_->children.back()->end);
    }
    open_ = open_->parent;
  }

  SourceText& source_;
  base::Diagnostics& diagnostics_;
  CharacterOffsets offsets_;
  yaml_parser_t parser_{};
  Node* open_ = nullptr;
};

SourceText::SourceText(std::string path, std::string text, base::Diagnostics& diagnostics)
    : path_(std::move(path)),
      text_(std::move(text)),
      mark_size_(text_.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0),
      lines_(std::string_view(text_).substr(mark_size_), path_) {
  if (TreeReader(*this, diagnostics).read()) return;
  nodes_.clear();
  root_ = nullptr;
}

base::Location SourceText::place_of(const Node& node) const {
  return lines_.at(node.begin - std::min(node.begin, mark_size_));
}

std::size_t SourceText::line_begin(std::size_t offset) const {
  const std::size_t before = offset == 0 ? text_.npos : text_.rfind('\n', offset - 1);
  return before == text_.npos ? mark_size_ : before + 1;
}

std::size_t SourceText::line_end(std::size_t offset) const {
  const std::size_t end = std::min(text_.find('\n', offset), text_.size());
  const bool with_return = end > offset && end < text_.size() && text_[end - 1] == '\r';
  return with_return ? end - 1 : end;
}

std::string_view SourceText::end_of_line() const {
  const std::size_t first = text_.find('\n');
  const bool with_return = first != text_.npos && first > 0 && text_[first - 1] == '\r';
  return with_return ? "\r\n" : "\n";
}

const Node* find_key(const Node* map, std::string_view key) {
  if (map == nullptr || map->kind != Node::Kind::kMap) return nullptr;
  for (std::size_t i = 0; i + 1 < map->children.size(); i += 2) {
    const Node* found = map->children[i];
    if (found->kind == Node::Kind::kScalar && found->text == key) return found;
  }
  return nullptr;
}

const Node* find_value(const Node* map, std::string_view key) {
  const Node* found = find_key(map, key);
  if (found == nullptr) return nullptr;
  const auto at = std::find(map->children.begin(), map->children.end(), found);
  return *(at + 1);
}

std::vector<const Node*> items_of(const Node* node) {
  if (node == nullptr || node->is_empty()) return {};
  if (node->kind == Node::Kind::kList) return {node->children.begin(), node->children.end()};
  return {node};
}

}  // namespace armature::edit
