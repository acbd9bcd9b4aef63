// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/internal/ini.hpp"

#include <algorithm>
#include <set>

#include "armature/base/visible_text.hpp"

namespace armature::canopen::internal {
namespace {

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

/// Reads a file line by line.
class IniReader {
 public:
  IniReader(const std::string& file, base::Diagnostics& diagnostics)
      : file_(file), diagnostics_(diagnostics) {}

  void take(std::string_view raw, int line) {
    const std::string_view text = without_blanks(raw);
    if (text.empty() || text.front() == ';' || text.front() == '#') return;
    if (text.front() == '[') {
      begin_section(text, line);
    } else {
      add_entry(text, line);
    }
  }
  std::vector<IniSection> sections;

 private:
  void begin_section(std::string_view text, int line) {
    if (text.back() != ']') {
      diagnostics_.error({file_, line, 0}, "section " + base::visible_text(text) + " has no end",
                         "end it with ]");
      text.remove_prefix(1);
    } else {
      text = text.substr(1, text.size() - 2);
    }
    std::string name = lower_case(without_blanks(text));
    if (!names_.insert(name).second) {
      diagnostics_.error({file_, line, 0},
                         "section [" + base::visible_text(name) + "] is there twice", "merge both");
    }
    sections.push_back({std::move(name), line, {}});
  }

  void add_entry(std::string_view text, int line) {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos || equals == 0) {
      diagnostics_.error(
          {file_, line, 0},
          "expected [Section] or Key=value, found '" + base::visible_text(text) + "'",
          "begin a comment with ;");
      return;
    }
    if (sections.empty()) {
      diagnostics_.error({file_, line, 0}, "'" + base::visible_text(text) + "' is in no section",
                         "begin one with [Name]");
      return;
    }
    IniSection& section = sections.back();
    std::string key = lower_case(without_blanks(text.substr(0, equals)));
    if (section.find(key) != nullptr) {
      diagnostics_.error({file_, line, 0},
                         "'" + base::visible_text(key) + "' is there twice in [" +
                             base::visible_text(section.name) + "]",
                         "remove one");
      return;
    }
    section.entries.push_back(
        {std::move(key), std::string(without_blanks(text.substr(equals + 1))), line});
  }

  const std::string& file_;
  base::Diagnostics& diagnostics_;
  std::set<std::string> names_;
};

}  // namespace

const IniEntry* IniSection::find(std::string_view key) const {
  const auto found = std::ranges::find(entries, key, &IniEntry::key);
  return found == entries.end() ? nullptr : &*found;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

std::vector<IniSection> parse_ini(std::string_view text, const std::string& file,
                                  base::Diagnostics& diagnostics) {
  IniReader reader(file, diagnostics);
  for (int line = 1; !text.empty(); ++line) {
    const std::string_view one = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(one.size() + 1, text.size()));
    reader.take(one, line);
  }
  return std::move(reader.sections);
}

}  // namespace armature::canopen::internal
