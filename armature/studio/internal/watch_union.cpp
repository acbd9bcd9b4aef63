// SPDX-License-Identifier: Apache-2.0
#include "armature/studio/internal/watch_union.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string_view>
#include <tuple>

namespace armature::studio::internal {
namespace {

constexpr double kFresh = 0.75;  ///< of the interval: so old a sample may be for another page
constexpr base::Duration kShrinkAfter = std::chrono::seconds(1);
constexpr base::Duration kBridge = std::chrono::seconds(2);

bool belongs_to(std::string_view given, std::string_view item) {
  if (!given.starts_with(item)) return false;
  return given.size() == item.size() || given[item.size()] == '[' || given[item.size()] == '.';
}

base::Duration fresh_for(double interval) {
  return std::chrono::duration_cast<base::Duration>(
      std::chrono::duration<double>(interval * kFresh));
}

std::string unknown_watch(std::int32_t handle) {
  return "unknown watch " + std::to_string(handle) + ": it has ended, or never began";
}

}  // namespace

std::vector<std::size_t> places_of(const std::vector<std::string>& items,
                                   const std::vector<remote::WatchedItem>& given) {
  std::vector<std::size_t> places;
  for (const std::string& item : items) {
    std::set<std::string_view> taken;
    std::size_t at = 0;
    while (at < given.size() && !belongs_to(given[at].item, item)) ++at;
    // Behind them may stand an item that was asked for alone, too.
    while (at < given.size() && belongs_to(given[at].item, item) &&
           taken.insert(given[at].item).second) {
      places.push_back(at++);
    }
  }
  return places;
}

void WatchUnion::watch(WatchedRun& run, std::vector<std::string> items, double interval,
                       const ride::Origin& page, Told<remote::Watch> told) {
  std::optional<base::Result<remote::Watch>> answer;
  {
    const std::scoped_lock lock(mutex_);
    std::size_t all = wishes_.size();
    std::size_t own = 0;
    for (const Wish& one : wishes_) own += one.page.origin == page ? 1 : 0;
    for (const Group& group : groups_) {
      all += group.pages.size();
      for (const Page& one : group.pages) own += one.origin == page ? 1 : 0;
    }
    Wish wish{{++handles_, std::move(items), interval, page, ride::Lifeline(page)}, told, 0};
    remote::Watch served;
    if (all >= kMost || own >= kMostOfOne) {
      answer = base::Error{"too many watches: end one before another begins"};
    } else if (serve_at_once(wish, served)) {
      answer = std::move(served);
    } else {
      wishes_.push_back(std::move(wish));
    }
  }
  if (answer) return told(*answer);
  advance(run);
}

/// What the run is watched for already.
bool WatchUnion::serve_at_once(Wish& wish, remote::Watch& answer) {
  for (Group& group : groups_) {
    if (group.begun == nullptr || group.begun->interval > wish.page.interval) continue;
    const auto& known = group.begun->items;
    if (!std::ranges::all_of(wish.page.items, [&](const auto& one) { return known.contains(one); }))
      continue;
    auto begun = std::make_shared<Begun>(*group.begun);
    add_places(*begun, wish.page);
    answer = answer_to(*begun, wish.page.handle);
    group.begun = std::move(begun);
    group.question = nullptr;  // whose answer would not know the page
    group.pages.push_back(std::move(wish.page));
    return true;
  }
  return false;
}

void WatchUnion::advance(WatchedRun& run) {
  std::vector<std::int32_t> ended;
  std::optional<std::size_t> group;
  bool wished = false;
  {
    const std::scoped_lock lock(mutex_);
    ended.swap(ended_);
    wished = !wishes_.empty();
    if (!beginning_ && wished) {
      group = wishes_.front().group;
      if (*group >= groups_.size()) groups_.resize(*group + 1);
    }
    for (std::size_t i = 0; !beginning_ && !wished && i < groups_.size() && !group; ++i) {
      const bool due = groups_[i].shrunk < clock_() - kShrinkAfter;
      if (due) group = i;
    }
    if (group) beginning_ = true;
  }
  for (const std::int32_t handle : ended) run.end_watch(handle);
  if (group) begin(run, *group, wished);
}

/// Has the run watch all that the pages of a group look at, and what is wished.
void WatchUnion::begin(WatchedRun& run, std::size_t group, bool wished) {
  std::vector<std::string> items;
  std::set<std::string> known;
  double interval = 0.0;
  {
    const std::scoped_lock lock(mutex_);
    std::vector<const Page*> pages;
    for (const Page& page : groups_[group].pages) pages.push_back(&page);
    if (wished) pages.push_back(&wishes_.front().page);
    groups_[group].shrunk = base::Time::max();
    for (const Page* page : pages) {
      interval = page == pages.front() ? page->interval : std::min(interval, page->interval);
      for (const std::string& item : page->items) {
        if (known.insert(item).second) items.push_back(item);
      }
    }
  }
  run.watch(items, interval,
            [self = shared_from_this(), group, wished, known, interval](const auto& begun) {
              self->take_begun(group, wished, known, interval, begun);
              self->wake_();
            });
}

void WatchUnion::take_begun(std::size_t group, bool wished, std::set<std::string> items,
                            double interval, const base::Result<remote::Watch>& begun) {
  if (!begun) return take_refusal(group, wished, begun.error());
  Told<remote::Watch> told;
  remote::Watch answer;
  {
    const std::scoped_lock lock(mutex_);
    beginning_ = false;
    Group& of = groups_[group];
    if (of.begun != nullptr) ended_.push_back(of.begun->handle);
    remember(of);
    of.begun_at = clock_();
    if (wished) of.pages.push_back(wishes_.front().page);
    auto made = std::make_shared<Begun>(
        Begun{begun.value().handle, std::move(items), interval, begun.value().items, {}});
    for (const Page& page : of.pages) add_places(*made, page);
    of.begun = made;
    of.question = nullptr;  // what it asks for has ended
    of.sampled = base::Time::min();
    if (wished) {
      told = std::move(wishes_.front().told);
      answer = answer_to(*made, wishes_.front().page.handle);
      wishes_.erase(wishes_.begin());
    }
  }
  if (told) told(answer);
}

/// Who is refused together with others is tried beside them.
void WatchUnion::take_refusal(std::size_t group, bool wished, const std::string& why) {
  Told<remote::Watch> told;
  {
    const std::scoped_lock lock(mutex_);
    beginning_ = false;
    if (!wished) return;
    const bool alone = groups_[group].pages.empty();
    if (!alone) {
      ++wishes_.front().group;
      return;
    }
    told = std::move(wishes_.front().told);
    wishes_.erase(wishes_.begin());
  }
  told(base::Error{why});
}

void WatchUnion::watched(WatchedRun& run, std::int32_t handle, Told<remote::WatchedValues> told) {
  std::optional<base::Result<remote::WatchedValues>> answer;
  std::shared_ptr<Question> question;
  {
    const std::scoped_lock lock(mutex_);
    Group* const group = group_of(handle);
    const base::Time now = clock_();
    if (group == nullptr) {
      answer = base::Error{unknown_watch(handle)};
    } else if (group->sampled != base::Time::min() &&
               now - group->sampled < fresh_for(group->begun->interval)) {
      answer = part_of(group->sample, *group->begun, handle);
    } else if (group->question != nullptr) {
      group->question->waiting.emplace_back(handle, std::move(told));
      return;
    } else {
      question = std::make_shared<Question>(Question{group->begun, {}});
      question->waiting.emplace_back(handle, std::move(told));
      group->question = question;
    }
  }
  if (answer) return told(*answer);
  run.watched(question->of->handle, [self = shared_from_this(), question](const auto& sample) {
    self->take_sample(question, sample);
  });
}

void WatchUnion::take_sample(const std::shared_ptr<Question>& question,
                             const base::Result<remote::WatchedValues>& sample) {
  std::vector<std::pair<std::int32_t, Told<remote::WatchedValues>>> waiting;
  base::Result<remote::WatchedValues> answer = sample;
  {
    const std::scoped_lock lock(mutex_);
    waiting.swap(question->waiting);
    for (Group& group : groups_) {
      if (group.begun != question->of) {
        if (group.question == question) group.question = nullptr;
        continue;
      }
      group.question = nullptr;
      if (sample) {
        group.sample = sample.value();
        bridge(group, group.sample);
        group.sampled = clock_();
        answer = group.sample;
      } else {  // the run does not know it any more: pages begin anew
        group = Group{};
      }
    }
  }
  for (const auto& [handle, told] : waiting) {
    if (answer) {
      told(part_of(answer.value(), *question->of, handle));
    } else {
      told(base::Error{answer.error()});
    }
  }
}

void WatchUnion::remember(Group& group) {
  group.former.clear();
  if (group.begun == nullptr || group.sampled == base::Time::min()) return;
  const auto& given = group.begun->given;
  for (std::size_t i = 0; i < std::min(given.size(), group.sample.values.size()); ++i) {
    group.former[given[i].item] = {group.sample.values[i], group.sample.ages[i]};
  }
}

/// A watch has no number of a thread before that has had a cycle: until then the one before counts.
void WatchUnion::bridge(const Group& group, remote::WatchedValues& sample) const {
  if (group.former.empty() || clock_() - group.begun_at > kBridge) return;
  for (std::size_t i = 0; i < sample.values.size(); ++i) {
    if (!std::isnan(sample.values[i]) || !std::isnan(sample.ages[i])) continue;
    const auto known = group.former.find(group.begun->given[i].item);
    if (known != group.former.end()) std::tie(sample.values[i], sample.ages[i]) = known->second;
  }
}

bool WatchUnion::end(std::int32_t handle) {
  const std::scoped_lock lock(mutex_);
  Group* const group = group_of(handle);
  if (group == nullptr) return false;
  std::erase_if(group->pages, [handle](const Page& one) { return one.handle == handle; });
  group->shrunk = std::min(group->shrunk, clock_());
  if (!group->pages.empty()) return true;
  if (group->begun != nullptr) ended_.push_back(group->begun->handle);
  *group = Group{};
  return true;
}

void WatchUnion::end_lost() {
  std::vector<std::int32_t> lost;
  {
    const std::scoped_lock lock(mutex_);
    for (Group& group : groups_) {
      for (Page& page : group.pages) {
        if (page.line.lost(clock_())) lost.push_back(page.handle);
      }
    }
  }
  for (const std::int32_t handle : lost) end(handle);
}

WatchUnion::Group* WatchUnion::group_of(std::int32_t handle) {
  const auto found = std::ranges::find_if(groups_, [handle](const Group& group) {
    return std::ranges::find(group.pages, handle, &Page::handle) != group.pages.end();
  });
  return found == groups_.end() ? nullptr : &*found;
}

void WatchUnion::add_places(Begun& begun, const Page& page) {
  begun.places[page.handle] = places_of(page.items, begun.given);
}

remote::Watch WatchUnion::answer_to(const Begun& begun, std::int32_t handle) {
  remote::Watch answer{handle, {}};
  for (const std::size_t place : begun.places.at(handle)) {
    answer.items.push_back(begun.given[place]);
  }
  return answer;
}

/// The page's own numbers.
remote::WatchedValues WatchUnion::part_of(const remote::WatchedValues& sample, const Begun& begun,
                                          std::int32_t handle) {
  remote::WatchedValues part{{}, {}, sample.replaced};
  for (const std::size_t place : begun.places.at(handle)) {
    if (place >= sample.values.size()) continue;
    part.values.push_back(sample.values[place]);
    part.ages.push_back(sample.ages[place]);
  }
  return part;
}

}  // namespace armature::studio::internal
