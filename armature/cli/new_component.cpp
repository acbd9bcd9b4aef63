// SPDX-License-Identifier: Apache-2.0
#include "armature/cli/new_component.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "armature/base/quoted.hpp"
#include "armature/cli/component_templates.hpp"
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

/// `CANDriver2` as `can_driver2`.
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

/// `can_driver` as `CanDriver`; capitals stay.
std::string camel_case(std::string_view name) {
  std::string result;
  bool begins_word = true;
  for (const char c : name) {
    if (c != '_') result += begins_word ? upper(c) : c;
    begins_word = c == '_';
  }
  return result;
}

/// What is wrong with a name, empty if nothing.
std::string problem_of(std::string_view name) {
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

std::string filled(std::string_view text, const std::string& component,
                   const std::string& library) {
  constexpr std::string_view kComponent = "@Name@";
  constexpr std::string_view kLibrary = "@name@";
  std::string result;
  while (!text.empty()) {
    if (text.starts_with(kComponent)) {
      result += component;
      text.remove_prefix(kComponent.size());
    } else if (text.starts_with(kLibrary)) {
      result += library;
      text.remove_prefix(kLibrary.size());
    } else {
      result += text.front();
      text.remove_prefix(1);
    }
  }
  return result;
}

base::Result<void> write_all(NewComponent& made, const std::string& component,
                             const std::string& library) {
  for (const FileTemplate& each : component_templates()) {
    const std::string name = filled(each.name, component, library);
    const base::Result<void> written =
        platform::write_file(made.folder + "/" + name, filled(each.content, component, library));
    if (!written) return written;
    made.files.push_back(name);
  }
  return {};
}

}  // namespace

base::Result<NewComponent> make_component_library(const std::string& name,
                                                  const std::string& parent) {
  if (const std::string problem = problem_of(name); !problem.empty()) {
    return base::Error{"the name " + base::quoted(name) + " " + problem};
  }
  const std::string library = snake_case(name);
  NewComponent made{(fs::path(parent) / library).lexically_normal().string(), {}};
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
  const base::Result<void> written = write_all(made, camel_case(name), library);
  if (written) return made;
  fs::remove_all(made.folder, failure);
  return base::Error{written.error()};
}

}  // namespace armature::cli
