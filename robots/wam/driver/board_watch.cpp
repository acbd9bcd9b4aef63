// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/driver/board_watch.hpp"

namespace armature::wam {

void BoardWatch::start(base::Time now) {
  asked_ = Asked::kNothing;
  mode_due_ = now;
  pendant_due_ = now + config_.period / 2;
  hears_again_ = now;
  missed_modes_ = 0;
  mode_.reset();
  pendant_.reset();
}

std::optional<can::Frame> BoardWatch::question(base::Time now) {
  if (asked_ != Asked::kNothing) {
    if (now < deadline_) return std::nullopt;
    give_up();
  }
  if (now >= mode_due_) {
    asked_ = Asked::kMode;
    mode_due_ = now + config_.period;
  } else if (now >= pendant_due_) {
    asked_ = Asked::kPendant;
    pendant_due_ = now + config_.period;
  } else {
    return std::nullopt;
  }
  deadline_ = now + config_.answer_timeout;
  const bool mode = asked_ == Asked::kMode;
  return get_frame(to_node(kBoardNode), mode ? config_.mode_number : config_.pendant_number);
}

void BoardWatch::hear(const can::Frame& frame, base::Time now) {
  const std::optional<Message> told = parse_message(frame);
  if (!told || !told->set || told->number != config_.mode_number || now < hears_again_) return;
  const bool obeys = told->value == static_cast<int>(PuckMode::kTorque);
  if (obeys == (mode_ == BoardMode::kActive)) return;
  hears_again_ = now + config_.period;
  ask_mode_soon(now);
}

void BoardWatch::take_back(base::Time now) {
  (asked_ == Asked::kMode ? mode_due_ : pendant_due_) = now;
  asked_ = Asked::kNothing;
}

void BoardWatch::give_up() {
  ++counters_.missed;
  if (asked_ == Asked::kMode) ++missed_modes_;
  asked_ = Asked::kNothing;
}

bool BoardWatch::take(const can::Frame& frame, base::Time now) {
  const auto mode = parse_reply(frame, config_.mode_number);
  const auto pendant = parse_reply(frame, config_.pendant_number);
  if (asked_ == Asked::kMode && mode) {
    asked_ = Asked::kNothing;
    missed_modes_ = 0;
    if (*mode < static_cast<int>(BoardMode::kEstop) ||
        *mode > static_cast<int>(BoardMode::kActive)) {
      ++counters_.malformed;
      return true;
    }
    mode_ = static_cast<BoardMode>(*mode);
    mode_time_ = now;
  } else if (asked_ == Asked::kPendant && pendant) {
    asked_ = Asked::kNothing;
    ++pendant_answers_;
    pendant_ = parse_pendant(*pendant);
    if (!pendant_) ++counters_.malformed;
  } else {
    ++counters_.unexpected;
    return false;
  }
  return true;
}

}  // namespace armature::wam
