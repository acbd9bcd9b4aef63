// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"

namespace armature::bundle::internal {

/// Where something is made: a folder beside its target, which is gone when this object is, unless
/// it was handed over. Errors name the file and the system's reason.
class Staging {
 public:
  /// @param target  a file or folder that need not be there; its folder has to be
  explicit Staging(std::string target);
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;
  ~Staging();

  base::Result<void> make();
  const std::string& folder() const { return folder_; }

  /// @param place  relative; its folders are made
  base::Result<void> write(const std::string& place, std::string_view content, bool executable);
  /// Places of all files, sorted.
  std::vector<std::string> places() const;
  std::uint64_t size() const;

  /// Gives all files and folders this time, in seconds since 1970.
  void set_times(std::int64_t seconds) const;

  /// Puts `made`, the folder or something in it, in the place of the target as a whole.
  base::Result<void> hand_over(const std::string& made);

 private:
  const std::string target_;
  const std::string folder_;
  bool made_ = false;
};

}  // namespace armature::bundle::internal
