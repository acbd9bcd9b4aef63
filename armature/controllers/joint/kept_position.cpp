// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/joint/kept_position.hpp"

#include <cmath>
#include <cstdio>

#include "armature/controllers/base/driven_joint.hpp"
#include "armature/controllers/base/reason_text.hpp"

namespace armature::controllers {

using component::KeepingMoment;
using std::chrono::days;
using std::chrono::sys_seconds;

namespace {

/// What is older is not even proposed.
constexpr days kLongestKept{30};
/// A joint that stops so long before its run ends may have moved.
constexpr std::chrono::seconds kEndsWithin{10};

constexpr const char* kDeleteFile = "delete the file; the joint then begins at InitialPos";

std::string date_text(sys_seconds at) {
  const sys_seconds midnight = std::chrono::floor<days>(at);
  const std::chrono::year_month_day date{std::chrono::floor<days>(at)};
  const std::chrono::hh_mm_ss time{at - midnight};
  char text[32];
  std::snprintf(text, sizeof text, "%04d-%02u-%02uT%02d:%02d:%02dZ", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                static_cast<int>(time.hours().count()), static_cast<int>(time.minutes().count()),
                static_cast<int>(time.seconds().count()));
  return text;
}

/// As `date_text` writes it, and nothing else.
std::optional<sys_seconds> date_of(const std::string& text) {
  int year = 0;
  unsigned month = 0;
  unsigned day = 0;
  int hours = 0;
  int minutes = 0;
  int seconds = 0;
  if (std::sscanf(text.c_str(), "%4d-%2u-%2uT%2d:%2d:%2dZ", &year, &month, &day, &hours, &minutes,
                  &seconds) != 6) {
    return std::nullopt;
  }
  const std::chrono::year_month_day date{std::chrono::year{year}, std::chrono::month{month},
                                         std::chrono::day{day}};
  if (!date.ok()) return std::nullopt;
  const sys_seconds at = std::chrono::sys_days{date} + std::chrono::hours{hours} +
                         std::chrono::minutes{minutes} + std::chrono::seconds{seconds};
  if (date_text(at) != text) return std::nullopt;
  return at;
}

std::string range_text(const JointProperties& settings) {
  return figure(settings->lowest()) + " to " + figure(settings->highest()) + " " +
         settings.units().position().get();
}

}  // namespace

KeptPosition::KeptPosition(component::Component* owner, const JointProperties& settings)
    : owner_(*owner),
      settings_(settings),
      last_(owner, "LastPosition", {},
            "where it was when a run ended, with its date; autosave writes it") {}

void KeptPosition::take(const KeepingMoment& moment, const base::Location& where,
                        base::Diagnostics& diagnostics) {
  found_ = last_.get();
  begun_ = found_;
  begun_.at_rest = false;
  proposal_.reset();
  doubtful_ = true;
  if (is_believable(moment, where, diagnostics)) proposal_ = found_.position;
}

/// What a file says that cannot be so is an error; what is so but tells nothing any more, a
/// warning.
bool KeptPosition::is_believable(const KeepingMoment& moment, const base::Location& where,
                                 base::Diagnostics& diagnostics) const {
  const std::string joint = "'" + owner_.name() + "'";
  if (found_.date.empty() && found_.owner.empty()) {
    diagnostics.warning(where,
                        joint + " begins at InitialPos, " + figure(settings_->initial_position) +
                            " " + settings_.units().position().get() + ": no position is kept yet",
                        "set position_confirmed of its hardware once it is there");
    return false;
  }
  if (const std::string wrong = objection(moment); !wrong.empty()) {
    diagnostics.error(where, joint + ": LastPosition " + wrong, kDeleteFile);
    return false;
  }
  const bool old = moment.now - *date_of(found_.date) > kLongestKept;
  if (found_.at_rest && !old) return true;
  diagnostics.warning(
      where,
      joint + " begins at InitialPos, " + figure(settings_->initial_position) + " " +
          settings_.units().position().get() + ": " +
          (found_.at_rest ? "its last position is of " + found_.date + ", more than 30 days ago"
                          : "the run of " + found_.date +
                                " did not end with the joint at rest where it is known to be"),
      "set position_confirmed of its hardware once it is there");
  return false;
}

/// Empty if it may be as it says.
std::string KeptPosition::objection(const KeepingMoment& moment) const {
  const std::optional<sys_seconds> date = date_of(found_.date);
  if (found_.owner != moment.owner) {
    return "is of '" + found_.owner + "', expected '" + moment.owner + "'";
  }
  if (!date) return "has the date '" + found_.date + "', expected one like 2026-11-25T03:34:19Z";
  if (*date > moment.now) {
    return "has the date " + found_.date + ", which is to come: it is " + date_text(moment.now);
  }
  const double position = found_.position;
  if (!std::isfinite(position) || position < settings_->lowest() ||
      position > settings_->highest()) {
    return "is " + figure(position) + " " + settings_.units().position().get() + ", expected " +
           range_text(settings_);
  }
  return {};
}

void KeptPosition::begin(const KeepingMoment& moment) {
  begun_ = {.position = found_.position,
            .date = date_text(moment.now),
            .owner = moment.owner,
            .at_rest = false};
  last_.assign(begun_);
}

std::string KeptPosition::end(const KeepingMoment& moment) {
  last_.assign(begun_);  // whatever tools made of it meanwhile
  if (!stopped_.load(std::memory_order_acquire)) return "it did not stop in order";
  if (moment.now - stopped_at_ > kEndsWithin) {
    return "it was stopped long before the run ended";
  }
  if (!stop_.at_rest) return "it was not measured at rest when it stopped";
  if (!stop_.braked) return "its brake did not confirm that it holds";
  if (!stop_.exact) return "a sample of it was lost";
  if (!stop_.known) return "it has begun to home, and has not found home";
  if (doubtful_ && !proposal_) return "the operator did not confirm where it began";
  const bool within =
      stop_.position >= settings_->lowest() && stop_.position <= settings_->highest();
  if (!within) {
    return "it is at " + figure(stop_.position) + " " + settings_.units().position().get() +
           ", outside " + range_text(settings_);
  }
  last_.assign({.position = stop_.position,
                .date = doubtful_ ? found_.date : date_text(stopped_at_),
                .owner = moment.owner,
                .at_rest = true});
  return {};
}

component::Reason KeptPosition::question(double position) const {
  component::Reason why("it began ");
  if (proposal_) {
    append_number(why.append("at "), *proposal_)
        .append(" ")
        .append(settings_.units().position().get())
        .append(", where it was on ");
    why.append(found_.date);
  } else {
    why.append("at InitialPos, as its last position is not known");
  }
  append_number(why.append(": look whether it is where its Position says, "), position);
  return why.append(" ")
      .append(settings_.units().position().get())
      .append(", then set position_confirmed of its hardware");
}

void KeptPosition::note_stop(const Stop& stop) {
  stop_ = stop;
  stopped_at_ = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  stopped_.store(true, std::memory_order_release);
}

}  // namespace armature::controllers
