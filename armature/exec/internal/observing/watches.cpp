// SPDX-License-Identifier: Apache-2.0
#include "armature/exec/internal/observing/watches.hpp"

#include <limits>
#include <utility>

namespace armature::exec::internal {

base::Result<std::int32_t> Watches::begin(const std::vector<WatchedNumber>& numbers,
                                          base::Duration interval) {
  std::map<Index, std::pair<std::vector<WatchedNumber>, std::vector<std::size_t>>> by_thread;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const Index thread = plan_.thread_of[roster_.index_of(*numbers[i].component)];
    by_thread[thread].first.push_back(numbers[i]);
    by_thread[thread].second.push_back(i);
  }
  Watch watch;
  watch.sample.values.assign(numbers.size(), std::numeric_limits<double>::quiet_NaN());
  watch.sample.times.assign(numbers.size(), base::Time::min());
  for (auto& [thread, own] : by_thread) {
    component::Component& first = *own.first.front().component;
    auto copied = std::make_shared<ThreadWatch>(std::move(own.first), interval);
    if (!attach(copied)) {
      for (const Part& part : watch.parts) detach(part);
      return base::Error{not_answered(first)};
    }
    watch.parts.push_back({std::move(copied), std::move(own.second)});
  }
  watches_.emplace(++last_handle_, std::move(watch));
  return last_handle_;
}

const WatchSample* Watches::newest(std::int32_t handle) {
  const auto found = watches_.find(handle);
  if (found == watches_.end()) return nullptr;
  Watch& watch = found->second;
  for (Part& part : watch.parts) take(part, watch.sample);
  return &watch.sample;
}

void Watches::take(Part& part, WatchSample& into) {
  const ThreadWatch::Picture& picture = part.watch->newest();
  if (picture.number == part.taken) return;
  into.replaced += picture.number - part.taken - 1;
  part.taken = picture.number;
  for (std::size_t i = 0; i < part.places.size(); ++i) {
    into.values[part.places[i]] = picture.values[i];
    into.times[part.places[i]] = picture.times[i];
  }
}

void Watches::end(std::int32_t handle) {
  const auto found = watches_.find(handle);
  if (found == watches_.end()) return;
  for (const Part& part : found->second.parts) detach(part);
  watches_.erase(found);
}

void Watches::end_all() {
  watches_.clear();
  abandoned_.clear();
}

std::vector<std::shared_ptr<ThreadWatch>> Watches::give_away() {
  for (auto& [handle, watch] : watches_) {
    for (Part& part : watch.parts) abandoned_.push_back(std::move(part.watch));
  }
  watches_.clear();
  return std::move(abandoned_);
}

bool Watches::attach(const std::shared_ptr<ThreadWatch>& watch) {
  component::Component& first = *watch->numbers().front().component;
  Engine& engine = engine_of(first);
  if (executor_.run_in_thread_of(first, [&engine, watch] { engine.attach(*watch); })) return true;
  abandoned_.push_back(watch);
  return false;
}

void Watches::detach(const Part& part) {
  component::Component& first = *part.watch->numbers().front().component;
  Engine& engine = engine_of(first);
  const auto& watch = part.watch;
  if (executor_.run_in_thread_of(first, [&engine, watch] { engine.detach(*watch); })) return;
  abandoned_.push_back(watch);
}

Engine& Watches::engine_of(const component::Component& component) const {
  return *engines_[plan_.thread_of[roster_.index_of(component)]];
}

}  // namespace armature::exec::internal
