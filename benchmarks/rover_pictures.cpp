// SPDX-License-Identifier: Apache-2.0
#include "benchmarks/rover_pictures.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <random>
#include <string_view>

#include "armature/sim/ray_camera.hpp"
#include "armature/vision/ball_finder.hpp"
#include "armature/vision/png.hpp"
#include "armature/vision/stages.hpp"
#include "robots/rover/description.hpp"
#include "robots/rover/numbers.hpp"

namespace armature::rover {
namespace {

using Json = nlohmann::ordered_json;
using vision::BallFinder;

constexpr vision::ImageShape kShape{320, 240};
constexpr int kWithoutBall = 10'000;
constexpr double kDegrees = 180.0 / std::numbers::pi;

Json rounded(const std::vector<double>& values, double per) {
  Json all = Json::array();
  for (const double value : values) all.push_back(std::round(value * per) / per);
  return all;
}

Json line(const std::string& label, const std::vector<double>& t, const std::vector<double>& v,
          double per) {
  return {{"label", label}, {"t", rounded(t, 1e3)}, {"v", rounded(v, per)}};
}

Json way(const std::string& label, const std::vector<double>& x, const std::vector<double>& y) {
  return {{"label", label}, {"x", rounded(x, 1e3)}, {"y", rounded(y, 1e3)}};
}

/// Adds a line to the picture of that title.
void add_line(Json& pictures, const std::string& title, const std::string& unit, Json line) {
  for (Json& one : pictures) {
    if (one["title"] == title) {
      one["lines"].push_back(std::move(line));
      return;
    }
  }
  pictures.push_back({{"title", title}, {"unit", unit}, {"lines", Json::array({std::move(line)})}});
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const bool is_there = i + k <= bytes.size();
      text += is_there ? kDigits[bits >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

/// The arena as the rover's camera sees it.
class Eye {
 public:
  Eye()
      : camera_(sim::RayCamera::parse(description(2), "rover",
                                      {.camera = "eye",
                                       .width = kShape.width,
                                       .height = kShape.height,
                                       .noise = 2.0,
                                       .seed = 7})
                    .value()),
        finder_(BallFinder::make({.shape = kShape}).value()) {}

  void look(double x, double y, double heading, double ball_x, double ball_y) {
    const double half = 0.5 * heading;
    camera_.place(*camera_.find_body("rover"),
                  {{x, y, kWheelRadius}, {std::cos(half), 0.0, 0.0, std::sin(half)}});
    camera_.place(*camera_.find_body("ball"),
                  {{ball_x, ball_y, kBallRadius}, {1.0, 0.0, 0.0, 0.0}});
    camera_.render(++frame_, image_);
    const auto begin = std::chrono::steady_clock::now();
    ball_ = finder_.find(view());
    took_ms_.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
            .count());
  }
  vision::ImageView view() const { return {image_.data(), kShape}; }
  const BallFinder& finder() const { return finder_; }
  const std::optional<BallFinder::Ball>& ball() const { return ball_; }
  double median_ms() {
    std::ranges::sort(took_ms_);
    return took_ms_[took_ms_.size() / 2];
  }

 private:
  sim::RayCamera camera_;
  BallFinder finder_;
  std::vector<std::uint8_t> image_ = std::vector<std::uint8_t>(kShape.bytes());
  std::uint64_t frame_ = 0;
  std::optional<BallFinder::Ball> ball_;
  std::vector<double> took_ms_;
};

/// From places all over the arena, with post, box and screen in sight of many.
Json without_ball(Eye& eye) {
  std::mt19937 chance(4);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int claimed = 0;
  for (int k = 0; k < kWithoutBall; ++k) {
    eye.look(5.0 * share(chance) - 2.5, 3.0 * share(chance) - 1.5,
             2.0 * std::numbers::pi * share(chance), 100.0, 100.0);
    if (eye.ball()) ++claimed;
  }
  return {{"images", kWithoutBall}, {"claimed", claimed}};
}

void add_image(Json& figures, const std::string& title, const vision::Image& image) {
  figures["pictures"].push_back({{"title", title}, {"png", base64(vision::png_of(image.view()))}});
}

/// Three images with the ball marked, and the stages of the first (paper 4, figure 5).
void add_images(Eye& eye, Json& figures) {
  struct Place {
    const char* title;
    double x, y, heading, ball_x, ball_y;
  };
  constexpr Place kPlaces[] = {{"1 m away, before the screen", 0.6, 0.1, 0.1, 1.68, 0.2},
                               {"2.5 m away, near the post", -1.0, 0.2, 0.45, 1.25, 1.3},
                               {"0.5 m away", 0.0, 0.0, 0.0, 0.57, 0.1}};
  for (const Place& place : kPlaces) {
    eye.look(place.x, place.y, place.heading, place.ball_x, place.ball_y);
    add_image(figures, place.title, vision::ball_image(eye.view(), eye.finder(), eye.ball()));
  }
  eye.look(kPlaces[0].x, kPlaces[0].y, kPlaces[0].heading, kPlaces[0].ball_x, kPlaces[0].ball_y);
  add_image(figures, "Colour distance",
            vision::colour_distance_image(eye.finder().threshold(), eye.view()));
  add_image(figures, "Mask", vision::mask_image(eye.finder()));
  add_image(figures, "Blobs", vision::blob_image(eye.finder()));
}

}  // namespace

void add_curves(const std::string& run, const std::vector<Sight>& sights, Json& figures) {
  std::vector<double> t, away, beside, seen_t, error, x, y, ball_x, ball_y;
  for (const Sight& sight : sights) {
    t.push_back(sight.time_s);
    away.push_back(distance(sight.view));
    beside.push_back(bearing(sight.view) * kDegrees);
    x.push_back(sight.view.x);
    y.push_back(sight.view.y);
    ball_x.push_back(sight.view.ball_x);
    ball_y.push_back(sight.view.ball_y);
    if (!sight.seen || in_sight(sight.view) != InSight::kWhole) continue;
    const PicturePoint really = *truth(sight.view);
    seen_t.push_back(sight.time_s);
    error.push_back(std::hypot(sight.seen->x - really.x, sight.seen->y - really.y));
  }
  add_line(figures["curves"], "Distance to the ball", "m", line(run, t, away, 1e3));
  add_line(figures["curves"], "Bearing of the ball", "degrees", line(run, t, beside, 1e2));
  add_line(figures["curves"], "Error of Vision", "px", line(run, seen_t, error, 1e2));
  const std::string title = "Ways from above, " + run;
  add_line(figures["ways"], title, "m", way("rover", x, y));
  add_line(figures["ways"], title, "m", way("ball", ball_x, ball_y));
}

void add_lateness(const std::vector<double>& time_s, const std::vector<double>& late_ms,
                  Json& figures) {
  add_line(figures["curves"], "From image to position, in real time", "ms",
           line("realtime", time_s, late_ms, 1e3));
}

void add_pictures(Json& figures) {
  Eye eye;
  figures["without_ball"] = without_ball(eye);
  figures["look_ms"] = eye.median_ms();
  add_images(eye, figures);
}

}  // namespace armature::rover
