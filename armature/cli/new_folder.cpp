// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/new_folder.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "armature/base/quoted.hpp"
#include "armature/platform/file.hpp"

namespace armature::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 64;

/// Names of libraries that are words of C++, of CMake or of the templates already.
constexpr std::string_view kTaken =
    " alignas alignof and asm auto bool break case catch char class concept const continue decltype"
    " default delete do double else enum explicit export extern false float for friend goto if"
    " inline int long mutable namespace new noexcept not nullptr operator or private protected"
    " public register requires return short signed sizeof static std struct switch template this"
    " throw true try typedef typeid typename union unsigned using virtual void volatile while xor"
    " all clean help install package test"
    " armature attribute command component event event_handler input_port operation outcome"
    " output_port port_array property range reading source state state_machine step testing ";

bool is_taken(const std::string& library) {
  return kTaken.find(" " + library + " ") != std::string_view::npos;
}

bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool is_lower(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }
char upper(char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); }
char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

base::Result<void> write_all(const std::string& folder, const std::vector<NewFile>& files) {
  for (const NewFile& file : files) {
    const base::Result<void> written = platform::write_file(folder + "/" + file.name, file.content);
    if (!written) return written;
  }
  return {};
}

/// The word between two '@' at the beginning of `text`; empty if there is none.
std::string_view word_of(std::string_view text) {
  const std::size_t end = text.find('@', 1);
  return text.empty() || text[0] != '@' || end == std::string_view::npos ? std::string_view()
                                                                         : text.substr(1, end - 1);
}

}  // namespace

std::string snake_case(std::string_view name) {
  std::string result;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool after_word = i > 0 && name[i - 1] != '_' && !is_upper(name[i - 1]);
    const bool ends_acronym =
        i > 0 && is_upper(name[i - 1]) && i + 1 < name.size() && is_lower(name[i + 1]);
    if (is_upper(name[i]) && (after_word || ends_acronym)) result += '_';
    result += lower(name[i]);
  }
  return result;
}

std::string camel_case(std::string_view name) {
  std::string result;
  bool begins_word = true;
  for (const char c : name) {
    if (c != '_') result += begins_word ? upper(c) : c;
    begins_word = c == '_';
  }
  return result;
}

std::string problem_of_name(std::string_view name) {
  const auto allowed = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  };
  const bool identifier = !name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) != 0 &&
                          std::all_of(name.begin(), name.end(), allowed);
  if (!identifier) return "must begin with a letter and have only letters, digits and '_'";
  if (name.find("__") != std::string_view::npos || name.back() == '_') {
    return "has a '_' at its end or two in a row; put each between two words";
  }
  if (name.size() > kLongestName) {
    return "is longer than " + std::to_string(kLongestName) + " letters";
  }
  const std::string library = snake_case(name);
  if (!is_taken(library)) return {};
  return "would make a library " + base::quoted(library) +
         ", which is a word of C++, CMake or Armature; choose a longer name, such as " +
         base::quoted(camel_case(name) + "Driver");
}

std::string filled(std::string_view text, const Words& words) {
  std::string result;
  while (!text.empty()) {
    const std::string_view word = word_of(text);
    const auto known = words.find(word);
    if (!word.empty() && known != words.end()) {
      result += known->second;
      text.remove_prefix(word.size() + 2);
    } else {
      result += text.front();
      text.remove_prefix(1);
    }
  }
  return result;
}

base::Result<NewFolder> make_folder(const std::string& parent, const std::string& name,
                                    const std::vector<NewFile>& files) {
  NewFolder made{(fs::path(parent) / name).lexically_normal().string(), {}};
  std::error_code failure;
  const bool created = fs::create_directory(made.folder, failure);
  if (failure) {
    return base::Error{"cannot make the folder " + base::quoted(made.folder) + ": " +
                       failure.message()};
  }
  if (!created) {
    return base::Error{base::quoted(made.folder) +
                       " exists already; choose another name or folder"};
  }
  const base::Result<void> written = write_all(made.folder, files);
  if (!written) {
    fs::remove_all(made.folder, failure);
    return base::Error{written.error()};
  }
  for (const NewFile& file : files) made.files.push_back(file.name);
  return made;
}

}  // namespace armature::cli
