// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/browser/internal/display.hpp"
#include "armature/browser/internal/session.hpp"
#include "armature/browser/internal/spelled_view.hpp"
#include "armature/browser/internal/surface.hpp"

namespace armature::browser::internal {

/// Values that are looked at again and again: `watch ITEM ... [every SECONDS] [for SECONDS]`.
class Watch {
 public:
  static base::Result<Watch> parse(SpelledView& view, const std::vector<std::string>& words);

  base::Duration every() const { return every_; }
  const std::optional<base::Duration>& limit() const { return limit_; }

  /// The items in lines of their own, to be shown in place.
  std::string picture(const Paper& paper, SpelledView& view) const;
  /// One line for each moment, `seconds` behind which the values stand; and what is above them.
  std::string heading(const Paper& paper) const;
  std::string line(const Paper& paper, SpelledView& view, double seconds) const;

 private:
  /// What is looked at.
  struct Item {
    std::string text;
    std::string unit;
  };
  std::vector<inspect::ItemValue> read(SpelledView& view) const;
  std::vector<std::string> values(SpelledView& view) const;
  static std::string name_of(const Item& item);
  bool fits(const Paper& paper) const;

  std::vector<Item> items_;
  base::Duration every_ = std::chrono::milliseconds(200);
  std::optional<base::Duration> limit_;
};

/// Shows the values as they change, until a key, Ctrl-C or the watch's end: in place, or a line for
/// each step, ten of them unless the watch says more.
void watch_in_place(const Watch& watch, SpelledView& view, Session& session, Surface& surface);
void watch_by_lines(const Watch& watch, SpelledView& view, Session& session, Surface& surface);

/// A time above 0 in seconds, `0.2`, or with its unit, `20ms`.
std::optional<base::Duration> seconds_in(std::string_view text);

}  // namespace armature::browser::internal
