// SPDX-License-Identifier: Apache-2.0
#include "armature/ride/policy.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/platform/file.hpp"

namespace armature::ride {
namespace {

constexpr std::array<Access, 3> kAccesses{Access::kRead, Access::kCommand, Access::kConfigure};
constexpr std::string_view kForm = "allow WHO ACCESS COMPONENTS";
constexpr std::string_view kExample = "as in: allow operator@tls read,command Vision";
constexpr std::string_view kSpace = " \t\r";

/// A word of a line, with its column from 1.
struct Word {
  std::string_view text;
  int column = 0;
};

/// The words before a comment.
std::vector<Word> words_of(std::string_view line) {
  std::vector<Word> words;
  std::size_t at = 0;
  while ((at = line.find_first_not_of(kSpace, at)) != std::string_view::npos && line[at] != '#') {
    const std::size_t end = std::min(line.find_first_of(" \t\r#", at), line.size());
    words.push_back({line.substr(at, end - at), static_cast<int>(at) + 1});
    at = end;
  }
  return words;
}

/// The parts between the commas; an empty one is a mistake of whoever wrote it.
std::vector<Word> parts_of(const Word& list) {
  std::vector<Word> parts;
  std::size_t at = 0;
  while (true) {
    const std::size_t comma = std::min(list.text.find(',', at), list.text.size());
    parts.push_back({list.text.substr(at, comma - at), list.column + static_cast<int>(at)});
    if (comma == list.text.size()) return parts;
    at = comma + 1;
  }
}

std::string quoted(std::string_view text) {
  // What is shown on a terminal is not to fill it; Diagnostics see to it that nothing commands it.
  constexpr std::size_t kMostShown = 60;
  return "'" + std::string(text.substr(0, kMostShown)) + (text.size() > kMostShown ? "...'" : "'");
}

std::optional<Access> access_of(std::string_view name) {
  const auto found = std::ranges::find(kAccesses, name, [](Access a) { return name_of(a); });
  return found == kAccesses.end() ? std::nullopt : std::optional(*found);
}

/// One line's way to a rule: collects its mistakes.
class Line {
 public:
  Line(const std::string& file, int number, base::Diagnostics& diagnostics)
      : file_(file), number_(number), diagnostics_(diagnostics) {}

  std::optional<PolicyRule> rule_of(const std::vector<Word>& words) {
    if (words[0].text != "allow") {
      const base::Hint near = base::suggestion(words[0].text, {"allow"});
      wrong(words[0], "expected a rule, " + std::string(kForm) + ", found " + quoted(words[0].text),
            words[0].text == "deny" ? base::Hint("leave it out: only what a rule allows is allowed")
                                    : near);
      return std::nullopt;
    }
    PolicyRule rule;
    if (words.size() > 1) take_who(words[1], rule);
    if (words.size() > 2) take_access(words[2], rule);
    if (words.size() > 3) take_components(words[3], rule);
    if (words.size() < 4) tell_what_is_missing(words);
    if (words.size() > 4) {
      wrong(words[4], "expected the end of the rule, found " + quoted(words[4].text),
            "write a list with commas and no space: Vision,Arm");
    }
    return ok_ ? std::optional(std::move(rule)) : std::nullopt;
  }

 private:
  void wrong(const Word& at, std::string message, base::Hint hint) {
    ok_ = false;
    diagnostics_.error(place(at), std::move(message), std::move(hint));
  }

  base::Location place(const Word& word) const { return {file_, number_, word.column}; }

  void tell_what_is_missing(const std::vector<Word>& words) {
    constexpr std::array<std::string_view, 4> kParts{"", "its WHO", "its ACCESS", "its COMPONENTS"};
    const Word& last = words.back();
    const Word end{{}, last.column + static_cast<int>(last.text.size())};
    wrong(end, "the rule lacks " + std::string(kParts[words.size()]),
          "a rule is " + std::string(kForm) + ", " + std::string(kExample));
  }

  void take_who(const Word& word, PolicyRule& rule) {
    rule.who = word.text;
    constexpr std::string_view kAccount = "local:";
    if (word.text == "*" || word.text == "local") return;
    if (word.text.starts_with(kAccount) && word.text.size() > kAccount.size()) return;
    const std::size_t at = word.text.rfind('@');
    const bool whole = at != std::string_view::npos && at != 0 && at + 1 != word.text.size();
    if (whole && word.text.substr(at + 1) == "tls") return;
    if (word.text == "page@web" || word.text == "foxglove@web" || word.text == "*@web") return;
    std::string hint = base::near_name(word.text, {"local"});
    if (whole) {
      hint = "did you mean '" + std::string(word.text.substr(0, at)) + "@tls'?";
    } else if (!hint.empty()) {
      hint = "did you mean 'local'?";
    } else if (at == std::string_view::npos) {
      hint = "did you mean '" + std::string(word.text) + "@tls'?";
    }
    wrong(word,
          "expected NAME@tls, *@tls, page@web, foxglove@web, local:USER, local or *, found " +
              quoted(word.text),
          hint);
  }

