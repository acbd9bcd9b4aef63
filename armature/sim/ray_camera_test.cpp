// SPDX-License-Identifier: Apache-2.0
#include "armature/sim/ray_camera.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "armature/sim/internal/mujoco_model.hpp"
#include "armature/testing/realtime_guard.hpp"

namespace armature::sim {
namespace {

using ::testing::HasSubstr;

/// A red ball on a checkered floor, between a green post and a blue box, before a yellow wall; the
/// camera looks along x, 14 degrees down, from a cart whose white mast it does not see.
const std::string kScene = R"(<mujoco>
  <size nuser_geom="1"/>
  <worldbody>
    <geom name="floor" type="plane" size="5 5 1" rgba="0.6 0.6 0.6 1" user="0.5"/>
    <geom name="wall" type="plane" size="0.3 3 1" pos="3 0 0.3" zaxis="-1 0 0" rgba="1 1 0 1"/>
    <geom name="post" type="cylinder" size="0.06 0.25" pos="1.6 0.5 0.25" rgba="0 1 0 1"/>
    <geom name="box" type="box" size="0.1 0.1 0.15" pos="1.8 -0.5 0.15" euler="0 0 30" rgba="0 0 1 1"/>
    <geom name="hidden" type="capsule" size="0.1 0.1" pos="1 0 0.2" group="3"/>
    <body name="ball" pos="1 0 0.05"><geom type="sphere" size="0.05" rgba="1 0 0 1"/></body>
    <body name="cart"><freejoint/>
      <geom type="box" size="0.02 0.02 0.02" pos="0.2 0 0.3" rgba="1 1 1 1"/>
      <camera name="eye" pos="0 0 0.3" fovy="50" xyaxes="0 -1 0 0.24192189559966773 0 0.97029572627599647"/>
    </body>
  </worldbody>
</mujoco>)";

RayCamera make_camera(double noise = 0.0, std::uint64_t seed = 1) {
  auto made = RayCamera::parse(kScene, "scene", {.camera = "eye", .noise = noise, .seed = seed});
  EXPECT_TRUE(made) << made.error();
  return std::move(made).value();
}

using Image = std::vector<std::uint8_t>;

Image render(RayCamera& camera, std::uint64_t frame = 0) {
  Image image;
  camera.render(frame, image);
  return image;
}

std::array<int, 3> pixel(const Image& image, int column, int row) {
  const auto at = static_cast<std::size_t>(3 * (320 * row + column));
  return {image[at], image[at + 1], image[at + 2]};
}

struct Spot {
  double x = 0.0;  ///< [px] to the right, from the picture's left edge
  double y = 0.0;  ///< [px] downwards, from its upper edge
  int pixels = 0;
};

Spot red_spot(const Image& image) {
  Spot spot;
  for (int row = 0; row < 240; ++row) {
    for (int column = 0; column < 320; ++column) {
      const auto [red, green, blue] = pixel(image, column, row);
      if (red < 100 || green > 50 || blue > 50) continue;
      spot.x += column + 0.5;
      spot.y += row + 0.5;
      ++spot.pixels;
    }
  }
  spot.x /= spot.pixels;
  spot.y /= spot.pixels;
  return spot;
}

/// Where the picture has a ball of 0.05 m, by the pinhole's formula, from the scene's camera: its
/// outline is an ellipse, whose middle is a little farther out than the ball's.
Spot seen(const RayCamera& camera, double x, double y, double z) {
  constexpr double kDown = 14.0 * mjPI / 180.0;
  constexpr double kRadius = 0.05;
  const double ahead = x * std::cos(kDown) - (z - 0.3) * std::sin(kDown);
  const double up = x * std::sin(kDown) + (z - 0.3) * std::cos(kDown);
  const double out = camera.focal_length() * ahead / (ahead * ahead - kRadius * kRadius);
  const double far = ahead * ahead - kRadius * kRadius;
  const double area = mjPI * std::pow(camera.focal_length() * kRadius / far, 2) * std::sqrt(far) *
                      std::sqrt(far + up * up + y * y);
  return {160.0 - out * y, 120.0 - out * up, static_cast<int>(area)};
}

std::uint64_t checksum(const Image& image) {
  std::uint64_t sum = 1469598103934665603U;  // FNV-1a
  for (const std::uint8_t byte : image) sum = (sum ^ byte) * 1099511628211U;
  return sum;
}

TEST(RayCamera, HasThePinholeOfTheDescription) {
  EXPECT_NEAR(make_camera().focal_length(), 120.0 / std::tan(25.0 * mjPI / 180.0), 1e-4);
  EXPECT_EQ(make_camera().size(), 320U * 240U * 3U);
}

TEST(RayCamera, HasTheMiddleOfABallWhereItIs) {
  RayCamera camera = make_camera();
  const std::size_t ball = *camera.find_body("ball");
  for (const double x : {0.5, 1.0, 2.0, 2.8}) {
    for (const double y : {-0.2, 0.0, 0.13}) {
      camera.place(ball, {{x, y, 0.05}, {1.0, 0.0, 0.0, 0.0}});
      const Spot found = red_spot(render(camera));
      const Spot truth = seen(camera, x, y, 0.05);
      EXPECT_NEAR(found.x, truth.x, 0.3) << x << ' ' << y;
      EXPECT_NEAR(found.y, truth.y, 0.3) << x << ' ' << y;
      EXPECT_NEAR(found.pixels, truth.pixels, 0.1 * truth.pixels) << x << ' ' << y;
    }
  }
}

TEST(RayCamera, ShadesColoursAndChecksTheFloor) {
  RayCamera camera = make_camera();
  const Image image = render(camera);
  const auto lit_from_above = pixel(image, 160, 120 - 8);   // upper part of the ball
  const auto lit_from_aside = pixel(image, 160, 120 + 18);  // its lower rim
  EXPECT_GT(lit_from_above[0], lit_from_aside[0] + 20);
  EXPECT_EQ(lit_from_above[1], 0);
  EXPECT_EQ(lit_from_above[2], 0);
  const auto sky = pixel(image, 160, 5);
  EXPECT_EQ(sky, (std::array<int, 3>{176, 196, 214}));
  const auto light = pixel(image, 100, 230);
  const auto dark = pixel(image, 220, 230);
  EXPECT_EQ(light[0], light[1]);
  EXPECT_NE(light, dark);
  EXPECT_NEAR(static_cast<double>(std::min(light[0], dark[0])) / std::max(light[0], dark[0]), 0.75,
              0.02);
}

/// What each pixel sees, by MuJoCo's own rays.
TEST(RayCamera, SeesWhatMuJoCosRaysMeet) {
  RayCamera camera = make_camera();
  const Image image = render(camera);
  const internal::Model model =
      std::move(internal::compile(kScene, "scene", "an MJCF description")).value();
  const internal::Data data(mj_makeData(model.get()));
  mj_forward(model.get(), data.get());
  constexpr std::array<mjtByte, mjNGROUP> kSeen{1, 1, 1, 0, 0, 0};
  const int cart = mj_name2id(model.get(), mjOBJ_BODY, "cart");
  int differ = 0;
  for (int row = 0; row < 240; row += 3) {
    for (int column = 0; column < 320; column += 3) {
      const std::array<mjtNum, 3> ray{(column - 159.5) / camera.focal_length(),
                                      (119.5 - row) / camera.focal_length(), -1.0};
      std::array<mjtNum, 3> direction{};
      mju_mulMatVec(direction.data(), data->cam_xmat, ray.data(), 3, 3);
      int geom = -1;
      mj_ray(model.get(), data.get(), data->cam_xpos, direction.data(), kSeen.data(), 1, cart,
             &geom);
      const auto [red, green, blue] = pixel(image, column, row);
      const std::array<bool, 3> has{red > 60, green > 60, blue > 60};
      std::array<bool, 3> expected{true, true, true};
      if (geom >= 0) {
        for (std::size_t i = 0; i < 3; ++i)
          expected[i] = model->geom_rgba[4 * static_cast<std::size_t>(geom) + i] > 0.3F;
      }
      differ += has == expected ? 0 : 1;
    }
  }
  EXPECT_LE(differ, 2);
}

TEST(RayCamera, DoesNotSeeWhatCarriesIt) {
  RayCamera camera = make_camera();
  const auto before_the_mast = pixel(render(camera), 160, 56);
  EXPECT_GT(before_the_mast[0], 100);
  EXPECT_EQ(before_the_mast[2], 0);  // the wall is yellow, the mast white
}

TEST(RayCamera, TurnsWithItsCarrier) {
  RayCamera camera = make_camera();
  const double half = 0.5 * 10.0 * mjPI / 180.0;  // to the left, so the ball is to the right
  camera.place(*camera.find_body("cart"),
               {{0.0, 0.0, 0.0}, {std::cos(half), 0.0, 0.0, std::sin(half)}});
  const Spot turned = red_spot(render(camera));
  const Spot truth = seen(camera, std::cos(2.0 * half), -std::sin(2.0 * half), 0.05);
  EXPECT_NEAR(turned.x, truth.x, 0.3);
  EXPECT_NEAR(turned.y, truth.y, 0.3);
}

TEST(RayCamera, NoiseHasItsDeviationAndFollowsItsSeed) {
  RayCamera clean = make_camera();
  RayCamera noisy = make_camera(4.0, 1);
  RayCamera same = make_camera(4.0, 1);
  RayCamera other = make_camera(4.0, 2);
  const Image image = render(noisy, 7);
  EXPECT_EQ(image, render(same, 7));
  EXPECT_NE(image, render(other, 7));
  EXPECT_NE(image, render(noisy, 8));
  const Image truth = render(clean, 7);
  double sum = 0.0;
  double squares = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (truth[i] < 20 || truth[i] > 235) continue;  // what was cut off says nothing
    const double difference = image[i] - truth[i];
    sum += difference;
    squares += difference * difference;
    ++count;
  }
  EXPECT_NEAR(sum / count, 0.0, 0.05);
  EXPECT_NEAR(std::sqrt(squares / count), 4.0, 0.1);
}

