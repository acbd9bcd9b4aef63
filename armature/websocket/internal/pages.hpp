// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "armature/base/result.hpp"

namespace armature::websocket::internal {

/// A file that is served.
struct Page {
  std::string file;
  std::string type;  ///< as HTTP says it: `text/html; charset=utf-8`
};

/// The files of a folder, and no others.
class Pages {
 public:
  /// The error says why the folder cannot be served.
  static base::Result<Pages> in(const std::string& folder);

  /// What a request's path names: of a folder its index.html. Nothing for a name that begins with
  /// a dot, a link that leads out of the folder, and a type that no page needs.
  std::optional<Page> find(std::string_view path) const;

 private:
  explicit Pages(std::string folder) : folder_(std::move(folder)) {}
  std::string folder_;  ///< without links
};

}  // namespace armature::websocket::internal
