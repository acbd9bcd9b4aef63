// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "armature/component/properties/property.hpp"

namespace armature::controllers {

/// Whether properties changed since somebody asked, for what is computed from them once and may
/// allocate: it is computed by on_configure, and by on_start only if a property was set in between.
class Changes final : public component::PropertyFollower {
 public:
  template <typename... Properties>
  explicit Changes(Properties&... properties) {
    (properties.add_follower(*this), ...);
  }
  Changes(const Changes&) = delete;
  Changes& operator=(const Changes&) = delete;

  bool take() { return std::exchange(changed_, false); }

  void follow() override { changed_ = true; }
  std::string objection() const override { return {}; }

 private:
  bool changed_ = false;
};

}  // namespace armature::controllers
