// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "armature/base/time.hpp"

namespace armature::ride::internal {

class Link;

/// Links that are looked after once in an interval, each until it needs it no more.
/// @thread the node's
class LinkRounds {
 public:
  /// @param look  true if the link needs it no more
  LinkRounds(base::Duration interval, std::function<bool(Link&, base::Time now)> look)
      : interval_(interval), look_(std::move(look)) {}

  void reserve(std::size_t links) { links_.reserve(links); }
  void add(std::shared_ptr<Link> link, base::Time now) {
    links_.push_back(std::move(link));
    due_ = std::min(due_, now + interval_);
  }
  /// When the next round is to be made; the end of time if no link needs it.
  base::Time due() const { return due_; }
  bool is_empty() const { return due_ == base::Time::max(); }
  void make_if_due(base::Time now) {
    if (now < due_) return;
    std::erase_if(links_, [&](const auto& link) { return look_(*link, now); });
    due_ = links_.empty() ? base::Time::max() : now + interval_;
  }

 private:
  const base::Duration interval_;
  const std::function<bool(Link&, base::Time)> look_;
  std::vector<std::shared_ptr<Link>> links_;
  base::Time due_ = base::Time::max();
};

}  // namespace armature::ride::internal
