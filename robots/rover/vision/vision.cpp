// SPDX-License-Identifier: Apache-2.0
#include "robots/rover/vision/vision.hpp"

#include <algorithm>
#include <cmath>

#include "armature/base/seconds.hpp"

namespace armature::rover {

using component::accepted;
using component::Outcome;
using component::refused;

// --- life ----------------------------------------------------------------------------------------

void Vision::on_check(component::Check& check) const {
  if (pace().owner != this) {
    check.error("only cycles of its own show that no image comes",
                "give it a period: activity: {periodic: 50 ms}");
  }
  const auto finder = vision::BallFinder::make(config());
  if (!finder) check.error(finder.error());
}

Outcome Vision::on_configure() {
  last_image_.assign(static_cast<std::size_t>(size_.bytes().get()), 0);
  return make_finder();
}

Outcome Vision::on_start() {
  has_image_ = false;
  last_image_at_ = time();
  equal_in_a_row_ = 0;
  equal_images_.write(0);
  return changes_.take() ? make_finder() : accepted();
}

Outcome Vision::make_finder() {
  auto finder = vision::BallFinder::make(config());
  if (!finder) return refused(finder.error());
  finder_.emplace(std::move(finder).value());
  static_cast<void>(changes_.take());
  return accepted();
}

vision::BallFinder::Config Vision::config() const {
  const auto part = [](int value) { return static_cast<std::uint8_t>(value); };
  return {.shape = {width_, height_},
          .colour = {.wanted = {part(red_), part(green_), part(blue_)},
                     .hue_tolerance_rad = hue_tolerance_,
                     .min_saturation = min_saturation_,
                     .min_value = min_value_},
          .min_area = min_area_};
}

// --- what superiors ask for ----------------------------------------------------------------------

std::int32_t Vision::initialize() {
  if (state() != component::State::kRunning) return kNotRunning;
  if (!complaint().empty()) {
    lost_.raise();
    return kCameraGone;
  }
  initialized_.raise();
  return kDone;
}

std::int32_t Vision::set_threshold(std::uint32_t red, std::uint32_t green, std::uint32_t blue) {
  if (std::max({red, green, blue}) > 255) return kNoColour;
  const auto part = [](std::uint32_t value) { return static_cast<std::uint8_t>(value); };
  vision::ColourThreshold::Config colour = config().colour;
  colour.wanted = {part(red), part(green), part(blue)};
  const auto threshold = vision::ColourThreshold::make(colour);
  if (!threshold) return kNoColour;
  red_.assign(static_cast<int>(red));
  green_.assign(static_cast<int>(green));
  blue_.assign(static_cast<int>(blue));
  finder_->look_for(threshold.value());
  return kDone;
}

Outcome Vision::begin() {
  if (machine_.is_in("Off")) return refused("it is not initialized: call initialize first");
  if (machine_.is_in("Failed")) {
    return refused("its camera has failed: call initialize when it sends images again");
  }
  started_.raise();
  start_.complete();
  return accepted();
}

Outcome Vision::end() {
  stopped_.raise();
  stop_.complete();
  return accepted();
}

// --- what comes from the camera ------------------------------------------------------------------

void Vision::look(const std::vector<std::uint8_t>& image) {
  last_image_at_ = time();
  if (is_equal(image)) {
    ++equal_in_a_row_;
    equal_images_.write(equal_images_.last() + 1);
    watch_camera();
    return;
  }
  equal_in_a_row_ = 0;
  has_image_ = true;
  std::copy(image.begin(), image.end(), last_image_.begin());
  if (machine_.is_in("Recognising")) recognise(image);
}

bool Vision::is_equal(const std::vector<std::uint8_t>& image) const {
  return has_image_ && image == last_image_;
}

void Vision::recognise(const std::vector<std::uint8_t>& image) {
  const auto ball = finder_->find({image.data(), finder_->config().shape});
  if (!ball) {
    seen_.write(false);
    missed_.raise();
    return;
  }
  const double up = height_ - ball->y;
  x_.write(ball->x);
  y_.write(up);
  area_.write(ball->area);
  seen_.write(true);
  found_.raise();
  position_.raise(static_cast<std::int32_t>(std::lround(ball->x)),
                  static_cast<std::int32_t>(std::lround(up)));
}

void Vision::watch_camera() {
  const bool needed = machine_.is_in("Ready") || machine_.is_in("Recognising");
  if (needed && !complaint().empty()) lost_.raise();
}

/// Empty: the camera is well.
std::string_view Vision::complaint() const {
  if (equal_in_a_row_ >= max_equal_images_) {
    return "the camera sends the same image again and again (MaxEqualImages)";
  }
  if (base::to_seconds(time() - last_image_at_) > image_timeout_) {
    return "no image comes from the camera (ImageTimeout)";
  }
  return {};
}

void Vision::tell_failed(std::string_view operation) {
  const std::string_view why = complaint();
  log_error("{} cannot go on: {}", operation, why);
  failed_.raise(operation, why);
}

}  // namespace armature::rover
