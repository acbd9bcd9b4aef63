// SPDX-License-Identifier: Apache-2.0
#include "armature/record/internal/layout.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace armature::record::internal {
namespace {

using types::Kind;

constexpr int kDeepestLayout = 32;

constexpr std::array<std::pair<std::string_view, Kind>, 11> kScalarNames{
    {{"bool", Kind::kBool},
     {"int8", Kind::kInt8},
     {"uint8", Kind::kUint8},
     {"int16", Kind::kInt16},
     {"uint16", Kind::kUint16},
     {"int32", Kind::kInt32},
     {"uint32", Kind::kUint32},
     {"int64", Kind::kInt64},
     {"uint64", Kind::kUint64},
     {"float", Kind::kFloat},
     {"double", Kind::kDouble}}};

std::optional<Kind> scalar_named(std::string_view name) {
  const auto found =
      std::ranges::find(kScalarNames, name, [](const auto& one) { return one.first; });
  return found == kScalarNames.end() ? std::nullopt : std::optional(found->second);
}

class LayoutReader {
 public:
  explicit LayoutReader(std::string_view text) : rest_(text) {}

  std::optional<Layout> whole() {
    auto layout = type(0);
    return rest_.empty() ? layout : std::nullopt;
  }

 private:
  bool takes(std::string_view wanted) {
    if (!rest_.starts_with(wanted)) return false;
    rest_.remove_prefix(wanted.size());
    return true;
  }

  std::string_view name() {
    const std::size_t end = std::min(rest_.find_first_of("{}:,<>="), rest_.size());
    const std::string_view found = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return found;
  }

  template <typename Number>
  bool takes_number(Number& number) {
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), number);
    if (error != std::errc()) return false;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return true;
  }

  std::optional<Layout> type(int depth) {
    if (depth > kDeepestLayout) return std::nullopt;
    if (takes("vector<")) return list(Kind::kVector, depth);
    if (takes("array<")) return list(Kind::kArray, depth);
    const std::string_view word = name();
    if (word == "text") return text();
    if (takes("{")) return structure(depth);
    if (takes(":")) return enumeration();
    const auto scalar = scalar_named(word);
    return scalar ? std::optional(Layout{*scalar}) : std::nullopt;
  }

  std::optional<Layout> list(Kind kind, int depth) {
    Layout list{kind};
    auto element = type(depth + 1);
    if (!element) return std::nullopt;
    list.parts.push_back(*std::move(element));
    if (kind == Kind::kArray && (!takes(",") || !takes_number(list.count))) return std::nullopt;
    return takes(">") ? std::optional(std::move(list)) : std::nullopt;
  }

  std::optional<Layout> text() {
    Layout text{Kind::kText};
    if (!takes("<")) return text;
    return takes_number(text.count) && takes(">") ? std::optional(text) : std::nullopt;
  }

  std::optional<Layout> structure(int depth) {
    Layout all{Kind::kStruct};
    do {
      const std::string_view field = name();
      if (!takes(":")) return std::nullopt;
      auto part = type(depth + 1);
      if (!part) return std::nullopt;
      part->field = field;
      all.parts.push_back(*std::move(part));
    } while (takes(","));
    return takes("}") ? std::optional(std::move(all)) : std::nullopt;
  }

  std::optional<Layout> enumeration() {
    Layout all{Kind::kEnum};
    const auto underlying = scalar_named(name());
    if (!underlying || !takes("{")) return std::nullopt;
    all.underlying = *underlying;
    do {
      types::Enumerator one{std::string(name()), 0};
      if (!takes("=") || !takes_number(one.value)) return std::nullopt;
      all.enumerators.push_back(std::move(one));
    } while (takes(","));
    return takes("}") ? std::optional(std::move(all)) : std::nullopt;
  }

  std::string_view rest_;
};

}  // namespace

std::optional<Layout> parse_layout(std::string_view text) { return LayoutReader(text).whole(); }

}  // namespace armature::record::internal
