// SPDX-License-Identifier: Apache-2.0
#include "drives/cia402/emulator_command.hpp"

#include <array>
#include <cstdio>
#include <optional>
#include <sstream>
#include <vector>

#include "drives/canopen/emergency.hpp"

namespace armature::cia402 {
namespace {

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// A number as people write it, decimal or with 0x.
std::optional<unsigned long> parse_count(const std::string& text) {
  if (text.empty() || text[0] < '0' || text[0] > '9') return std::nullopt;
  char* end = nullptr;
  const unsigned long value = std::strtoul(text.c_str(), &end, 0);
  if (*end != '\0' || value > 0xffff'ffffUL) return std::nullopt;
  return value;
}

/// Does the verb to the drive; false if it is unknown or its numbers are wrong.
bool obey(EmulatedDrive& drive, const std::string& verb, const std::vector<unsigned long>& numbers,
          base::Time now) {
  if (verb == "fail" && numbers.size() <= 1) {
    const unsigned long code = numbers.empty() ? canopen::emergency_code::kGeneric : numbers[0];
    if (code > 0xffff) return false;
    drive.fail(static_cast<std::uint16_t>(code));
    return true;
  }
  if (verb == "identity" && numbers.size() == 2) {
    drive.set_identity({.vendor = static_cast<std::uint32_t>(numbers[0]),
                        .product = static_cast<std::uint32_t>(numbers[1]),
                        .revision = 1,
                        .serial = 1});
    return true;
  }
  if (!numbers.empty()) return false;
  if (verb == "deaf") {
    drive.set_deaf_to_sync(true);
  } else if (verb == "stuck") {
    drive.device().set_stuck_pdos(true);
  } else if (verb == "silent") {
    drive.device().set_silent_heartbeat(true);
  } else if (verb == "frozen") {
    drive.set_frozen(true);
  } else if (verb == "powerless") {
    drive.set_powerless(true);
  } else if (verb == "nomains") {
    drive.set_without_mains(true);
  } else if (verb == "reboot") {
    drive.reboot(now);
  } else if (verb == "mend") {
    drive.set_deaf_to_sync(false);
    drive.set_frozen(false);
    drive.set_powerless(false);
    drive.set_without_mains(false);
    drive.device().set_stuck_pdos(false);
    drive.device().set_silent_heartbeat(false);
  } else {
    return false;
  }
  return true;
}

}  // namespace

std::string emulator_commands() {
  return "  state                         how all drives are\n"
         "  fail NODE [CODE]              the drive fails and sends EMCY, with code 0x1000 if none "
         "is given\n"
         "  deaf NODE                     it hears no SYNC\n"
         "  stuck NODE                    it sends no PDOs\n"
         "  silent NODE                   it sends no heartbeats\n"
         "  frozen NODE                   it tells for ever what it told last\n"
         "  powerless NODE                its motor gets no current, and it does not notice\n"
         "  nomains NODE                  it is not switched on any more, for want of voltage\n"
         "  mend NODE                     it hears and sends again\n"
         "  reboot NODE                   it loses its power for a moment\n"
         "  identity NODE VENDOR PRODUCT  it says that it is another drive\n";
}

std::string describe(const EmulatedDrive& drive) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "node %u: %s, %s, %s, %.4f rad, %.4f rad/s, %.3f N m",
                static_cast<unsigned>(drive.device().node()), to_text(drive.device().state()),
                to_text(drive.power()), to_text(drive.mode()), drive.axis().position(),
                drive.axis().velocity(), drive.axis().torque());
  return text.data();
}

base::Result<std::string> give_command(EmulatedBus& drives, const std::string& line,
                                       base::Time now) {
  const std::vector<std::string> words = words_of(line);
  if (words.empty()) return std::string();
  std::string told;
  if (words.size() == 1 && words[0] == "state") {
    for (std::size_t i = 0; i < drives.size(); ++i) told += describe(drives.drive(i)) + "\n";
    return told;
  }
  const base::Error wrong{"'" + line + "' is not understood; expected one of\n" +
                          emulator_commands()};
  std::vector<unsigned long> numbers;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const auto number = parse_count(words[i]);
    if (!number) return wrong;
    numbers.push_back(*number);
  }
  if (numbers.empty()) return wrong;
  EmulatedDrive* const drive =
      numbers[0] <= canopen::kLastNode ? drives.find(static_cast<unsigned>(numbers[0])) : nullptr;
  if (drive == nullptr) {
    return base::Error{"'" + line + "': no drive has node " + words[1] + ", expected " +
                       std::to_string(drives.drive(0).device().node()) + " to " +
                       std::to_string(drives.drive(drives.size() - 1).device().node())};
  }
  numbers.erase(numbers.begin());
  if (!obey(*drive, words[0], numbers, now)) return wrong;
  return std::string();
}

}  // namespace armature::cia402
