// SPDX-License-Identifier: Apache-2.0
#include "armature/browser/internal/completion.hpp"

#include <algorithm>
#include <cctype>
#include <set>

namespace armature::browser::internal {
namespace {

bool is_part_of_word(const Vocabulary& vocabulary, char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
         vocabulary.in_names.find(c) != std::string_view::npos;
}

/// Where the word begins that ends at the cursor; `_G["aic-1"].Ga` is one.
std::size_t begin_of_word(const Vocabulary& vocabulary, std::string_view text) {
  const auto is_part = [&](char c) { return is_part_of_word(vocabulary, c); };
  const std::size_t indexed = text.rfind("_G[\"");
  if (indexed != std::string_view::npos) {
    const std::size_t name = indexed + 4;
    const std::size_t end = text.find('"', name);
    const std::string_view rest =
        end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    const bool one_word =
        rest.empty() || (rest.front() == ']' && std::all_of(rest.begin() + 1, rest.end(), is_part));
    if (one_word) return indexed;
  }
  std::size_t begin = text.size();
  while (begin > 0 && is_part(text[begin - 1])) --begin;
  return begin;
}

/// The first word of the line if it is a command of the browser's, and the cursor is behind it.
std::string_view command_before(const Vocabulary& vocabulary, std::string_view text,
                                std::size_t begin) {
  const std::size_t first = std::min(text.find_first_not_of(' '), text.size());
  const std::size_t end = std::min(text.find(' ', first), text.size());
  if (begin <= first || begin < end) return {};
  const std::string_view word = text.substr(first, end - first);
  if (word == "list") return "ls";
  for (const Topic& topic : vocabulary.commands) {
    if (topic.name == word) return topic.name;
  }
  return {};
}

void add_values(const inspect::ComponentDescription& component, const std::string& before,
                std::set<std::string>& words) {
  for (const auto& one : component.properties) words.insert(before + one.name);
  for (const auto& one : component.inputs) words.insert(before + one.name);
  for (const auto& one : component.outputs) words.insert(before + one.name);
  for (const auto& one : component.events) words.insert(before + one.name);
}

void add_operations(const inspect::ComponentDescription& component, const std::string& before,
                    const char* behind, std::set<std::string>& words) {
  for (const auto& one : component.operations) words.insert(before + one.name + behind);
}

/// What may follow `Joint1.`, `Joint1:`, `left.`, `math.`, `motion:`.
void add_members(SpelledView& view, Language& language, const std::string& owner, char separator,
                 bool for_help, std::set<std::string>& words) {
  const std::string before = owner + separator;
  const std::string component = view.find(owner);
  if (!component.empty()) {
    const inspect::ComponentDescription details = view.interface_of(component);
    if (separator == '.') add_values(details, before, words);
    if (separator == ':' || for_help) add_operations(details, before, for_help ? "" : "(", words);
  }
  for (const std::string& name : view.component_names()) {
    if (separator == '.' && name.starts_with(before)) {
      words.insert(name.substr(0, name.find('.', before.size())));
    }
  }
  if (!words.empty() || !component.empty()) return;
  if (separator == '.') {
    for (const std::string& name : language.names_in(owner)) words.insert(before + name);
  } else {
    for (const std::string_view method : language.vocabulary().methods) {
      words.insert(before + std::string(method));
    }
  }
}

void add_components(SpelledView& view, bool whole, std::set<std::string>& words) {
  for (const std::string& name : view.component_names()) {
    words.insert(whole ? name : view.spelled(name.substr(0, name.find('.'))));
  }
}

void add_topics(const std::vector<Topic>& topics, std::set<std::string>& words) {
  for (const Topic& topic : topics) words.emplace(topic.name);
}

bool names_components(std::string_view command) {
  return command == "ls" || command == "start" || command == "stop" || command == "reset" ||
         command == "recover" || command == "cleanup";
}

}  // namespace

std::string Completion::common() const {
  if (words.empty()) return {};
  std::string text = words.front();
  for (const std::string& word : words) {
    const auto differ = std::mismatch(text.begin(), text.end(), word.begin(), word.end());
    text.erase(differ.first, text.end());
  }
  return text;
}

Completion complete(SpelledView& view, Language& language, std::string_view before_cursor) {
  const Vocabulary& vocabulary = language.vocabulary();
  Completion completion;
  completion.begin = begin_of_word(vocabulary, before_cursor);
  const std::string word(before_cursor.substr(completion.begin));
  const std::string_view command = command_before(vocabulary, before_cursor, completion.begin);
  const std::size_t separator = word.find_last_of(".:");
  std::set<std::string> words;
  if (names_components(command)) {
    add_components(view, true, words);
  } else if (separator != std::string::npos) {
    add_members(view, language, word.substr(0, separator), word[separator], command == "help",
                words);
  } else {
    add_components(view, !command.empty(), words);
    const bool first = before_cursor.find_first_not_of(' ') >= completion.begin;
    if (first || command == "help") add_topics(vocabulary.commands, words);
    if (command == "help") add_topics(vocabulary.functions, words);
    if (command == "watch") words.insert({"every", "for"});
    if (command.empty()) {
      for (const std::string& name : language.names_in("")) words.insert(name);
    }
  }
  for (const std::string& one : words) {
    const bool odd = one.starts_with("_G[\"") && one.substr(4).starts_with(word);
    if (one.starts_with(word) || (odd && !word.empty())) completion.words.push_back(one);
  }
  return completion;
}

}  // namespace armature::browser::internal
