// SPDX-License-Identifier: Apache-2.0
#include "robots/wam/driver/conversation.hpp"

#include <utility>

namespace armature::wam {

void Conversation::ask(int node, int number, Patience patience, Answered answered) {
  Step step{.kind = Kind::kAsk, .frame = get_frame(to_node(node), number)};
  step.node = node;
  step.number = number;
  step.patience = patience;
  step.answered = std::move(answered);
  steps_.push_back(std::move(step));
}

void Conversation::ask_position(int node, int number, Patience patience, Answered answered) {
  ask(node, number, patience, std::move(answered));
  steps_.back().position = true;
}

void Conversation::tell(const can::Frame& frame) {
  steps_.push_back({.kind = Kind::kTell, .frame = frame});
}

void Conversation::pause(base::Duration time) {
  steps_.push_back({.kind = Kind::kPause, .patience = {time, 1}});
}

void Conversation::then(std::function<void()> action) {
  steps_.push_back({.kind = Kind::kAction, .action = std::move(action)});
}

void Conversation::forget() {
  steps_.clear();
  next_ = 0;
  asking_ = pausing_ = false;
  deadline_ = base::Time::min();
}

bool Conversation::poll(base::Time now) {
  if (bus_->state() == can::BusState::kBusOff) static_cast<void>(bus_->restart());
  take_frames();
  for (;;) {
    if (asking_ && value_) {
      end_question(std::exchange(value_, std::nullopt));
    } else if (waits() && now < deadline_) {
      return true;
    } else if (asking_ && tries_left_ > 0) {
      ++counters_.repeated;
      send_question(now);
    } else if (asking_) {
      end_question(std::nullopt);
    } else if (pausing_) {
      pausing_ = false;
    } else if (next_ < steps_.size()) {
      begin_next(now);
    } else {
      forget();
      return false;
    }
  }
}

void Conversation::begin_next(base::Time now) {
  Step& step = steps_[next_++];
  switch (step.kind) {
    case Kind::kAsk:
      asking_ = true;
      tries_left_ = step.patience.tries;
      return send_question(now);
    case Kind::kTell:
      return send(step.frame);
    case Kind::kPause:
      pausing_ = true;
      deadline_ = now + step.patience.window;
      return;
    case Kind::kAction: {
      const auto action = std::move(step.action);  // it may add steps, which moves them
      return action();
    }
  }
}

void Conversation::send_question(base::Time now) {
  const Step& step = steps_[next_ - 1];
  --tries_left_;
  deadline_ = now + step.patience.window;
  send(step.frame);
}

void Conversation::end_question(std::optional<std::int32_t> value) {
  asking_ = false;
  const auto answered = std::move(steps_[next_ - 1].answered);
  answered(value);
}

void Conversation::take_frames() {
  can::Arrival arrival;
  while (bus_->receive(arrival) == can::ReceiveStatus::kReceived) {
    if (arrival.own || arrival.frame.kind == can::FrameKind::kError) continue;
    const auto value = asking_ && !value_ ? answer_in(arrival.frame) : std::nullopt;
    if (value) {
      value_ = value;
    } else {
      ++counters_.unexpected;
    }
  }
}

std::optional<std::int32_t> Conversation::answer_in(const can::Frame& frame) const {
  const Step& step = steps_[next_ - 1];
  const std::optional<Address> address = address_of(frame);
  const Group group = step.position ? Group::kPositions : Group::kReplies;
  if (address != from_node(step.node, group)) return std::nullopt;
  if (!step.position) return parse_reply(frame, step.number);
  const std::optional<Positions> positions = parse_positions(frame);
  return positions ? std::optional(positions->motor) : std::nullopt;
}

void Conversation::send(const can::Frame& frame) {
  if (bus_->send(frame) != can::SendStatus::kSent) ++counters_.not_sent;
}

}  // namespace armature::wam
