// SPDX-License-Identifier: Apache-2.0
#include "armature/orocos/internal/xml_tree.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <system_error>
#include <utility>

#include <pugixml.hpp>

#include "armature/base/near_name.hpp"
#include "armature/document/source_text.hpp"
#include "armature/document/value_tree.hpp"

namespace armature::orocos {

using namespace document;
namespace {

constexpr std::string_view kPrefix = "armature:";

/// The character that `&#digits;` or `&#xdigits;` names, where XML has one (XML 1.0, "Char").
bool names_a_character(std::string_view digits) {
  const int base = digits.substr(0, 1) == "x" ? 16 : 10;
  if (base == 16) digits.remove_prefix(1);
  std::uint32_t code = 0;
  const auto [end, failure] =
      std::from_chars(digits.data(), digits.data() + digits.size(), code, base);
  if (failure != std::errc() || end != digits.data() + digits.size()) return false;
  if (code < 0x20) return !is_forbidden_control(static_cast<char>(code));
  const bool surrogate = code >= 0xd800 && code <= 0xdfff;
  return !surrogate && code != 0xfffe && code != 0xffff && code <= 0x10ffff;
}

/// False and an error at the first character reference that names no character. pugixml would make
/// another character of it, or none, and cut the text there. (It is refused in comments, too.)
bool check_character_references(std::string_view text, const LineIndex& lines,
                                base::Diagnostics& diagnostics) {
  for (std::size_t at = text.find("&#"); at != text.npos; at = text.find("&#", at + 2)) {
    const std::size_t end = text.find_first_not_of("0123456789abcdefABCDEFx", at + 2);
    const bool ends = end != text.npos && text[end] == ';';
    if (ends && names_a_character(text.substr(at + 2, end - at - 2))) continue;
    const std::size_t shown =
        std::min(end == text.npos ? text.size() : end + (ends ? 1 : 0), at + 24);
    diagnostics.error(lines.at(at),
                      in_quotes(text.substr(at, shown - at)) + " is not a character of XML",
                      "write & as &amp;");
    return false;
  }
  return true;
}

/// Builds the element tree from pugixml's nodes.
class XmlReader {
 public:
  XmlReader(LineIndex lines, const Limits& limits, base::Diagnostics& diagnostics)
      : lines_(std::move(lines)), limits_(limits), diagnostics_(diagnostics) {}

  base::Location at(std::ptrdiff_t offset) const {
    return lines_.at(offset < 0 ? 0 : static_cast<std::size_t>(offset));
  }

  std::optional<XmlElement> read_root(const pugi::xml_document& document) {
    std::optional<XmlElement> root;
    for (const pugi::xml_node node : document.children()) {
      if (node.type() == pugi::node_doctype) check_doctype(node);
      if (node.type() != pugi::node_element) continue;
      if (std::string_view(node.name()) != "properties" || root) {
        diagnostics_.error(place(node), "the file must have one element 'properties', found " +
                                            in_quotes(node.name()));
        return std::nullopt;
      }
      root = read(node, 1);
    }
    return abandoned_ ? std::nullopt : std::move(root);
  }

 private:
  base::Location place(const pugi::xml_node& node) const {
    return at(node.offset_debug() - (node.type() == pugi::node_element ? 1 : 0));
  }

  void check_doctype(const pugi::xml_node& node) {
    if (std::string_view(node.value()).find('[') == std::string_view::npos) return;
    diagnostics_.error(place(node), "declarations in the document type are not read",
                       "write only <!DOCTYPE properties SYSTEM \"cpf.dtd\">");
  }

  bool within_limits(const pugi::xml_node& node, int depth) {
    ++nodes_;
    if (abandoned_) return false;
    if (depth <= limits_.depth && nodes_ <= limits_.nodes) return true;
    abandoned_ = true;
    diagnostics_.error(
        place(node),
        depth > limits_.depth
            ? "elements are nested more than " + std::to_string(limits_.depth) + " deep"
            : "the file has more than " + std::to_string(limits_.nodes) + " elements");
    return false;
  }

