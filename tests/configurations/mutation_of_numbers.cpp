// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <utility>
#include <vector>

#include "tests/configurations/mutation_kinds.hpp"

namespace armature::configurations {

using document::Document;
using document::Property;
using document::Value;

namespace {

/// `10 ms`: a number and what stands behind it.
struct Number {
  double value = 0.0;
  std::string unit;
};

std::optional<Number> number_of(const Value& value) {
  if (value.kind != Value::Kind::kText || value.literal) return std::nullopt;
  Number number;
  const char* const end = value.text.data() + value.text.size();
  const auto parsed = std::from_chars(value.text.data(), end, number.value);
  if (parsed.ec != std::errc()) return std::nullopt;
  number.unit = std::string(parsed.ptr, end);
  number.unit.erase(0, number.unit.find_first_not_of(' '));
  const bool is_unit = std::all_of(number.unit.begin(), number.unit.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '/' || c == '^' || c == '%';
  });
  return is_unit ? std::optional(number) : std::nullopt;
}

std::string text_of(const Number& number) {
  char text[64];
  std::snprintf(text, sizeof text, "%.9g", number.value);
  return text + (number.unit.empty() ? "" : " " + number.unit);
}

std::string kind_of(const std::string& property) {
  if (is_one_of(property, {"Kp", "Ki", "Kd", "gravity", "VelocityCutoff", "GearRatio",
                           "motor_turns", "motor_rotor_inertia", "motor_viscous_friction",
                           "viscous_friction", "coulomb_friction", "motor_resistance",
                           "motor_torque_constant", "motor_gear_ratio", "SwitchTime"})) {
    return "gain";
  }
  if (property.starts_with("Max") || property.starts_with("max") || property.starts_with("Min") ||
      property.ends_with("Min") || property.ends_with("Max") || property == "lower" ||
      property == "upper") {
    return "limit";
  }
  if (property == "Period") return "period";
  if (is_one_of(property, {"joints", "num_axes", "JointNumber", "cards"})) return "size";
  return "number";
}

/// A property of a component, or an element of one.
struct Place {
  Value* value;
  std::string name;
  std::string kind;
};

std::vector<Place> numbers_in(Document& document) {
  std::vector<Place> places;
  for (document::Component& component : document.components) {
    for (Property& property : component.properties) {
      if (is_of_the_plant(component, property.name)) continue;
      const std::string name = component.name + "." + property.name;
      const std::string kind = kind_of(property.name);
      if (number_of(property.value)) places.push_back({&property.value, name, kind});
      for (std::size_t i = 0; i < property.value.items.size(); ++i) {
        if (!number_of(property.value.items[i])) continue;
        places.push_back({&property.value.items[i], name + "[" + std::to_string(i) + "]", kind});
      }
    }
  }
  return places;
}

std::vector<Place> places_of(Document& document, std::string_view kind) {
  std::vector<Place> places = numbers_in(document);
  std::erase_if(places, [&](const Place& place) { return place.kind != kind; });
  return places;
}

std::optional<std::string> replace(const Place& place, const std::string& text) {
  if (place.value->text == text) return std::nullopt;
  std::string what = place.name + ": " + place.value->text + " -> " + text;
  place.value->text = text;
  return what;
}

double scaled(double value, Random& random) {
  constexpr std::array<double, 10> kFactors{1e-3, 1e-2, 0.1, 0.5, 2, 3, 10, 100, 1e3, 1e6};
  const double factor = any_of(kFactors, random);
  return value == 0.0 ? factor : value * factor;
}

}  // namespace

Change scale(std::string kind) {
  return
      [kind = std::move(kind)](Document& document, Random& random) -> std::optional<std::string> {
        std::vector<Place> places = places_of(document, kind);
        if (places.empty()) return std::nullopt;
        const Place place = any_of(places, random);
        Number number = *number_of(*place.value);
        const double before = number.value;
        number.value = scaled(before, random);
        if (kind == "size") number.value = before + (random() % 2 == 0 ? 1 : -1);
        const double factor = before == 0.0 ? 1.0 : number.value / before;
        const std::string list = place.name.substr(0, place.name.find('['));
        if (list == place.name || kind == "size" || random() % 2 == 0) {
          return replace(place, text_of(number));
        }
        for (const Place& other : places) {
          if (!other.name.starts_with(list + "[")) continue;
          Number element = *number_of(*other.value);
          element.value *= factor;
          other.value->text = text_of(element);
        }
        return list + ": all x " + text_of({factor, ""});
      };
}

std::optional<std::string> change_sign(Document& document, Random& random) {
  std::vector<Place> places = numbers_in(document);
  if (places.empty()) return std::nullopt;
  const Place& place = any_of(places, random);
  Number number = *number_of(*place.value);
  if (number.value == 0.0) return std::nullopt;
  number.value = -number.value;
  return replace(place, text_of(number));
}

/// A unit that is another, of another kind, or gone.
std::optional<std::string> change_unit(Document& document, Random& random) {
  constexpr std::array<std::string_view, 9> kUnits{"",   "deg",  "rad",   "ms",   "s",
                                                   "us", "mrad", "deg/s", "rad/s"};
  std::vector<Place> places = numbers_in(document);
  if (places.empty()) return std::nullopt;
  const Place& place = any_of(places, random);
  Number number = *number_of(*place.value);
  number.unit = any_of(kUnits, random);
  return replace(place, text_of(number));
}

std::optional<std::string> change_to_extreme(Document& document, Random& random) {
  constexpr std::array<std::string_view, 8> kExtremes{"0",    "1e9",  "-1e9", "1e300",
                                                      ".nan", ".inf", "-1",   "1e-9"};
  std::vector<Place> places = numbers_in(document);
  if (places.empty()) return std::nullopt;
  return replace(any_of(places, random), std::string(any_of(kExtremes, random)));
}

std::optional<std::string> change_period(Document& document, Random& random) {
  std::vector<document::Component*> periodic;
  for (document::Component& component : document.components) {
    if (component.activity.kind == exec::Activity::Kind::kPeriodic) periodic.push_back(&component);
  }
  if (periodic.empty() || random() % 3 == 0) return scale("period")(document, random);
  constexpr std::array<double, 8> kFactors{0.01, 0.1, 0.5, 0.9, 1.5, 2, 10, 100};
  document::Component& component = *any_of(periodic, random);
  base::Duration& period = component.activity.period;
  const base::Duration before = period;
  period = base::Duration(static_cast<base::Duration::rep>(static_cast<double>(before.count()) *
                                                           any_of(kFactors, random)));
  return component.name + ": every " + document::to_text(before) + " -> " +
         document::to_text(period);
}

std::optional<std::string> change_size(Document& document, Random& random) {
  if (random() % 2 == 0) return scale("size")(document, random);
  std::vector<std::pair<std::string, Value*>> lists;
  for (document::Component& component : document.components) {
    for (Property& property : component.properties) {
      if (is_of_the_plant(component, property.name) || property.value.items.empty()) continue;
      lists.emplace_back(component.name + "." + property.name, &property.value);
    }
  }
  if (lists.empty()) return std::nullopt;
  auto& [name, list] = any_of(lists, random);
  switch (random() % 4) {
    case 0:
      list->items.pop_back();
      return name + ": one element less";
    case 1:
      list->items.push_back(list->items.back());
      return name + ": one element more";
    case 2:
      list->items.clear();
      return name + ": empty";
    default:
      std::reverse(list->items.begin(), list->items.end());
      return name + ": reversed";
  }
}

}  // namespace armature::configurations
