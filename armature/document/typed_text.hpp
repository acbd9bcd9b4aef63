// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "armature/document/document.hpp"

/// The types of OROCOS property files. A Value names its type only where its text does not show it.
namespace armature::document {

/// True for the types of a `simple` element.
bool is_simple_type(std::string_view type);

/// True for the lists `array`, `ints` and `strings`.
bool is_list_type(std::string_view type);

/// True for names that a struct's type may have: those of OROCOS type kits, `KDL.Frame` or
/// `/geometry_msgs/Pose`, but none of the types above.
bool is_struct_type(std::string_view type);

/// The type of the elements of such a list; empty for other types.
std::string_view element_type_of(std::string_view list_type);

/// True for types whose text counts as it is, spaces included.
bool is_text_type(std::string_view type);

/// boolean, long, llong, ullong, double or string.
std::string_view shown_type(std::string_view text);

/// `array` for a list of numbers, else `strings`.
std::string_view shown_list_type(const Value& list);

/// What is wrong with the text of a simple element of that type; empty if nothing is.
std::string wrong_with(std::string_view text, std::string_view type);

/// What is wrong with a text or a list of the type it names: `must be a whole number, found 'x'`.
std::string wrong_with(const Value& value);

/// Leaves out a type that the value shows by itself, and lets a whole number of type double show
/// it.
void normalise_type(Value& value);

}  // namespace armature::document
