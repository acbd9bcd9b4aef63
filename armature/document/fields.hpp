// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/base/time.hpp"
#include "armature/document/document.hpp"
#include "armature/types/enum.hpp"

namespace armature::document {

template <typename T>
using Choices = std::vector<std::pair<std::string_view, T>>;

/// True for letters, digits, `_` and `-`, beginning with a letter or `_`.
bool is_name(std::string_view text);

/// True for names joined by dots.
bool is_dotted_name(std::string_view text);

/// `a.b.c` as {`a.b`, `c`}; the first is empty if there is no dot.
std::pair<std::string, std::string> split_last_dot(std::string_view text);

/// A list's items, or the value itself as the only one; none if it is missing.
std::vector<const Value*> items_of(const Value* value);

/// Reads single values and says what is wrong with them, beginning with whose they are.
class ValueReader {
 public:
  ValueReader(std::string owner, base::Diagnostics& diagnostics)
      : owner_(std::move(owner)), diagnostics_(diagnostics) {}

  std::optional<std::string> text(const Value& value, std::string_view what) const;
  std::optional<std::string> name(const Value& value, std::string_view what) const;
  std::optional<std::string> dotted_name(const Value& value, std::string_view what) const;
  std::optional<bool> flag(const Value& value, std::string_view what) const;
  std::optional<int> whole_number(const Value& value, std::string_view what, int least,
                                  int most) const;
  /// A time with its unit, > 0.
  std::optional<base::Duration> duration(const Value& value, std::string_view what) const;

  template <typename T>
  std::optional<T> choice(const Value& value, std::string_view what,
                          const Choices<T>& choices) const {
    const std::optional<std::string> found = text(value, what);
    if (!found) return std::nullopt;
    for (const auto& [spelling, meaning] : choices) {
      if (*found == spelling) return meaning;
    }
    std::vector<std::string> known;
    for (const auto& choice : choices) known.emplace_back(choice.first);
    refuse_choice(value, what, *found, known);
    return std::nullopt;
  }

  /// One of an enumeration's names.
  template <typename Enum>
  std::optional<Enum> choice(const Value& value, std::string_view what) const {
    const std::optional<std::string> found = text(value, what);
    if (!found) return std::nullopt;
    const std::optional<Enum> named = types::value_named<Enum>(*found);
    if (!named) refuse_name(value, what, types::type_of<Enum>());
    return named;
  }

  void error(const base::Location& where, std::string_view message, base::Hint hint = {}) const;
  base::Diagnostics& diagnostics() const { return diagnostics_; }
  const std::string& owner() const { return owner_; }

 private:
  void refuse_name(const Value& value, std::string_view what, const types::Type& type) const;
  void refuse_choice(const Value& value, std::string_view what, const std::string& found,
                     const std::vector<std::string>& known) const;

  std::string owner_;
  base::Diagnostics& diagnostics_;
};

/// What a key means that has no value: a section may be empty, a setting is a mistake.
enum class Empty { kRefused, kAllowed };

/// The keys of a map; knows which were asked for and refuses the others.
class Fields {
 public:
  Fields(const Value& value, const ValueReader& reader, Empty empty = Empty::kRefused);

  /// The value of `key`, nullptr if it is not there or empty.
  const Value* take(std::string_view key);

  /// Reports every key that was never asked for, and those without a value.
  void refuse_others() const;

 private:
  const Value& value_;
  const ValueReader& reader_;
  Empty empty_;
  static constexpr std::size_t kUsualKeys = 16;  ///< of a component or a connection
  std::vector<std::string> known_;
};

template <typename T>
void assign(std::optional<T> from, T& to) {
  if (from) to = std::move(*from);
}

}  // namespace armature::document
