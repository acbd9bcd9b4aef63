// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/sim/pose.hpp"

namespace armature::sim {

/// What a camera of a MuJoCo description (MJCF) sees: one ray for each pixel, to the nearest plane,
/// sphere, box or cylinder, whose colour is shaded by its normal; no graphics hardware, no library.
///
/// Where bodies are is told by `place`, so the image is that of a copy of the state: whoever
/// renders may do so in another thread than the simulation's. Geometries of the group 3 and above,
/// and those of the robot that carries the camera, are not seen. A plane with `user="SIZE"` has
/// checks of that size [m]. Planes end where their size says and are seen from the front only, as
/// by MuJoCo's rays.
///
/// Equal poses, seeds and frames make equal images on every machine. Rays are computed here by
/// additions, multiplications, divisions and roots alone, which IEEE 754 rounds in one way,
/// compiled without fused ones; poses count in steps of 2^-24 m and 2^-30, so the last bits of a
/// sine do not; shades and noise are whole numbers.
///
/// One thread uses it.
class RayCamera {
 public:
  /// The picture, and what disturbs it.
  struct Options {
    std::string camera;      ///< its name in the description, which has its place and `fovy`
    int width = 320;         ///< [px], 1 to 4096
    int height = 240;        ///< [px], 1 to 4096
    double noise = 0.0;      ///< standard deviation [levels of 255], 0 to 64; of each channel
    std::uint64_t seed = 1;  ///< of the noise
  };

  /// @param mjcf  the text of the description, without files beside it
  /// @param name  what errors call the text
  /// An error names the text and what is missing, wrong, or of no shape that it sees.
  static base::Result<RayCamera> parse(const std::string& mjcf, const std::string& name,
                                       const Options& options);
  RayCamera(RayCamera&&) noexcept;
  RayCamera& operator=(RayCamera&&) noexcept;
  ~RayCamera();

  std::optional<std::size_t> find_body(std::string_view name) const;
  /// From the next image on; until then it is where the description has it. Bodies that it carries
  /// stay where they are: each is placed by itself.
  /// @param pose  within 1000 km of the world's middle; else, or if it is no number, it is not
  /// taken
  /// @return false if it was not taken
  /// @rt nonblocking, no allocation
  bool place(std::size_t body, const Pose& pose);

  /// @param frame  number of the image: each has noise of its own
  /// @param image  red, green, blue of each pixel, row 0 on top; gets `size()` bytes
  /// @rt nonblocking, no allocation if `image` has its size; milliseconds
  void render(std::uint64_t frame, std::vector<std::uint8_t>& image);
  std::size_t size() const;

  /// Distance of the picture's plane from the eye [px]: a point d in front and s to the right is
  /// seen s / d of it right of the middle.
  double focal_length() const;

 private:
  struct Impl;
  explicit RayCamera(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace armature::sim
