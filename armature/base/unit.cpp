// SPDX-License-Identifier: Apache-2.0
#include "armature/base/unit.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "armature/base/near_name.hpp"

namespace armature::base {
namespace {

constexpr std::string_view kSpace = " \t";
constexpr double kPi = std::numbers::pi;

struct Symbol {
  std::string_view text;
  std::array<int, Unit::kDimensions> powers;
  double factor;
  bool takes_prefix;
};

// Powers of: length, mass, time, current, temperature, angle, count.
constexpr Symbol kSymbols[] = {
    {"1", {}, 1.0, false},
    {"%", {}, 0.01, false},
    {"m", {1, 0, 0}, 1.0, true},
    {"g", {0, 1, 0}, 1e-3, true},
    {"s", {0, 0, 1}, 1.0, true},
    {"min", {0, 0, 1}, 60.0, false},
    {"h", {0, 0, 1}, 3600.0, false},
    {"Hz", {0, 0, -1}, 1.0, true},
    {"A", {0, 0, 0, 1}, 1.0, true},
    {"K", {0, 0, 0, 0, 1}, 1.0, true},
    {"rad", {0, 0, 0, 0, 0, 1}, 1.0, true},
    {"deg", {0, 0, 0, 0, 0, 1}, kPi / 180.0, false},
    {"rev", {0, 0, 0, 0, 0, 1}, 2.0 * kPi, false},
    {"turn", {0, 0, 0, 0, 0, 1}, 2.0 * kPi, false},
    {"rpm", {0, 0, -1, 0, 0, 1}, 2.0 * kPi / 60.0, false},
    {"count", {0, 0, 0, 0, 0, 0, 1}, 1.0, false},
    {"counts", {0, 0, 0, 0, 0, 0, 1}, 1.0, false},
    {"pulse", {0, 0, 0, 0, 0, 0, 1}, 1.0, false},
    {"px", {0, 0, 0, 0, 0, 0, 1}, 1.0, false},
    {"bit", {0, 0, 0, 0, 0, 0, 1}, 1.0, true},
    {"N", {1, 1, -2}, 1.0, true},
    {"Nm", {2, 1, -2}, 1.0, true},
    {"Nmm", {2, 1, -2}, 1e-3, false},
    {"J", {2, 1, -2}, 1.0, true},
    {"W", {2, 1, -3}, 1.0, true},
    {"V", {2, 1, -3, -1}, 1.0, true},
    {"Ohm", {2, 1, -3, -2}, 1.0, true},
    {"Ω", {2, 1, -3, -2}, 1.0, true},
    {"H", {2, 1, -2, -2}, 1.0, true},
    {"F", {-2, -1, 4, 2}, 1.0, true},
};

constexpr std::string_view kBaseSymbols[Unit::kDimensions] = {"m", "kg",  "s",    "A",
                                                              "K", "rad", "count"};

struct Prefix {
  std::string_view text;
  double factor;
};

// Both code points that look like a Greek mu are in use.
constexpr Prefix kPrefixes[] = {
    {"p", 1e-12}, {"n", 1e-9}, {"u", 1e-6}, {"\u00b5", 1e-6}, {"\u03bc", 1e-6},
    {"m", 1e-3},  {"c", 1e-2}, {"k", 1e3},  {"M", 1e6},       {"G", 1e9},
};

struct Superscript {
  std::string_view text;
  int power;
};
constexpr Superscript kSuperscripts[] = {
    {"\u207b\u00b9", -1}, {"\u207b\u00b2", -2}, {"\u00b9", 1}, {"\u00b2", 2}, {"\u00b3", 3}};

constexpr std::string_view kMiddleDot = "\u00b7";

struct Spelling {
  std::string_view word;
  std::string_view symbol;
};
constexpr Spelling kSpellings[] = {
    {"sec", "s"},       {"second", "s"},    {"seconds", "s"},   {"hour", "h"},   {"hours", "h"},
    {"minute", "min"},  {"minutes", "min"}, {"hertz", "Hz"},    {"meter", "m"},  {"meters", "m"},
    {"metre", "m"},     {"degree", "deg"},  {"degrees", "deg"}, {"°", "deg"},    {"radian", "rad"},
    {"radians", "rad"}, {"volt", "V"},      {"volts", "V"},     {"amp", "A"},    {"amps", "A"},
    {"ampere", "A"},    {"newton", "N"},    {"watt", "W"},      {"joule", "J"},  {"kelvin", "K"},
    {"percent", "%"},   {"ticks", "count"}, {"tick", "count"},  {"turns", "rev"}};

bool is_representable(const Unit& unit) { return std::isfinite(unit.factor) && unit.factor > 0.0; }

/// In quotes, and short enough for an error message.
std::string quoted(std::string_view text) {
  constexpr std::size_t kLongest = 80;
  if (text.size() <= kLongest) return "'" + std::string(text) + "'";
  return "'" + std::string(text.substr(0, kLongest)) + "...'";
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = std::min(text.find_first_not_of(kSpace), text.size());
  const std::size_t end = text.find_last_not_of(kSpace);
  return end == std::string_view::npos ? std::string_view() : text.substr(begin, end + 1 - begin);
}

bool take(std::string_view& from, std::string_view what) {
  if (!from.starts_with(what)) return false;
  from.remove_prefix(what.size());
  return true;
}

Unit product(const Unit& a, const Unit& b, int power) {
  Unit result = a;
  for (std::size_t i = 0; i < result.powers.size(); ++i) result.powers[i] += power * b.powers[i];
  for (int i = 0; i < std::abs(power); ++i) {
    result.factor = power > 0 ? result.factor * b.factor : result.factor / b.factor;
  }
  return result;
}

const Symbol* find_symbol(std::string_view text) {
  const auto* const found = std::find_if(std::begin(kSymbols), std::end(kSymbols),
                                         [&](const Symbol& one) { return one.text == text; });
  return found == std::end(kSymbols) ? nullptr : found;
}

std::optional<Unit> find_unit(std::string_view text) {
  if (const Symbol* symbol = find_symbol(text)) return Unit{symbol->powers, symbol->factor};
  for (const Prefix& prefix : kPrefixes) {
    std::string_view rest = text;
    if (!take(rest, prefix.text)) continue;
    const Symbol* symbol = find_symbol(rest);
    if (symbol != nullptr && symbol->takes_prefix) {
      return Unit{symbol->powers, prefix.factor * symbol->factor};
    }
  }
  return std::nullopt;
}

std::string hint_for(std::string_view unknown) {
  if (unknown == "degC" || unknown == "°C") return "a temperature is given in K";
  for (const Spelling& spelling : kSpellings) {
    if (spelling.word == unknown) return "did you mean " + quoted(spelling.symbol) + "?";
  }
  const std::string_view without_digit = unknown.substr(0, unknown.size() - 1);
  if (unknown.back() >= '2' && unknown.back() <= '9' && find_unit(without_digit)) {
    return "did you mean '" + std::string(without_digit) + "^" + unknown.back() + "'?";
  }
  std::vector<std::string> known{"ms", "us", "ns", "kHz",  "mm", "cm", "um",
                                 "km", "kg", "kN", "mrad", "mV", "mA"};
  for (const Symbol& symbol : kSymbols) known.emplace_back(symbol.text);
  return suggestion(unknown, known).text;
}

/// Reads one unit: products by space, `*` or `·`, quotients, powers and parentheses.
class Parser {
 public:
  explicit Parser(std::string_view text) : whole_(text), rest_(text) {}