  void take_access(const Word& word, PolicyRule& rule) {
    for (const Word& part : parts_of(word)) {
      const auto access = access_of(part.text);
      if (access && !rule.covers(*access)) {
        rule.access[static_cast<std::size_t>(*access)] = true;
      } else if (access) {
        wrong(part, quoted(part.text) + " is given twice", "leave one out");
      } else {
        wrong(part, "expected read, command or configure, found " + quoted(part.text),
              base::suggestion(part.text, {"read", "command", "configure"}));
      }
    }
  }

  void take_components(const Word& word, PolicyRule& rule) {
    rule.where = place(word);
    for (const Word& part : parts_of(word)) {
      if (part.text.empty()) {
        wrong(part, "expected a component's name at the comma", "write Vision,Arm or *");
      } else if (std::ranges::find(rule.components, part.text) != rule.components.end()) {
        wrong(part, quoted(part.text) + " is given twice", "leave one out");
      } else {
        rule.components.emplace_back(part.text);
      }
    }
    const bool all = std::ranges::find(rule.components, "*") != rule.components.end();
    if (all && rule.components.size() > 1) {
      wrong(word, "expected names or *, found both in " + quoted(word.text),
            "write * alone for all components");
    }
  }

  const std::string& file_;
  const int number_;
  base::Diagnostics& diagnostics_;
  bool ok_ = true;
};

bool speaks_of(std::string_view rule, std::string_view who) {
  if (rule == "*" || rule == who) return true;
  if (rule == "local" || rule == "local:*") return who.starts_with("local:");
  if (!rule.starts_with("*@")) return false;
  return who.size() > rule.size() - 1 && who.ends_with(rule.substr(1));
}

}  // namespace

Policy Policy::parse(std::string_view text, const std::string& file,
                     base::Diagnostics& diagnostics) {
  Policy policy;
  const std::size_t before = diagnostics.error_count();
  for (int number = 1; !text.empty(); ++number) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const auto words = words_of(line);
    if (words.empty()) continue;
    if (auto rule = Line(file, number, diagnostics).rule_of(words)) {
      policy.rules_.push_back(*std::move(rule));
    }
  }
  if (diagnostics.error_count() != before) policy.rules_.clear();
  return policy;
}

Policy Policy::load(const std::string& path, base::Diagnostics& diagnostics) {
  constexpr std::size_t kMost = 1 << 20;
  const auto text = platform::read_file(path, kMost);
  if (text) return parse(text.value(), path, diagnostics);
  diagnostics.error({path, 0, 0}, "the policy cannot be read: " + text.error());
  return {};
}

void Policy::add(const Policy& other) {
  rules_.insert(rules_.end(), other.rules_.begin(), other.rules_.end());
}

bool Policy::allows(const AccessQuestion& question) const {
  const std::string asker = who(question);
  return std::ranges::any_of(rules_, [&](const PolicyRule& rule) {
    return rule.covers(question.access) && speaks_of(rule.who, asker) &&
           std::ranges::any_of(rule.components, [&](const std::string& name) {
             return name == "*" || name == question.component;
           });
  });
}

void Policy::check(const std::vector<std::string>& components,
                   base::Diagnostics& diagnostics) const {
  for (const PolicyRule& rule : rules_) {
    for (const std::string& name : rule.components) {
      if (name == "*" || std::ranges::find(components, name) != components.end()) continue;
      diagnostics.warning(rule.where, "unknown component " + quoted(name),
                          base::suggestion(name, components));
    }
  }
}

std::string Policy::to_text() const {
  std::string text;
  for (const PolicyRule& rule : rules_) {
    text += "allow " + rule.who;
    char separator = ' ';
    for (const Access access : kAccesses) {
      if (!rule.covers(access)) continue;
      text += std::exchange(separator, ',') + std::string(name_of(access));
    }
    separator = ' ';
    for (const std::string& name : rule.components) text += std::exchange(separator, ',') + name;
    text += '\n';
  }
  return text;
}

}  // namespace armature::ride
