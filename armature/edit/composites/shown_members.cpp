// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/internal/shown_members.hpp"

#include "armature/document/ranges.hpp"
#include "armature/edit/internal/written_name.hpp"

namespace armature::edit::internal {
namespace {

constexpr std::string_view kRunning = "{i}";

/// What `member` writes for the range of `key`: `2`, `{i}`, `{1..3}`; nothing if it is another
/// name.
std::optional<std::string> number_in(const std::string& member, const WrittenName& key) {
  const std::size_t beside = key.begin.size() + key.end.size();
  if (member.size() <= beside || !member.starts_with(key.begin) || !member.ends_with(key.end)) {
    return std::nullopt;
  }
  const std::string middle = member.substr(key.begin.size(), member.size() - beside);
  const bool digits = middle.find_first_not_of("0123456789") == middle.npos;
  if (digits || (middle.front() == '{' && middle.back() == '}')) return middle;
  return std::nullopt;
}

/// `Joint{i}.Position` with what stands for the number.
std::optional<std::string> with_number(std::string target, const std::string& number) {
  if (number == kRunning) return target;
  if (number.front() != '{') {
    constexpr std::size_t kMostDigits = 9;
    if (number.size() > kMostDigits) return std::nullopt;
    base::Diagnostics ignored;  // the new text is read with the same reader
    return document::replace_number(target, std::stoi(number), {}, ignored);
  }
  const std::size_t at = target.find(kRunning);
  if (at == target.npos) return std::nullopt;
  return target.replace(at, kRunning.size(), number);
}

}  // namespace

std::optional<std::string> ShownMembers::find(const std::string& member) const {
  if (exports_ == nullptr) return std::nullopt;
  for (std::size_t kind = 1; kind < exports_->children.size(); kind += 2) {
    const Node& names = *exports_->children[kind];
    for (std::size_t i = 0; i + 1 < names.children.size(); i += 2) {
      const std::string& target = names.children[i + 1]->text;
      const WrittenName key = WrittenName::of(names.children[i]->text);
      if (key.text() == member)
        return key.braces.empty() ? target : with_number(target, key.braces);
      const auto number = key.braces.empty() ? std::nullopt : number_in(member, key);
      if (number) return with_number(target, *number);
    }
  }
  return std::nullopt;
}

}  // namespace armature::edit::internal