  XmlElement read(const pugi::xml_node& node, int depth) {
    XmlElement element;
    element.where = place(node);
    if (!within_limits(node, depth)) return element;
    const std::string_view tag = node.name();
    element.kind = tag == "simple"     ? XmlElement::Kind::kSimple
                   : tag == "sequence" ? XmlElement::Kind::kSequence
                                       : XmlElement::Kind::kStruct;
    read_attributes(node, element);
    bool has_value = false;
    for (const pugi::xml_node child : node.children()) {
      read_child(child, depth, element, has_value);
    }
    if (element.is_simple() && !has_value && !abandoned_) {
      diagnostics_.error(element.where, "simple " + in_quotes(element.name) + " has no <value>");
    }
    return element;
  }

  void read_attributes(const pugi::xml_node& node, XmlElement& element) {
    for (const pugi::xml_attribute attribute : node.attributes()) {
      const std::string_view name = attribute.name();
      if (name == "name") {
        element.name = attribute.value();
      } else if (name == "type") {
        element.type = attribute.value();
      } else if (name.substr(0, kPrefix.size()) == kPrefix) {
        element.extras.emplace_back(name.substr(kPrefix.size()), attribute.value());
      } else if (name.substr(0, 5) != "xmlns" && name.substr(0, 4) != "xsi:") {
        diagnostics_.error(element.where, "unknown attribute " + in_quotes(name),
                           base::suggestion(name, {"name", "type"}));
      }
    }
  }

  void read_child(const pugi::xml_node& child, int depth, XmlElement& element, bool& has_value) {
    if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) {
      if (const std::string_view text = trimmed(child.value()); !text.empty()) {
        diagnostics_.error(place(child), "text " + in_quotes(text) + " outside <value>");
      }
      return;
    }
    if (child.type() != pugi::node_element) return;
    const std::string_view tag = child.name();
    if (tag == "description") {
      element.description = text_in(child);
    } else if (tag == "value" && element.is_simple() && !has_value) {
      element.text = text_in(child);
      has_value = true;
    } else if ((tag == "simple" || tag == "struct" || tag == "sequence") && !element.is_simple()) {
      element.children.push_back(read(child, depth + 1));
    } else {
      diagnostics_.error(
          place(child), "unexpected element " + in_quotes(tag),
          base::suggestion(tag, {"simple", "struct", "sequence", "description", "value"}));
    }
  }

  std::string text_in(const pugi::xml_node& node) {
    std::string text;
    for (const pugi::xml_node child : node.children()) {
      if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) {
        text += child.value();
      } else if (child.type() == pugi::node_element) {
        diagnostics_.error(place(child), "unexpected element " + in_quotes(child.name()));
      }
    }
    return text;
  }

  LineIndex lines_;
  const Limits& limits_;
  base::Diagnostics& diagnostics_;
  std::size_t nodes_ = 0;
  bool abandoned_ = false;
};

}  // namespace

std::optional<XmlElement> parse_orocos_xml(std::string_view text, const std::string& file,
                                           const Limits& limits, base::Diagnostics& diagnostics) {
  if (!check_source_text(text, file, limits.file_bytes, diagnostics)) return std::nullopt;
  LineIndex lines(text, file);
  const std::size_t first = text.find_first_not_of("\xef\xbb\xbf \t\r\n");
  if (first != text.npos && text[first] != '<') {
    diagnostics.error(lines.at(first), "this is not XML: an OROCOS file begins with <",
                      "a deployment in YAML ends in .yaml");
    return std::nullopt;
  }
  if (!check_character_references(text, lines, diagnostics)) return std::nullopt;
  XmlReader reader(std::move(lines), limits, diagnostics);
  pugi::xml_document document;
  const unsigned options = pugi::parse_default | pugi::parse_doctype | pugi::parse_ws_pcdata_single;
  const pugi::xml_parse_result result =
      document.load_buffer(text.data(), text.size(), options, pugi::encoding_utf8);
  if (!result) {
    diagnostics.error(reader.at(result.offset),
                      std::string("this is not XML: ") + result.description());
    return std::nullopt;
  }
  return reader.read_root(document);
}

}  // namespace armature::orocos
