// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/entrance.hpp"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <system_error>
#include <utility>

#include "armature/foxglove/server.hpp"
#include "armature/ride/policy.hpp"
#include "armature/studio/internal/operators_bench.hpp"

namespace armature::studio::internal {
namespace {

namespace fs = std::filesystem;

/// A short name for a long path (FNV-1a).
std::string name_for(const std::string& path) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char byte : path) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

/// The folder of a deployment or address among those that studios have left.
std::string folder_of(const ServerOptions& options, const std::string& subject,
                      base::Diagnostics& diagnostics) {
  std::error_code failure;
  const fs::path folder = fs::path(options.folder) / name_for(subject);
  fs::create_directories(folder, failure);
  if (failure) {
    diagnostics.error({}, "cannot make the folder '" + folder.string() + "': " + failure.message());
    return {};
  }
  // What lets pages in, logs of runs, and a socket by which they are commanded: for nobody else.
  fs::permissions(folder, fs::perms::owner_all, failure);
  if (failure) {
    diagnostics.error({}, "cannot keep the folder '" + folder.string() +
                              "' for this account alone: " + failure.message());
    return {};
  }
  return folder.string();
}

/// Without a policy whoever has the page's address may do all.
std::function<bool(const ride::AccessQuestion&)> allowance(const std::string& policy_file,
                                                           base::Diagnostics& diagnostics) {
  if (policy_file.empty()) return [](const ride::AccessQuestion&) { return true; };
  ride::Policy policy = ride::Policy::load(policy_file, diagnostics);
  policy.check({OperatorsBench::kName, kRunName}, diagnostics);
  return [policy](const ride::AccessQuestion& question) { return policy.allows(question); };
}

}  // namespace

std::optional<Entrance> make_entrance(const ServerOptions& options, const std::string& subject,
                                      base::Diagnostics& diagnostics) {
  Entrance entrance;
  entrance.folder = folder_of(options, subject, diagnostics);
  if (entrance.folder.empty()) return std::nullopt;
  auto lock = platform::FolderLock::take(entrance.folder);
  if (lock) {
    entrance.lock = std::move(lock.value());
  } else {
    diagnostics.error({}, "another studio has '" + options.file + "' open: " + lock.error());
  }
  entrance.messages = foxglove::make_messages();
  entrance.transport =
      websocket::make_transport({.pages = options.pages,
                                 .certificate = options.certificate,
                                 .key = options.key,
                                 .secrets = (fs::path(entrance.folder) / "entry").string(),
                                 .messages = entrance.messages},
                                diagnostics);
  entrance.node.name = "studio";
  entrance.node.log = options.log;
  entrance.node.allows = allowance(options.policy, diagnostics);
  entrance.node.transports.push_back(entrance.transport);
  if (!diagnostics.ok()) return std::nullopt;
  return entrance;
}

}  // namespace armature::studio::internal
