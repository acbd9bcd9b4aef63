// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the programs of this folder have between them: a component, and how both ends reach it.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "armature/base/diagnostic.hpp"
#include "armature/ride/node.hpp"
#include "armature/ride/placeholder.hpp"
#include "armature/ride/service.hpp"
#include "armature/tls/transport.hpp"

namespace hostile {

namespace ride = armature::ride;

/// Raised a thousand times a second.
struct Tick {
  std::int32_t number = 0;
};
inline void encode(ride::Encoder& to, const Tick& tick) { to.put(tick.number); }
inline bool decode(ride::Decoder& from, Tick& tick) { return from.take(tick.number); }
constexpr ride::Number event_number(const Tick*) { return ride::number_of("event Tick{int}"); }

inline constexpr ride::Declaration kRobotDeclarations[] = {
    {"unsigned long messages()", ride::Access::kRead},  ///< that the node has taken so far
    {"unsigned long moves()", ride::Access::kRead},     ///< commands that were executed so far
    {"String echo(String)", ride::Access::kRead},
    {"void move()", ride::Access::kCommand},
    {"int count(Array<String>)", ride::Access::kRead},
    {"void load(String)", ride::Access::kCommand},
    {"event Tick{int}", ride::Access::kRead},
};
inline constexpr ride::Interface kRobot{"Robot", kRobotDeclarations};
inline constexpr ride::Number kMessages = kRobotDeclarations[0].number();
inline constexpr ride::Number kMoves = kRobotDeclarations[1].number();
inline constexpr ride::Number kEcho = kRobotDeclarations[2].number();
inline constexpr ride::Number kMove = kRobotDeclarations[3].number();
inline constexpr ride::Number kCount = kRobotDeclarations[4].number();

/// TLS with the files NAME.pem, NAME.key and authority.pem of a folder.
inline std::shared_ptr<ride::Transport> tls_of(const std::string& folder, const std::string& name) {
  armature::base::Diagnostics diagnostics;
  std::shared_ptr<ride::Transport> made = armature::tls::make_transport(
      {folder + "/" + name + ".pem", folder + "/" + name + ".key", folder + "/authority.pem"},
      diagnostics);
  if (made == nullptr) {
    std::fputs(diagnostics.to_text().c_str(), stderr);
    std::exit(1);
  }
  return made;
}

}  // namespace hostile
