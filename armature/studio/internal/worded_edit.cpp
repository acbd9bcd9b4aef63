// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/worded_edit.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "armature/base/near_name.hpp"
#include "armature/base/quoted.hpp"

namespace armature::studio::internal {
namespace {

using Words = std::vector<std::string>;

/// The word at `index`, empty if it was left out.
std::string word(const Words& words, std::size_t index) {
  return index < words.size() ? words[index] : std::string();
}

struct Form {
  const char* name;
  std::size_t least;  ///< words
  std::size_t most;
  edit::Change (*make)(const Words& words);
};

/// An edit that is made of so many words, in their order.
template <typename Edit, std::size_t kCount, std::size_t kOptional = 0>
constexpr Form form(const char* name) {
  return {name, kCount - kOptional, kCount, [](const Words& words) -> edit::Change {
            if constexpr (kCount == 1) return Edit{word(words, 0)};
            if constexpr (kCount == 2) return Edit{word(words, 0), word(words, 1)};
            if constexpr (kCount == 3) return Edit{word(words, 0), word(words, 1), word(words, 2)};
          }};
}

/// A name, and the components that become its parts.
constexpr Form group() {
  constexpr std::size_t kMostParts = 1000;
  return {"group", 2, 1 + kMostParts, [](const Words& words) -> edit::Change {
            return edit::Group{words.front(), {words.begin() + 1, words.end()}};
          }};
}

constexpr Form kForms[] = {
    form<edit::Set, 2>("set"),
    form<edit::Unset, 1>("unset"),
    form<edit::AddComponent, 2>("add"),
    form<edit::RemoveComponent, 1>("remove"),
    form<edit::Rename, 2>("rename"),
    form<edit::Split, 2>("split"),
    group(),
    form<edit::Dissolve, 1>("dissolve"),
    form<edit::Connect, 3, 1>("connect"),
    form<edit::Disconnect, 2, 1>("disconnect"),
    form<edit::SetConnection, 3, 1>("connection"),
    form<edit::Bind, 3>("bind"),
    form<edit::Unbind, 2>("unbind"),
    form<edit::AddPeer, 2>("peer"),
    form<edit::RemovePeer, 2>("no_peer"),
    form<edit::AddSuperior, 2>("superior"),
    form<edit::RemoveSuperior, 2>("no_superior"),
    form<edit::SetCalls, 2>("calls"),
    form<edit::AddInclude, 1>("include"),
    form<edit::RemoveInclude, 1>("no_include"),
    form<edit::AddParameter, 2>("parameter"),
    form<edit::AddLibrary, 1>("library"),
    form<edit::RemoveLibrary, 1>("no_library"),
    form<edit::AddToMode, 2>("to_mode"),
    form<edit::RemoveFromMode, 2>("from_mode"),
    form<edit::RemoveMode, 1>("no_mode"),
    form<edit::RenameMode, 2>("rename_mode"),
    form<edit::StartInMode, 1>("initial_mode"),
};

/// ` or 3`, ` to 1001`; empty if it is no other number than the least.
std::string most_of(const Form& form) {
  if (form.most == form.least) return {};
  return (form.most == form.least + 1 ? " or " : " to ") + std::to_string(form.most);
}

base::Error unknown(std::string_view name) {
  std::vector<std::string> names;
  for (const Form& one : kForms) names.emplace_back(one.name);
  return base::Error{"unknown edit " + base::quoted(std::string(name)) +
                     base::suggestion_in_brackets(std::string(name), names)};
}

}  // namespace

base::Result<edit::Change> change_of(std::string_view name, const Words& words) {
  const auto* const form = std::ranges::find(kForms, name, &Form::name);
  if (form == std::end(kForms)) return unknown(name);
  if (words.size() < form->least || words.size() > form->most) {
    return base::Error{"the edit " + base::quoted(std::string(name)) + " takes " +
                       std::to_string(form->least) + most_of(*form) + " words, not " +
                       std::to_string(words.size())};
  }
  return form->make(words);
}

}  // namespace armature::studio::internal
