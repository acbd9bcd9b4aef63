// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/base/time.hpp"
#include "armature/ride/origin.hpp"
#include "inspection_types.hpp"

namespace armature::studio::internal {

/// Where the numbers of the items stand among those that a watch gives: `Sensor.sensor` has those
/// of `Sensor.sensor[1]`, `Sensor.sensor[2]`, and so on.
std::vector<std::size_t> places_of(const std::vector<std::string>& items,
                                   const std::vector<remote::WatchedItem>& given);

/// A run, as far as it is watched. Each answers later, by any thread.
class WatchedRun {
 public:
  template <typename T>
  using Told = std::function<void(const base::Result<T>&)>;

  virtual ~WatchedRun() = default;
  virtual void watch(const std::vector<std::string>& items, double interval,
                     Told<remote::Watch> told) = 0;
  virtual void watched(std::int32_t handle, Told<remote::WatchedValues> told) = 0;
  virtual void end_watch(std::int32_t handle) = 0;
};

/// What pages watch of a run, as one watch of all their items: each page gets its own numbers of
/// it. However many look, the run copies each number once, and is asked once for a sample. Items
/// that the run does not take together with the others are watched beside them.
/// @thread any
class WatchUnion : public std::enable_shared_from_this<WatchUnion> {
 public:
  template <typename T>
  using Told = WatchedRun::Told<T>;
  /// Pages, and what one page, may have begun.
  static constexpr std::size_t kMost = 64;
  static constexpr std::size_t kMostOfOne = 16;

  /// @param wake   called by any thread when `advance` has something to do
  /// @param clock  monotonic
  WatchUnion(std::function<void()> wake, std::function<base::Time()> clock)
      : wake_(std::move(wake)), clock_(std::move(clock)) {}

  /// @param interval  between two samples [s]
  /// @param told  the items with a handle of the union's own, or why the run does not watch them
  void watch(WatchedRun& run, std::vector<std::string> items, double interval,
             const ride::Origin& page, Told<remote::Watch> told);
  /// A sample that is no older than most of the interval, or the next one that the run gives.
  void watched(WatchedRun& run, std::int32_t handle, Told<remote::WatchedValues> told);
  /// @return whether there was one
  bool end(std::int32_t handle);
  /// Ends those of pages that have gone. Some ten times a second, before `advance`.
  void end_lost();
  /// Asks the run for what is to be watched otherwise than now.
  void advance(WatchedRun& run);

 private:
  struct Page {
    std::int32_t handle = 0;
    std::vector<std::string> items;
    double interval = 0.0;
    ride::Origin origin;
    ride::Lifeline line;
  };
  /// A watch of the run, as it was begun: it is not changed, but followed by another one.
  struct Begun {
    std::int32_t handle = 0;  ///< the run's
    std::set<std::string> items;
    double interval = 0.0;
    std::vector<remote::WatchedItem> given;
    std::map<std::int32_t, std::vector<std::size_t>> places;  ///< by the page's handle
  };
  /// A question for a sample, and who waits for it.
  struct Question {
    std::shared_ptr<const Begun> of;
    std::vector<std::pair<std::int32_t, Told<remote::WatchedValues>>> waiting;
  };
  /// Pages that one watch of the run serves.
  struct Group {
    std::vector<Page> pages;
    std::shared_ptr<const Begun> begun;
    std::shared_ptr<Question> question;
    remote::WatchedValues sample;
    base::Time sampled = base::Time::min();  ///< `begun` has given `sample` then; min: not yet
    base::Time shrunk = base::Time::max();   ///< since when it watches more than pages look at
    /// What the watch before `begun` gave last, by item, until the threads have had their cycles.
    std::map<std::string, std::pair<double, double>> former;
    base::Time begun_at = base::Time::min();
  };
  /// What a page has asked for, until the run has said whether it watches that.
  struct Wish {
    Page page;
    Told<remote::Watch> told;
    std::size_t group = 0;  ///< with whom it is tried
  };

  Group* group_of(std::int32_t handle);
  bool serve_at_once(Wish& wish, remote::Watch& answer);
  void begin(WatchedRun& run, std::size_t group, bool wished);
  void take_begun(std::size_t group, bool wished, std::set<std::string> items, double interval,
                  const base::Result<remote::Watch>& begun);
  void take_refusal(std::size_t group, bool wished, const std::string& why);
  void take_sample(const std::shared_ptr<Question>& question,
                   const base::Result<remote::WatchedValues>& sample);
  static void add_places(Begun& begun, const Page& page);
  static remote::Watch answer_to(const Begun& begun, std::int32_t handle);
  static remote::WatchedValues part_of(const remote::WatchedValues& sample, const Begun& begun,
                                       std::int32_t handle);
  static void remember(Group& group);
  void bridge(const Group& group, remote::WatchedValues& sample) const;

  const std::function<void()> wake_;
  const std::function<base::Time()> clock_;
  std::mutex mutex_;  ///< of all below
  std::int32_t handles_ = 0;
  std::vector<Group> groups_;
  std::vector<Wish> wishes_;         ///< the first one is tried
  bool beginning_ = false;           ///< the run has been asked for a watch
  std::vector<std::int32_t> ended_;  ///< watches of the run that nobody needs any more
};

}  // namespace armature::studio::internal
