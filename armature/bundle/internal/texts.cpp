// SPDX-License-Identifier: Apache-2.0
#include "armature/bundle/internal/texts.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstddef>
#include <utility>

#include "armature/bundle/internal/templates.hpp"

namespace armature::bundle::internal {
namespace {

using Words = std::vector<std::pair<std::string_view, std::string>>;

bool is_plain(unsigned char letter) {
  return std::isalnum(letter) != 0 || letter == '.' || letter == '_' || letter == '-';
}

template <typename Texts>
std::string joined(const Texts& texts, std::string_view between) {
  std::string result;
  for (const std::string& text : texts) {
    if (!result.empty()) result += between;
    result += text;
  }
  return result;
}

std::string paragraph(std::string_view head, const std::vector<std::string>& lines) {
  if (lines.empty()) return {};
  return "\n" + std::string(head) + "\n\n  " + joined(lines, "\n  ") + "\n";
}

/// `text` with a word in each place that `@name@` keeps for it; no word is looked through again.
std::string filled(std::string_view text, const Words& words) {
  std::string result;
  while (!text.empty()) {
    const std::size_t begin = std::min(text.find('@'), text.size());
    result += text.substr(0, begin);
    text.remove_prefix(begin);
    const std::size_t end = text.find('@', 1);
    const auto word = std::ranges::find_if(words, [&](const auto& each) {
      return end != std::string_view::npos && each.first == text.substr(1, end - 1);
    });
    if (word == words.end()) {
      result += text.substr(0, 1);
      text.remove_prefix(std::min<std::size_t>(1, text.size()));
    } else {
      result += word->second;
      text.remove_prefix(end + 1);
    }
  }
  return result;
}

/// What nearly every text has.
Words words_of(const Facts& facts) {
  return {{"name", facts.name},
          {"unit", name_of_unit(facts.name)},
          {"package", name_of_package(facts.name)},
          {"folder", installed_folder(facts.name)},
          {"version", facts.version},
          {"architecture", facts.architecture},
          {"deployment", facts.deployment}};
}

std::string filled(std::string_view text, const Facts& facts, const Words& others) {
  Words words = words_of(facts);
  words.insert(words.end(), others.begin(), others.end());
  return filled(text, words);
}

}  // namespace

std::string name_of_bundle(std::string_view application) {
  const bool fits = !application.empty() && application.front() != '.' &&
                    application.front() != '-' && std::ranges::all_of(application, is_plain);
  return fits ? std::string(application) : std::string();
}

std::string name_of_package(std::string_view name) {
  std::string package = "armature-" + std::string(name);
  for (char& letter : package) {
    letter =
        letter == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return package;
}

std::string name_of_unit(std::string_view name) { return std::string(name) + ".service"; }

std::string name_of_archive(const Facts& facts) {
  return name_of_package(facts.name) + "_" + facts.version + "_" + facts.architecture + ".deb";
}

std::string installed_folder(std::string_view name) { return "/opt/armature/" + std::string(name); }

std::string shell_word(std::string_view text) {
  std::string word = "'";
  for (const char letter : text) word += letter == '\'' ? "'\\''" : std::string(1, letter);
  return word + "'";
}

std::string run_script(const Facts& facts) {
  std::string options;
  for (const std::string& word : facts.options) options += " " + shell_word(word);
  if (!facts.script.empty()) options += " --script \"$here\"/" + shell_word(facts.script);
  return filled(kRun, {{"deployment", shell_word(facts.deployment)}, {"options", options}});
}

std::string unit_text(const Facts& facts) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(facts.stop_time).count();
  const std::string saved =
      facts.saved.empty() ? std::string() : " " + installed_folder(facts.name) + "/deployment";
  return filled(kUnit, facts, {{"seconds", std::to_string(seconds)}, {"saved", saved}});
}

std::string readme_text(const Facts& facts) {
  return filled(
      kReadme, facts,
      {{"packages", joined(facts.packages, " ")},
       {"strangers",
        paragraph("Install these libraries by hand; no package has them:", facts.strangers)},
       {"keys", paragraph("Private keys are not in here. Put them by hand to:", facts.keys)},
       {"saved", paragraph("A run writes these files when it stops:", facts.saved)}});
}

std::string licences_text(const Facts& facts) {
  std::string list;
  for (const std::string& package : facts.packages) {
    list += package + ": /usr/share/doc/" + package + "/copyright\n";
  }
  return filled(kLicences, {{"list", list}});
}

std::string control_text(const Facts& facts, std::uint64_t kilobytes) {
  const std::string depends =
      facts.packages.empty() ? "" : "Depends: " + joined(facts.packages, ", ") + "\n";
  return filled(kControl, facts, {{"kilobytes", std::to_string(kilobytes)}, {"depends", depends}});
}

}  // namespace armature::bundle::internal
