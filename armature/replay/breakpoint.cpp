// SPDX-License-Identifier: Apache-2.0
#include "armature/replay/breakpoint.hpp"

#include <cmath>
#include <utility>

#include "armature/base/quoted.hpp"
#include "armature/base/unit.hpp"
#include "armature/types/type.hpp"

namespace armature::replay {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

}  // namespace

base::Result<Breakpoint> Breakpoint::parse(exec::Application& application,
                                           const std::string& text) {
  // The longer ones first, of which the shorter ones are a part.
  constexpr std::pair<std::string_view, Is> kSigns[] = {{">=", Is::kAtLeast}, {"<=", Is::kAtMost},
                                                        {"==", Is::kEqual},   {"!=", Is::kUnequal},
                                                        {">", Is::kAbove},    {"<", Is::kBelow}};
  for (const auto& [sign, is] : kSigns) {
    const std::size_t place = text.find(sign);
    if (place == std::string::npos) continue;
    return make(application, text, trimmed(std::string_view(text).substr(0, place)), is,
                trimmed(std::string_view(text).substr(place + sign.size())));
  }
  return base::Error{base::quoted(text) +
                     " has none of > < >= <= == !=: expected for example 'Joint1.Position > 0.3'"};
}

base::Result<Breakpoint> Breakpoint::make(exec::Application& application, const std::string& text,
                                          std::string_view item, Is is, std::string_view bound) {
  auto places = inspect::numbers_in(application, item);
  if (!places) return base::Error{base::quoted(text) + ": " + places.error()};
  if (places.value().size() > 1) {
    return base::Error{base::quoted(text) + ": " + base::quoted(item) + " is " +
                       std::to_string(places.value().size()) + " numbers: name one of them, " +
                       places.value().front().item};
  }
  inspect::WatchedPlace& place = places.value().front();
  if (bound == "true" || bound == "false") {
    return Breakpoint(text, std::move(place), is, bound == "true" ? 1.0 : 0.0);
  }
  const auto quantity = base::parse_quantity(bound);
  if (!quantity) return base::Error{base::quoted(text) + ": " + quantity.error()};
  const std::string unit = quantity.value().unit.empty() ? place.unit : quantity.value().unit;
  const auto converted = base::convert(quantity.value().value, unit, place.unit);
  if (!converted) return base::Error{base::quoted(text) + ": " + converted.error()};
  return Breakpoint(text, std::move(place), is, converted.value());
}

std::optional<std::string> Breakpoint::look() {
  const exec::WatchedNumber& number = place_.number;
  if (number.port != nullptr && number.port->current_sequence() == 0) return std::nullopt;
  const double value =
      number.place.read(number.port != nullptr ? number.port->current() : number.property->data());
  const bool held = std::exchange(held_, holds(value));
  if (held || !held_) return std::nullopt;
  return place_.item + " = " + types::Value::of(value).text() +
         (place_.unit.empty() ? "" : " " + place_.unit);
}

bool Breakpoint::holds(double value) const {
  switch (is_) {
    case Is::kAbove:
      return value > bound_;
    case Is::kBelow:
      return value < bound_;
    case Is::kAtLeast:
      return value >= bound_;
    case Is::kAtMost:
      return value <= bound_;
    case Is::kEqual:
      return value == bound_;
    case Is::kUnequal:
      return value != bound_;
  }
  return false;
}

}  // namespace armature::replay