TEST(RayCamera, TwiceTheSameAndAsEver) {
  RayCamera first = make_camera(2.0, 5);
  RayCamera second = make_camera(2.0, 5);
  const Image image = render(first, 3);
  EXPECT_EQ(image, render(second, 3));
  EXPECT_EQ(image, render(first, 3));
  EXPECT_EQ(checksum(image), 17339177650960581491U);
}

TEST(RayCamera, TheLastBitsOfAPoseDoNotCount) {
  RayCamera camera = make_camera();
  const std::size_t cart = *camera.find_body("cart");
  const auto at = [&](double last) {
    camera.place(cart, {{0.1 + last, 0.2 - last, last}, {0.8 + last, last, -last, 0.6 - last}});
    return render(camera);
  };
  EXPECT_EQ(at(0.0), at(1e-16));
}

TEST(RayCamera, AllocatesNothing) {
  RayCamera camera = make_camera(2.0);
  Image image = render(camera);
  const std::size_t ball = *camera.find_body("ball");
  testing::RealtimeGuard guard;
  const auto work = [&] {
    camera.place(ball, {{1.5, 0.1, 0.05}, {1.0, 0.0, 0.0, 0.0}});
    camera.render(1, image);
  };
  EXPECT_EQ(guard.watch(work), 0U) << guard.report();
}

std::string mistake(const std::string& mjcf, const RayCamera::Options& options) {
  const auto made = RayCamera::parse(mjcf, "arena", options);
  return made ? "none" : made.error();
}

TEST(RayCamera, MistakesAreNamed) {
  EXPECT_EQ(mistake(kScene, {.camera = "nose"}), "arena: unknown camera 'nose'");
  EXPECT_THAT(mistake(kScene, {.camera = "eye", .width = 0}), HasSubstr("expected 1 to 4096"));
  EXPECT_THAT(mistake(kScene, {.camera = "eye", .noise = -1.0}), HasSubstr("expected 0 to 64"));
  EXPECT_EQ(mistake("", {.camera = "eye"}),
            "arena: the file is empty, expected an MJCF description");
  EXPECT_THAT(mistake("<mujoco><worldbody><geom name='egg' type='ellipsoid' size='1 1 2'/>"
                      "<camera name='eye'/></worldbody></mujoco>",
                      {.camera = "eye"}),
              HasSubstr("the geometry 'egg' is expected to be a plane, sphere, box or cylinder"));
}

}  // namespace
}  // namespace armature::sim