  Result<Unit> parse() {
    const std::optional<Unit> unit = read_product();
    if (!unit) return Error{problem_};
    if (!rest_.empty()) return Error{problem_at_rest("unexpected")};
    if (!is_representable(*unit))
      return Error{"unit " + quoted(whole_) + " is too large or too small"};
    return *unit;
  }

 private:
  enum class Operator { kNone, kTimes, kPer };

  std::optional<Unit> read_product() {
    std::optional<Unit> unit = read_factor();
    bool was_divided = false;
    while (unit) {
      const Operator next = take_operator();
      if (next == Operator::kNone) break;
      if (next == Operator::kTimes && was_divided) return fail_as_ambiguous();
      was_divided = next == Operator::kPer;
      const std::optional<Unit> factor = read_factor();
      if (!factor) return std::nullopt;
      unit = product(*unit, *factor, was_divided ? -1 : 1);
    }
    return unit;
  }

  std::optional<Unit> read_factor() {
    skip_space();
    const std::optional<Unit> unit = take(rest_, "(") ? read_rest_of_group() : read_symbol();
    if (!unit) return std::nullopt;
    const std::optional<int> power = read_power();
    if (!power) return std::nullopt;
    return product(Unit{}, *unit, *power);
  }

  std::optional<Unit> read_rest_of_group() {
    const std::optional<Unit> unit = read_product();
    if (!unit) return std::nullopt;
    skip_space();
    if (!take(rest_, ")")) return fail("unit " + quoted(whole_) + " lacks a ')'");
    return unit;
  }

