// SPDX-License-Identifier: Apache-2.0
#include "armature/controllers/teach/teacher.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

#include "armature/base/near_name.hpp"
#include "armature/base/quoted.hpp"
#include "armature/base/seconds.hpp"
#include "armature/platform/file.hpp"
#include "armature/rt/guard.hpp"

namespace armature::controllers {

using component::CommandStage;
using component::Outcome;

namespace {

constexpr base::Duration kLongestPeriod = std::chrono::milliseconds(20);
constexpr std::size_t kLargestFile = 64u << 20;
constexpr std::string_view kSuffix = ".motion";

Outcome refuse_name(std::string_view name) {
  component::Reason why("the name '");
  return component::refused(
      why.append(name).append("' must have letters, digits, _ and - only, 1 to 63 of them"));
}

template <typename Result>
Outcome refuse(const Result& result) {
  return component::refused(result.error());
}

}  // namespace

void Teacher::on_check(component::Check& check) const {
  if (period() > base::Duration::zero() && period() <= kLongestPeriod) return;
  check.error("the period must be above 0 and at most 20 ms",
              "give it activity: {periodic: 10 ms, scheduler: other}");
}

Outcome Teacher::on_configure() {
  if (unit_.get() != "rad" && unit_.get() != "deg" && unit_.get() != "m" && unit_.get() != "mm") {
    return component::refused("unit must be rad, deg, m or mm");
  }
  const double samples = longest_ / std::max(base::to_seconds(period()), 1e-3) + 2.0;
  samples_ = {static_cast<std::size_t>(joints_.get()), {}, {}};
  samples_.times_s.reserve(static_cast<std::size_t>(samples));
  samples_.positions.reserve(static_cast<std::size_t>(samples) * samples_.axes);
  return component::accepted();
}

Outcome Teacher::on_start() {
  motion_ = component::CommandHandle(component::CallStatus::kNotConnected);
  return component::accepted();
}

void Teacher::on_update() {
  const rt::PermitScope works_with_files;  // in a thread of its own nobody waits for it
  if (record_.active()) record_sample();
  if (play_.active()) follow(play_);
  if (go_to_.active()) follow(go_to_);
}

Outcome Teacher::begin_record(const Name& name) {
  const rt::PermitScope works_with_files;
  if (!is_taught_name(name.view())) return refuse_name(name.view());
  if (is_moving()) return component::refused("a motion is under way: cancel it first");
  if (!measured_.read()) {
    return component::refused("nAxesSensorPosition has no new value: its writer must run first");
  }
  std::error_code error;
  std::filesystem::create_directories(folder_.get(), error);
  if (const auto writable = platform::expect_writable(file_of(name.view())); !writable) {
    return refuse(writable);
  }
  samples_.times_s.clear();
  samples_.positions.clear();
  name_ = name;
  begun_ = time();
  recorded_.assign(0.0);
  return component::accepted();
}

/// Only what is new: its time is that of its measurement, whenever this thread runs.
void Teacher::record_sample() {
  const auto measured = measured_.read();
  if (!measured) {
    drop();
    return record_.fail("nothing was measured for 100 ms: the recording is dropped");
  }
  const bool full = samples_.times_s.size() == samples_.times_s.capacity();
  if (measured.is_new() && !full) {
    samples_.times_s.push_back(base::to_seconds(measured.time - begun_));
    samples_.positions.insert(samples_.positions.end(), measured.value.begin(),
                              measured.value.end());
    recorded_.assign(samples_.times_s.back() - samples_.times_s.front());
  }
  record_.report(std::min(1.0, recorded_ / longest_));
  if (!full && recorded_ < longest_) return;
  log_warning("the recording '{}' is full after {} s (max_duration): it ends here, and is kept",
              name_.view(), recorded_.get());
  if (const auto kept = keep_motion(); !kept) return record_.fail(kept.error());
  record_.complete();
}

Outcome Teacher::begin_finish() {
  const rt::PermitScope works_with_files;
  if (!record_.active()) return component::refused("nothing is recorded: record first");
  if (const auto kept = keep_motion(); !kept) {
    record_.fail(kept.error());
    return refuse(kept);
  }
  record_.complete();
  return component::accepted();
}

base::Result<void> Teacher::keep_motion() {
  const auto motion = control::fit_taught_motion(samples_);
  if (!motion) return base::Error{"the recording is dropped: " + motion.error()};
  const auto written =
      platform::write_file(file_of(name_.view()), to_motion_text(name_.view(), samples_));
  if (!written) return written;
  log_info("motion '{}' is kept: {} s; its smooth path is within {} rad of what was measured",
           name_.view(), recorded_.get(), motion.value().largest_deviation);
  return {};
}

Outcome Teacher::begin_play(const Name& name, double speed) {
  const rt::PermitScope works_with_files;
  if (record_.active()) return component::refused("a recording is under way: finish it first");
  if (go_to_.active()) return component::refused("a motion is under way: cancel it first");
  const auto motion = read_motion(name.view());
  if (!motion) return refuse(motion);
  return sent(play_path_.send(motion.value().points, speed));
}

Outcome Teacher::begin_go_to(const Name& name, double time_s) {
  const rt::PermitScope works_with_files;
  if (play_.active()) return component::refused("a motion is under way: cancel it first");
  const auto poses = read_poses();
  if (!poses) return refuse(poses);
  const auto pose = poses.value().find(std::string(name.view()));
  if (pose == poses.value().end()) {
    std::vector<std::string> known;
    for (const auto& [each, positions] : poses.value()) known.push_back(each);
    return component::refused("unknown pose " + base::quoted(name.view()) +
                              base::suggestion_in_brackets(name.view(), known));
  }
  return sent(move_to_.send(pose->second, time_s));
}

Outcome Teacher::begin_keep_pose(const Name& name) {
  const rt::PermitScope works_with_files;
  if (!is_taught_name(name.view())) return refuse_name(name.view());
  const auto measured = measured_.read();
  if (!measured) {
    return component::refused("nAxesSensorPosition has no new value: its writer must run first");
  }
  auto poses = read_poses();
  if (!poses) return refuse(poses);
  poses.value()[std::string(name.view())] = measured.value;
  const auto written = platform::write_file(poses_.get(), to_pose_text(poses.value(), unit_.get()));
  return written ? component::accepted() : refuse(written);
}

/// In one thread it is refused at once, else a little later: follow() tells.
Outcome Teacher::sent(component::CommandHandle handle) {
  motion_ = std::move(handle);
  if (motion_.stage() == CommandStage::kRefused) return component::refused(motion_.reason());
  return component::accepted();
}

void Teacher::follow(component::Command<Name, double>& command) {
  command.report(motion_.progress());
  if (!motion_.ended()) return;
  if (motion_.stage() == CommandStage::kDone) {
    command.complete();
  } else {
    command.fail(motion_.reason());
  }
}

std::string Teacher::file_of(std::string_view motion) const {
  return (std::filesystem::path(folder_.get()) / (std::string(motion) + std::string(kSuffix)))
      .string();
}

std::vector<std::string> Teacher::motions() const {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& each : std::filesystem::directory_iterator(folder_.get(), error)) {
    if (each.path().extension() == kSuffix) names.push_back(each.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

base::Result<control::TaughtMotion> Teacher::read_motion(std::string_view name) const {
  const std::vector<std::string> known = motions();
  if (std::ranges::find(known, name) == known.end()) {
    return base::Error{"unknown motion " + base::quoted(name) +
                       base::suggestion_in_brackets(name, known)};
  }
  const std::string file = file_of(name);
  const auto text = platform::read_file(file, kLargestFile);
  if (!text) return base::Error{text.error()};
  const auto samples = read_motion_text(text.value(), samples_.axes);
  if (!samples) return base::Error{file + ": " + samples.error()};
  auto motion = control::fit_taught_motion(samples.value());
  if (!motion) return base::Error{file + ": " + motion.error()};
  return motion;
}

/// None, where there is no file yet.
base::Result<Poses> Teacher::read_poses() const {
  std::error_code error;
  if (!std::filesystem::exists(poses_.get(), error)) return Poses{};
  const auto text = platform::read_file(poses_.get(), kLargestFile);
  if (!text) return base::Error{text.error()};
  auto poses = read_pose_text(text.value(), samples_.axes);
  if (!poses) return base::Error{poses_.get() + ": " + poses.error()};
  return poses;
}

std::string Teacher::list() {
  const rt::PermitScope works_with_files;
  std::string text = "motions:";
  for (const std::string& each : motions()) text += " " + each;
  text += "; poses:";
  const auto poses = read_poses();
  if (!poses) return text + " " + poses.error();
  for (const auto& [each, positions] : poses.value()) text += " " + each;
  return text;
}

}  // namespace armature::controllers
