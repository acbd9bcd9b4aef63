// SPDX-License-Identifier: Apache-2.0
#include "armature/sim/ray_camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include "armature/sim/internal/ray_scene.hpp"

namespace armature::sim {
namespace internal {

/// Pixels from `first` to before `end`.
struct Span {
  int first = 0;
  int end = 0;
};

/// A thing as the eye has it in this image.
struct Sight {
  Matrix turn;    ///< from the eye's axes to those of the thing
  Vector origin;  ///< the eye, in the axes of the thing
  Vector light;
  Span columns;
  Span rows;
};

}  // namespace internal

using internal::Frame;
using internal::Matrix;
using internal::Meeting;
using internal::Scene;
using internal::Sight;
using internal::Span;
using internal::Thing;
using internal::Vector;

namespace {

constexpr std::array<int, 3> kSky{176, 196, 214};
/// Where light comes from; of length 1.
constexpr Vector kLight{-0.36, 0.48, 0.8};
/// Of 256: in the shadow, and what full light adds.
constexpr int kAmbient = 150;
constexpr double kDiffuse = 106.0;
/// Beyond that nothing is seen, and no body is [m].
constexpr double kFarthest = 1e6;

/// Those of one axis in which a ball is seen; some too many, never one too few.
/// @param aside  of its middle, in the picture's direction
/// @param ahead  of its middle; the ball is in front of the eye
Span span_of(double aside, double ahead, double reach, double focal_length, int pixels) {
  const double near = ahead - reach;
  const double far = ahead + reach;
  const double low = aside - reach;
  const double high = aside + reach;
  const double middle = 0.5 * pixels;
  const double first = middle + focal_length * low / (low < 0.0 ? near : far) - 2.0;
  const double end = middle + focal_length * high / (high > 0.0 ? near : far) + 2.0;
  const double most = pixels;
  return {static_cast<int>(std::clamp(first, 0.0, most)),
          static_cast<int>(std::clamp(end, 0.0, most))};
}

/// Bits that look random, of any number (splitmix64).
std::uint64_t scrambled(std::uint64_t number) {
  number += 0x9e3779b97f4a7c15U;
  number = (number ^ (number >> 30U)) * 0xbf58476d1ce4e5b9U;
  number = (number ^ (number >> 27U)) * 0x94d049bb133111ebU;
  return number ^ (number >> 31U);
}

}  // namespace

struct RayCamera::Impl {
  internal::Model model;
  Options options;
  Scene scene;
  double focal = 0.0;
  int noise_step = 0;  ///< [levels / 65536] for one step of the noise
  std::vector<Sight> sights;
  std::vector<double> depth;               // of a row
  std::vector<std::array<int, 3>> colour;  // of a row

