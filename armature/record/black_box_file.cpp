// SPDX-License-Identifier: Apache-2.0
#include "armature/record/black_box_file.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "armature/platform/clock.hpp"
#include "armature/record/internal/seconds_text.hpp"
#include "armature/record/mcap_writer.hpp"
#include "armature/types/struct.hpp"

namespace armature::record {

/// A message of the channel `events`.
struct Happening {
  std::string component;
  std::string kind;
  std::string item;
  std::string text;
};
ARMATURE_STRUCT(Happening, component, kind, item, text);

namespace {

constexpr int kMostOfOneSecond = 100;

/// Without what file systems do not like.
std::string plain(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == ':' || c == '/'; }, '-');
  return text;
}

base::Result<std::unique_ptr<McapWriter>> create_file(const exec::BlackBoxReport& report,
                                                      const std::string& folder,
                                                      std::string& path) {
  constexpr std::size_t kSeconds = sizeof "2026-11-22T10:20:30" - 1;
  const std::string time(platform::wall_clock_text().text, kSeconds);
  const std::string name = plain("blackbox-" + report.component + "-" + time);
  const std::filesystem::path base = std::filesystem::path(folder) / name;
  std::error_code ignored;
  path = base.string() + ".mcap";
  for (int i = 2; i < kMostOfOneSecond && std::filesystem::exists(path, ignored); ++i) {
    path = base.string() + "-" + std::to_string(i) + ".mcap";
  }
  return McapWriter::create(path);
}

std::optional<base::Error> write_samples(const exec::BlackBoxReport& report, McapWriter& writer) {
  std::vector<std::uint32_t> sequences;
  for (const auto& channel : report.channels) {
    const auto added = writer.add_channel({channel.name, channel.shape, channel.unit, channel.doc});
    if (!added) return base::Error{added.error()};
    sequences.push_back(0);
  }
  for (const auto& sample : report.samples) {
    const auto channel = static_cast<ChannelId>(sample.channel);
    const auto written =
        writer.write({channel, sample.time, ++sequences[sample.channel], sample.value});
    if (!written) return base::Error{written.error()};
  }
  return std::nullopt;
}

std::optional<base::Error> write_happenings(const exec::BlackBoxReport& report,
                                            McapWriter& writer) {
  const auto channel = writer.add_channel(
      {"events", types::Value::of(Happening{}), {}, "states, faults, commands, acts of tools"});
  if (!channel) return base::Error{channel.error()};
  std::uint32_t sequence = 0;
  for (const auto& each : report.happenings) {
    const Happening happening{each.component, each.kind, each.item, each.text};
    std::vector<std::byte> bytes;
    types::encode(types::type_of<Happening>(), &happening, bytes);
    const auto written = writer.write({channel.value(), each.time, ++sequence, bytes});
    if (!written) return base::Error{written.error()};
  }
  return std::nullopt;
}

}  // namespace

base::Result<std::string> write_black_box(const exec::BlackBoxReport& report,
                                          const std::string& folder) {
  std::string path;
  auto created = create_file(report, folder, path);
  if (!created) return base::Error{created.error()};
  McapWriter& writer = *created.value();
  std::map<std::string, std::string> facts{{"component", report.component},
                                           {"reason", report.reason},
                                           {"time_s", internal::seconds_text(report.time)}};
  if (!report.incomplete.empty()) facts["incomplete"] = report.incomplete;
  const auto named = writer.add_metadata("fault", facts);
  if (!named) return base::Error{named.error()};
  if (const auto failure = write_samples(report, writer)) return *failure;
  if (const auto failure = write_happenings(report, writer)) return *failure;
  const auto closed = writer.close();
  if (!closed) return base::Error{closed.error()};
  return path;
}

std::string say_written(const exec::BlackBoxReport& report, const std::string& folder) {
  const auto path = write_black_box(report, folder);
  return path ? "what led to the fault of " + report.component + " is in " + path.value()
              : "what led to the fault of " + report.component + " is lost: " + path.error();
}

}  // namespace armature::record