  std::optional<Unit> read_symbol() {
    const std::string_view symbol = rest_.substr(0, symbol_length());
    if (symbol.empty()) return fail(problem_at_rest("expected a unit, found"));
    rest_.remove_prefix(symbol.size());
    if (const std::optional<Unit> unit = find_unit(symbol)) return unit;
    const std::string hint = hint_for(symbol);
    return fail("unknown unit " + quoted(symbol) +
                (symbol == whole_ ? "" : " in " + quoted(whole_)) +
                (hint.empty() ? "" : " (" + hint + ")"));
  }

  std::size_t symbol_length() const {
    std::size_t length = std::min(rest_.find_first_of(" \t*/^()"), rest_.size());
    length = std::min(length, rest_.find(kMiddleDot));
    for (const Superscript& superscript : kSuperscripts) {
      length = std::min(length, rest_.find(superscript.text));
    }
    return length;
  }

  std::optional<int> read_power() {
    for (const Superscript& superscript : kSuperscripts) {
      if (take(rest_, superscript.text)) return superscript.power;
    }
    if (!take(rest_, "^")) return 1;
    constexpr int kLargest = 9;
    int power = 0;
    const char* const end = rest_.data() + rest_.size();
    const auto [stopped, problem] = std::from_chars(rest_.data(), end, power);
    if (problem != std::errc() || power == 0 || std::abs(power) > kLargest) {
      fail(problem_at_rest("expected a power from 1 to 9 or -1 to -9 after '^', found"));
      return std::nullopt;
    }
    rest_.remove_prefix(static_cast<std::size_t>(stopped - rest_.data()));
    return power;
  }

  Operator take_operator() {
    const std::size_t before = rest_.size();
    skip_space();
    if (take(rest_, "/")) return Operator::kPer;
    if (take(rest_, "*") || take(rest_, kMiddleDot)) return Operator::kTimes;
    const bool spaced = rest_.size() < before && !rest_.empty() && rest_.front() != ')';
    return spaced ? Operator::kTimes : Operator::kNone;
  }

  void skip_space() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kSpace), rest_.size()));
  }

  std::nullopt_t fail(std::string problem) {
    problem_ = std::move(problem);
    return std::nullopt;
  }

  std::nullopt_t fail_as_ambiguous() {
    return fail("unit " + quoted(whole_) +
                " is ambiguous: a product after '/' needs parentheses, as in 'V/(rad s)'");
  }

  std::string problem_at_rest(const std::string& what) const {
    return what + (rest_.empty() ? " nothing" : " " + quoted(rest_)) + " in unit " + quoted(whole_);
  }

  std::string_view whole_;
  std::string_view rest_;
  std::string problem_;
};