  void look();
  Sight sight_of(const Thing& thing, const Frame& eye) const;
  template <typename Shape>
  void scan(const Shape& shape, const Thing& thing, const Sight& sight, int row);
  void render_row(int row);
  void write_row(int row, std::uint64_t frame, std::uint8_t* pixel) const;
};

/// Where everything is from the eye.
void RayCamera::Impl::look() {
  const Frame eye = scene.bodies[scene.eye_body] * scene.eye_on_body;
  for (std::size_t i = 0; i < sights.size(); ++i) sights[i] = sight_of(scene.things[i], eye);
}

Sight RayCamera::Impl::sight_of(const Thing& thing, const Frame& eye) const {
  const Frame place = scene.bodies[thing.body] * thing.on_body;
  const Matrix into = internal::transposed(place.rotation);
  Sight sight{.turn = into * eye.rotation,
              .origin = into * (eye.position - place.position),
              .light = into * kLight,
              .columns = {0, options.width},
              .rows = {0, options.height}};
  if (thing.reach < 0.0) return sight;
  const Vector seen = internal::transposed(eye.rotation) * (place.position - eye.position);
  const double ahead = -seen.z;
  if (ahead + thing.reach <= internal::kNearest) {
    sight.rows = {};
  } else if (ahead - thing.reach > internal::kNearest) {
    sight.columns = span_of(seen.x, ahead, thing.reach, focal, options.width);
    sight.rows = span_of(-seen.y, ahead, thing.reach, focal, options.height);
  }
  return sight;
}

/// Eyes look along -z, with x to the right and y upwards, as MuJoCo's cameras do.
template <typename Shape>
void RayCamera::Impl::scan(const Shape& shape, const Thing& thing, const Sight& sight, int row) {
  const double up = (0.5 * options.height - row - 0.5) / focal;
  for (int column = sight.columns.first; column < sight.columns.end; ++column) {
    const double right = (column + 0.5 - 0.5 * options.width) / focal;
    const Vector direction = sight.turn * Vector{right, up, -1.0};
    const auto at = static_cast<std::size_t>(column);
    Meeting meeting;
    if (!shape.meet(sight.origin, direction, depth[at], meeting)) continue;
    depth[at] = meeting.t;
    const double lit = internal::dot(meeting.normal, sight.light);
    const int full = kAmbient + (lit > 0.0 ? static_cast<int>(kDiffuse * lit) : 0);
    const int shade = meeting.dark ? full * 3 / 4 : full;
    for (std::size_t i = 0; i < 3; ++i)
      colour[at][i] = std::min(thing.colour[i] * shade / 256, 255);
  }
}

void RayCamera::Impl::render_row(int row) {
  std::fill(depth.begin(), depth.end(), kFarthest);
  std::fill(colour.begin(), colour.end(), kSky);
  for (std::size_t i = 0; i < sights.size(); ++i) {
    const Sight& sight = sights[i];
    const Thing& thing = scene.things[i];
    if (row < sight.rows.first || row >= sight.rows.end) continue;
    std::visit([&](const auto& shape) { scan(shape, thing, sight, row); }, thing.shape);
  }
}

/// The noise of a channel is the sum of two equally distributed numbers of 10 bits.
void RayCamera::Impl::write_row(int row, std::uint64_t frame, std::uint8_t* pixel) const {
  const std::uint64_t key = scrambled(options.seed ^ scrambled(frame));
  auto number = static_cast<std::uint64_t>(row) * static_cast<std::uint64_t>(options.width);
  for (const std::array<int, 3>& clean : colour) {
    std::uint64_t bits = noise_step > 0 ? scrambled(key ^ number++) : 0;
    for (const int channel : clean) {
      int level = channel;
      if (noise_step > 0) {
        const int steps = static_cast<int>((bits & 1023U) + ((bits >> 10U) & 1023U)) - 1023;
        bits >>= 20U;
        level += (steps * noise_step + (1 << 15)) >> 16;
      }
      *pixel++ = static_cast<std::uint8_t>(std::clamp(level, 0, 255));
    }
  }
}

RayCamera::RayCamera(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RayCamera::RayCamera(RayCamera&&) noexcept = default;
RayCamera& RayCamera::operator=(RayCamera&&) noexcept = default;
RayCamera::~RayCamera() = default;

base::Result<RayCamera> RayCamera::parse(const std::string& mjcf, const std::string& name,
                                         const Options& options) {
  constexpr int kMostPixels = 4096;
  constexpr double kMostNoise = 64.0;
  constexpr double kNoiseDeviation = 418.0;  // of the sum of two numbers from 0 to 1023
  constexpr double kFocalSteps = 65536.0;
  const auto fits = [](int pixels) { return pixels >= 1 && pixels <= kMostPixels; };
  if (!fits(options.width) || !fits(options.height)) {
    return base::Error{name + ": the picture is " + std::to_string(options.width) + " x " +
                       std::to_string(options.height) + " px, expected 1 to 4096 each"};
  }
  if (!(options.noise >= 0.0 && options.noise <= kMostNoise)) {
    return base::Error{name + ": noise is " + std::to_string(options.noise) +
                       ", expected 0 to 64 levels of 255"};
  }
  auto compiled = internal::compile(mjcf, name, "an MJCF description");
  if (!compiled) return base::Error{compiled.error()};
  auto impl = std::make_unique<Impl>();
  impl->model = std::move(compiled).value();
  auto scene = internal::make_scene(*impl->model, name, options.camera);
  if (!scene) return base::Error{scene.error()};
  impl->scene = std::move(scene).value();
  impl->options = options;
  const double focal = 0.5 * options.height / std::tan(0.5 * impl->scene.field_of_view);
  impl->focal = std::floor(focal * kFocalSteps + 0.5) / kFocalSteps;
  impl->noise_step = static_cast<int>(std::lround(options.noise / kNoiseDeviation * 65536.0));
  impl->sights.resize(impl->scene.things.size());
  impl->depth.resize(static_cast<std::size_t>(options.width));
  impl->colour.resize(static_cast<std::size_t>(options.width));
  return RayCamera(std::move(impl));
}

std::optional<std::size_t> RayCamera::find_body(std::string_view name) const {
  const int body = mj_name2id(impl_->model.get(), mjOBJ_BODY, std::string(name).c_str());
  if (body < 0) return std::nullopt;
  return static_cast<std::size_t>(body);
}

bool RayCamera::place(std::size_t body, const Pose& pose) {
  const auto near = [](double length) { return std::abs(length) <= kFarthest; };
  const auto& [w, x, y, z] = pose.orientation;
  const double length = w * w + x * x + y * y + z * z;
  const bool turned = length > 0.5 && length < 2.0;
  if (!turned || !std::all_of(pose.position.begin(), pose.position.end(), near)) return false;
  impl_->scene.bodies[body] = internal::snapped(pose);
  return true;
}

std::size_t RayCamera::size() const {
  return impl_->depth.size() * static_cast<std::size_t>(impl_->options.height) * 3;
}

double RayCamera::focal_length() const { return impl_->focal; }

void RayCamera::render(std::uint64_t frame, std::vector<std::uint8_t>& image) {
  image.resize(size());
  impl_->look();
  const std::size_t row_size = 3 * impl_->depth.size();
  for (int row = 0; row < impl_->options.height; ++row) {
    impl_->render_row(row);
    impl_->write_row(row, frame, image.data() + static_cast<std::size_t>(row) * row_size);
  }
}

}  // namespace armature::sim
