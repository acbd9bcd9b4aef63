// SPDX-License-Identifier: Apache-2.0
#pragma once

// How the task browser writes: paragraphs, columns, colours.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace armature::browser::internal {

/// What it is written on.
struct Paper {
  std::size_t width = 80;  ///< columns
  bool colour = false;
};

enum class Ink { kName, kHeading, kBad, kGood, kFaint };
std::string inked(const Paper& paper, Ink ink, std::string_view text);

/// Of a list that are shown beside others.
inline constexpr std::size_t kUsualElements = 8;
/// Of one that was asked for: all, unless they would fill the screen.
inline constexpr std::size_t kAskedElements = 100;

/// One number as printf writes it.
std::string number_text(const char* format, double number);

/// `"left"`; nothing that a component says moves the cursor or rings the bell.
std::string in_quotes(std::string_view text);

/// With a unit, if there is one: `0.25 rad`.
std::string with_unit(std::string_view text, std::string_view unit);

/// Columns that a text takes in a terminal: of UTF-8 each character one, of colours none.
std::size_t columns_of(std::string_view text);

/// The text in lines of the paper's width, all but the first after `indent` columns.
std::string wrapped(const Paper& paper, std::string_view text, std::size_t indent,
                    std::size_t first_indent);

/// Words in columns, as many beside each other as there is room for; like `ls`.
std::string in_columns(const Paper& paper, const std::vector<std::string>& words);

/// Rows of cells in columns two blanks apart; the last column is wrapped.
std::string table(const Paper& paper, const std::vector<std::vector<std::string>>& rows);

}  // namespace armature::browser::internal