/// `kg m^2 s^-2`, or `a plain number`.
std::string kind_text(const Unit& unit) {
  std::string text;
  for (std::size_t i = 0; i < unit.powers.size(); ++i) {
    if (unit.powers[i] == 0) continue;
    if (!text.empty()) text += ' ';
    text += kBaseSymbols[i];
    if (unit.powers[i] != 1) text += '^' + std::to_string(unit.powers[i]);
  }
  return text.empty() ? "a plain number" : text;
}

/// `value * from / to`, exact for whole ratios: 1 / 1e-9 is not quite 1e9, and x * 1e-3 is not
/// always x / 1000.
double rescaled(double value, double from, double to) {
  constexpr double kRoundingError = 4.0 * std::numeric_limits<double>::epsilon();
  const bool grows = from >= to;
  double ratio = grows ? from / to : to / from;
  const double whole = std::round(ratio);
  if (std::abs(ratio - whole) <= kRoundingError * whole) ratio = whole;
  return grows ? value * ratio : value / ratio;
}

}  // namespace

Result<Unit> parse_unit(std::string_view text) {
  constexpr std::size_t kLongest = 64;
  text = trimmed(text);
  if (text.empty()) return Unit{};
  if (text.size() > kLongest) {
    return Error{"unit " + quoted(text) + " is longer than " + std::to_string(kLongest) + " bytes"};
  }
  return Parser(text).parse();
}

namespace {

/// Between the units of which a value may be in either, such as "rad or m".
constexpr std::string_view kOr = " or ";

/// What follows the digits of a number begins as the fraction of one does where commas are usual.
bool has_decimal_comma(std::string_view rest) {
  return rest.size() > 1 && rest[0] == ',' && rest[1] >= '0' && rest[1] <= '9';
}

}  // namespace

Result<Quantity> parse_quantity(std::string_view text) {
  const std::string_view whole = trimmed(text);
  double value = 0.0;
  const auto [end, problem] = std::from_chars(whole.data(), whole.data() + whole.size(), value);
  if (problem == std::errc::result_out_of_range) {
    return Error{"number " + quoted(whole) + " is too large or too small for a double"};
  }
  if (problem != std::errc() || !std::isfinite(value)) {
    return Error{"expected a finite number, such as '0.5' or '10 ms', found " + quoted(whole)};
  }
  const std::string_view rest = whole.substr(static_cast<std::size_t>(end - whole.data()));
  if (has_decimal_comma(rest)) {
    const std::string before(whole.substr(0, whole.size() - rest.size()));
    return Error{quoted(whole) + " has a decimal comma; write a point: " +
                 quoted(before + "." + std::string(rest.substr(1)))};
  }
  const std::string_view unit = trimmed(rest);
  if (const Result<Unit> parsed = parse_unit(unit); !parsed) {
    return Error{quoted(whole) + ": " + parsed.error()};
  }
  return Quantity{value, std::string(unit)};
}

Result<double> convert(double value, std::string_view from, std::string_view to) {
  if (const auto at = to.find(kOr); at != std::string_view::npos) {
    const Result<double> one = convert(value, from, to.substr(0, at));
    if (one) return one;
    const Result<double> other = convert(value, from, to.substr(at + kOr.size()));
    return other ? other : one;
  }
  const Result<Unit> source = parse_unit(from);
  if (!source) return Error{source.error()};
  const Result<Unit> target = parse_unit(to);
  if (!target) return Error{target.error()};
  if (!source.value().same_kind(target.value())) {
    return Error{"cannot convert " + quoted(from) + " to " + quoted(to) + ": the first is " +
                 kind_text(source.value()) + ", the second " + kind_text(target.value())};
  }
  const double result = rescaled(value, source.value().factor, target.value().factor);
  if (!std::isfinite(result)) {
    return Error{"a value in " + quoted(from) + " is not a finite number in " + quoted(to)};
  }
  return result;
}

}  // namespace armature::base
