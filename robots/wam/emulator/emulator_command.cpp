// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/emulator/emulator_command.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <sstream>
#include <vector>

#include "armature/base/near_name.hpp"
#include "armature/base/seconds.hpp"

namespace armature::wam {
namespace {

using Arm = EmulatedArm;
using Command = EmulatorCommand;

/// What stands behind a command's words; a form without needs none.
struct Number {
  const char* name = nullptr;
  double least = 0.0;
  double most = 0.0;
  bool whole = false;
};
constexpr Number kNoNumber{};
constexpr Number kCount{"COUNT", 1, 1'000'000, true};
constexpr Number kMilliseconds{"MS", 0, 10'000, false};
constexpr Number kVolts{"VOLTS", 0, 200, false};
constexpr Number kVersion{"VERSION", 0, 255, true};

constexpr bool kNeedsBitRate = true;

struct Form {
  const char* words;  ///< N stands for the number of a puck
  Number number;
  const char* meaning;
  void (*act)(const Arm& arm, const Command& command);
  bool needs_bit_rate = false;
};

Puck& puck_of(const Arm& arm, const Command& command) { return arm.emulator.puck(command.motor); }
SafetyBoard& board_of(const Arm& arm) { return arm.emulator.board(); }
int count_of(const Command& command) { return static_cast<int>(command.value); }
std::uint64_t frames_of(const Command& command) {
  return static_cast<std::uint64_t>(command.value);
}
base::Duration delay_of(const Command& command) {
  return base::from_seconds(command.value / 1000.0);
}

template <ReplySpoil How>
void spoil(const Arm& arm, const Command& command) {
  puck_of(arm, command).spoil_replies(How, count_of(command));
}
template <Monitor Which>
void trip(const Arm& arm, const Command& /*command*/) {
  board_of(arm).fail(Which);
}

constexpr auto kForms = std::to_array<Form>({
    {"estop", kNoNumber, "presses the E-stop button: the pucks lose power and positions",
     [](const Arm& arm, const Command&) { board_of(arm).estop(); }},
    {"release", kNoNumber, "pulls the E-stop button out",
     [](const Arm& arm, const Command&) { board_of(arm).reset(); }},
    {"idle", kNoNumber, "Shift+Idle: power for the pucks, or an end to torques and faults",
     [](const Arm& arm, const Command&) { board_of(arm).shift_idle(); }},
    {"activate", kNoNumber, "Shift+Activate: the pucks obey torques",
     [](const Arm& arm, const Command&) { board_of(arm).shift_activate(); }},
    {"home", kNoNumber,
     "carries the arm to its home position and holds it there until a motor drives",
     [](const Arm& arm, const Command&) { arm.motors.carry_to(arm.numbers.home); }},

    {"fault puck N silent", kNoNumber, "neither hears nor is heard; its motor goes on",
     [](const Arm& arm, const Command& command) { puck_of(arm, command).set_dead(true); }},
    {"fault puck N heals", kNoNumber, "is no longer silent",
     [](const Arm& arm, const Command& command) { puck_of(arm, command).set_dead(false); }},
    {"fault puck N lose", kCount, "does not send its next answers",
     [](const Arm& arm, const Command& command) {
       puck_of(arm, command).lose_replies(count_of(command));
     }},
    {"fault puck N delay", kMilliseconds, "answers later by that; 0 ends it",
     [](const Arm& arm, const Command& command) {
       puck_of(arm, command).delay_replies(delay_of(command));
     }},
    {"fault puck N wrong-property", kCount, "names the next property in its answers",
     spoil<ReplySpoil::kWrongProperty>},
    {"fault puck N wrong-length", kCount, "leaves out their last byte",
     spoil<ReplySpoil::kWrongLength>},
    {"fault puck N wrong-byte", kCount, "has no zero in their second byte",
     spoil<ReplySpoil::kSecondByte>},
    {"fault puck N twice", kCount, "sends them twice", spoil<ReplySpoil::kTwice>},
    {"fault puck N firmware", kVersion, "says that it has this firmware, and has it not",
     [](const Arm& arm, const Command& command) {
       puck_of(arm, command).tell_version(static_cast<int>(command.value));
     }},
    {"fault puck N bus-off", kNoNumber, "its controller has made too many errors",
     [](const Arm& arm, const Command& command) {
       puck_of(arm, command).station().force_bus_off();
     }},

    {"fault board silent", kNoNumber, "neither hears nor is heard",
     [](const Arm& arm, const Command&) { board_of(arm).set_dead(true); }},
    {"fault board heals", kNoNumber, "is no longer silent",
     [](const Arm& arm, const Command&) { board_of(arm).set_dead(false); }},
    {"fault board lose", kCount, "does not send its next answers",
     [](const Arm& arm, const Command& command) { board_of(arm).lose_replies(count_of(command)); }},
    {"fault board delay", kMilliseconds, "answers later by that; 0 ends it",
     [](const Arm& arm, const Command& command) {
       board_of(arm).delay_replies(delay_of(command));
     }},
    {"fault board velocity", kNoNumber, "says that the arm was too fast", trip<Monitor::kVelocity>},
    {"fault board torque", kNoNumber, "says that a torque was too high", trip<Monitor::kTorque>},
    {"fault board voltage", kNoNumber, "says that the supply was bad", trip<Monitor::kVoltage>},
    {"fault board heartbeat", kNoNumber, "says that the host was silent",
     trip<Monitor::kHeartbeat>},
    {"fault board other", kNoNumber, "says that there was something else", trip<Monitor::kOther>},
    {"fault board supply", kVolts, "the motors' supply from now on; good is 48",
     [](const Arm& arm, const Command& command) { board_of(arm).set_supply(command.value); }},

    {"fault bus lose", kCount, "no station receives the next frames",
     [](const Arm& arm, const Command& command) {
       arm.emulator.bus().lose_next(frames_of(command));
     }},
    {"fault bus corrupt", kCount, "the next frames are destroyed, and so sent again",
     [](const Arm& arm, const Command& command) {
       arm.emulator.bus().corrupt_next(frames_of(command));
     },
     kNeedsBitRate},
    {"fault bus cut", kNoNumber, "no station hears another",
     [](const Arm& arm, const Command&) { arm.emulator.bus().set_cut(true); }, kNeedsBitRate},
    {"fault bus heals", kNoNumber, "is no longer cut",
     [](const Arm& arm, const Command&) { arm.emulator.bus().set_cut(false); }},
});

using Words = std::vector<std::string>;

Words words_in(std::string_view text) {
  std::istringstream stream{std::string(text)};
  Words words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::optional<double> number_in(const std::string& word) {
  double value = 0.0;
  const char* const end = word.data() + word.size();
  const auto [last, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc{} || last != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string syntax(const Form& form) {
  return std::string(form.words) +
         (form.number.name != nullptr ? ' ' + std::string(form.number.name) : "");
}

/// Whether a line begins as the form has it, whatever the numbers are.
bool begins_as(const Words& line, const Words& form) {
  if (line.size() < form.size()) return false;
  return std::equal(
      form.begin(), form.end(), line.begin(),
      [](const auto& wanted, const auto& word) { return wanted == "N" || wanted == word; });
}

base::Error unknown(const Words& words) {
  std::string said;
  std::vector<std::string> known;
  for (const std::string& word : words) said += (said.empty() ? "" : " ") + word;
  for (const Form& form : kForms) known.emplace_back(form.words);
  const std::string hint = base::suggestion(said, known).text;
  return {"'" + said + "' is not a command; " + (hint.empty() ? "'help' lists them all" : hint)};
}

base::Error wrong_number(const Form& form, const std::string& found) {
  char range[96];
  std::snprintf(range, sizeof range, "%s from %.10g to %.10g",
                form.number.whole ? "a whole number" : "a number", form.number.least,
                form.number.most);
  return {"'" + syntax(form) + "': expected for " + form.number.name + " " + range + ", found '" +
          found + "'"};
}

base::Result<EmulatorCommand> parse_as(const Form& form, const Words& words, std::size_t motors) {
  EmulatorCommand command{.act = form.act, .needs_bit_rate = form.needs_bit_rate};
  const Words wanted = words_in(form.words);
  if (const auto n = std::find(wanted.begin(), wanted.end(), "N"); n != wanted.end()) {
    const std::string& word = words[static_cast<std::size_t>(n - wanted.begin())];
    const auto puck = number_in(word);
    const double last = static_cast<double>(motors);
    if (!puck || *puck < 1.0 || *puck > last || *puck != std::floor(*puck)) {
      return base::Error{"'" + syntax(form) + "': expected for N a puck of this arm, 1 to " +
                         std::to_string(motors) + ", found '" + word + "'"};
    }
    command.motor = static_cast<std::size_t>(*puck) - 1;
  }
  const std::size_t numbers = form.number.name != nullptr ? 1 : 0;
  if (words.size() > wanted.size() + numbers) {
    return base::Error{"'" + syntax(form) + "': expected nothing more, found '" + words.back() +
                       "'"};
  }
  if (numbers == 0) return command;
  if (words.size() == wanted.size()) return wrong_number(form, "nothing");
  const auto value = number_in(words.back());
  if (!value || *value < form.number.least || *value > form.number.most ||
      (form.number.whole && *value != std::floor(*value))) {
    return wrong_number(form, words.back());
  }
  command.value = *value;
  return command;
}

}  // namespace

base::Result<EmulatorCommand> parse_emulator_command(std::string_view line, std::size_t motors) {
  const Words words = words_in(line);
  for (const Form& form : kForms) {
    if (begins_as(words, words_in(form.words))) return parse_as(form, words, motors);
  }
  return unknown(words);
}

std::string emulator_commands() {
  std::string all;
  for (const Form& form : kForms) {
    char line[160];
    std::snprintf(line, sizeof line, "  %-34s %s\n", syntax(form).c_str(), form.meaning);
    all += line;
  }
  return all;
}

}  // namespace armature::wam
