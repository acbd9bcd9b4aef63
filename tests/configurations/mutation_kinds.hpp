// SPDX-License-Identifier: Apache-2.0
#pragma once

// What a mutation may be about, and what they share.

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

#include "armature/document/document.hpp"
#include "tests/configurations/mutation.hpp"

namespace armature::configurations {

/// Says what it changed; nothing if there is nothing to change.
using Change = std::function<std::optional<std::string>(document::Document&, Random&)>;

inline std::size_t below(std::size_t count, Random& random) { return random() % count; }

template <typename Container>
auto& any_of(Container& all, Random& random) {
  return all[below(std::size(all), random)];
}

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words);

/// What only the simulated plant has: another value is another robot.
bool is_of_the_plant(const document::Component& component, const std::string& property);

// mutation_of_numbers.cpp
/// Numbers of properties of one kind (`gain`, `limit`, ...), by a factor: all elements of a list
/// together, or one.
Change scale(std::string kind);
std::optional<std::string> change_sign(document::Document& document, Random& random);
std::optional<std::string> change_unit(document::Document& document, Random& random);
std::optional<std::string> change_to_extreme(document::Document& document, Random& random);
/// Of a component that runs periodically, or a property.
std::optional<std::string> change_period(document::Document& document, Random& random);
std::optional<std::string> change_size(document::Document& document, Random& random);

// mutation_of_components.cpp
/// `true` to `false`, or the other way round; or the property is left out.
std::optional<std::string> change_switch(document::Document& document, Random& random);
std::optional<std::string> change_activity(document::Document& document, Random& random);
std::optional<std::string> change_components(document::Document& document, Random& random);
std::optional<std::string> swap_components(document::Document& document, Random& random);

// mutation_of_wires.cpp
std::optional<std::string> change_wire(document::Document& document, Random& random);
std::optional<std::string> change_peers(document::Document& document, Random& random);

// mutation_of_sections.cpp
std::optional<std::string> change_grants(document::Document& document, Random& random);
/// What is done before a stop, and for how long is held after it.
std::optional<std::string> change_stop(document::Document& document, Random& random);
std::optional<std::string> change_modes(document::Document& document, Random& random);
/// Who may come in, and where components of other processes are.
std::optional<std::string> change_network(document::Document& document, Random& random);
/// How the robot's hardware is reached.
std::optional<std::string> change_bus(document::Document& document, Random& random);

}  // namespace armature::configurations
