// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "robots/rover/camera.hpp"

// How well the rover follows the ball, by what an image showed and what was seen in it.
namespace armature::rover {

/// Where the camera wants the ball: its distance on the floor when it is in the picture's middle
/// [m].
constexpr double kWantedDistance = 1.0;

/// A point of the picture, from its lower left corner [px].
struct PicturePoint {
  double x = 0.0;
  double y = 0.0;
};

/// An image, and what Vision said of it.
struct Sight {
  double time_s = 0.0;
  int phase = 0;                     ///< of the experiment
  View view;                         ///< where rover and ball really were
  bool judged = false;               ///< Vision looked at it
  std::optional<PicturePoint> seen;  ///< where it saw the ball
};

/// From below the camera to the ball [m].
double distance(const View& view);
/// Of the ball from the camera's axis, to the left [rad], -pi to pi.
double bearing(const View& view);
/// The middle of the ball's outline in the picture; nothing if it is behind the camera.
std::optional<PicturePoint> truth(const View& view);
/// How much of the ball the camera has in sight, by the arena's geometry.
enum class InSight : std::uint8_t { kNothing, kPart, kWhole };
InSight in_sight(const View& view);

/// What became of the images in which the ball was wholly or not at all in sight.
struct Recognition {
  std::size_t whole = 0;  ///< images with all of it, 0.4 to 4 m away
  std::size_t found = 0;  ///< of these
  std::size_t none = 0;   ///< images without it
  std::size_t claimed = 0;
  double rms_px = 0.0;  ///< of the found ones' distances from the truth
  double p99_px = 0.0;
};
Recognition recognition(std::span<const Sight> sights);

/// The ball is not on the floor.
bool is_in_a_hand(const View& view);

/// Of a stretch of the experiment, while nobody carries the ball.
struct Following {
  double distance_error_m = 0.0;  ///< the largest, without sign
  double bearing_rad = 0.0;       ///< likewise
  double nearest_m = 0.0;         ///< distance
};
/// @param sights  not empty
Following following(std::span<const Sight> sights);

/// Of the answer to a ball that was `begin` beside the axis at first.
struct StepAnswer {
  double after_1_s_rad = 0.0;  ///< largest bearing from one second on
  double overshoot = 0.0;      ///< largest bearing of the other sign over the first one
};
StepAnswer step_answer(std::span<const Sight> sights);

/// From the moment from which on the ball is no longer hidden or away, to that at which it is seen.
/// @param back  that moment [s]
/// @return nothing: it was not seen again
std::optional<double> found_after(std::span<const Sight> sights, double back);

/// Those of a phase, from `skip` seconds after its begin on, at most `length` seconds of them.
std::vector<Sight> of_phase(std::span<const Sight> sights, int phase, double skip_s = 0.0,
                            double length_s = 1e9);

}  // namespace armature::rover
