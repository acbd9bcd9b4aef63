// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "armature/base/diagnostic.hpp"

namespace armature::websocket::internal {

/// What lets this side in at addresses of pages: a file with the addresses as applications tell
/// them, one a line, such as `http://127.0.0.1:8080/#4a33af8cfbb791ad7c8467a08ce2b687`. Each token
/// goes to its own address and to no other.
/// @thread any
class Tokens {
 public:
  /// @param path  empty: there are none
  /// @param diagnostics  each line that is no such address; a file that others may read is warned
  /// of
  static Tokens load(const std::string& path, base::Diagnostics& diagnostics);
  static Tokens parse(std::string_view text, const std::string& file,
                      base::Diagnostics& diagnostics);

  /// Empty: there is none.
  /// @param origin  `http://127.0.0.1:8080`
  std::string of(const std::string& origin) const;

 private:
  std::map<std::string, std::string> by_origin_;
};

}  // namespace armature::websocket::internal
