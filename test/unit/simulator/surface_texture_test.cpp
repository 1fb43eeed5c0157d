// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/surface_texture.h"

#include <gtest/gtest.h>

namespace datmo::simulator::surface_texture_test {
namespace {

constexpr double kPatch = 0.4;

RayEnd endOn(const Solid& solid, double height) { return {10.0, height, &solid}; }

TEST(SurfaceTexture, SharesAreAsAsked) {
  const SurfaceTexture texture(kPatch, 0.2, 0.5, 1);
  const Solid wall{Segment{{0.0, 0.0}, {100.0, 0.0}}, 100.0, Surface::kBody, kNoObject};
  int on_wall = 0;
  int on_road = 0;
  constexpr int kSide = 100;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      on_wall += texture.isEven(endOn(wall, i * kPatch), {j * kPatch, 0.0}) ? 1 : 0;
      on_road += texture.isEven({10.0, 0.0, nullptr}, {i * kPatch, j * kPatch}) ? 1 : 0;
    }
  }
  EXPECT_NEAR(on_wall / 1e4, 0.2, 0.02);
  EXPECT_NEAR(on_road / 1e4, 0.5, 0.02);
}

TEST(SurfaceTexture, IsTheSameWithinAPatch) {
  const SurfaceTexture texture(kPatch, 0.5, 0.5, 1);
  int changes = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto even = [&](double x) { return texture.isEven({10.0, 0.0, nullptr}, {x, 0.0}); };
    changes += even(0.04 * i) != even(0.04 * (i + 1)) ? 1 : 0;
  }
  EXPECT_LE(changes, 101);  // 40 m are 100 patches
  EXPECT_GT(changes, 20);
}

TEST(SurfaceTexture, MovesWithItsObject) {
  const SurfaceTexture texture(kPatch, 0.5, 0.5, 1);
  const Solid before{Box2{{0.0, 0.0, 0.0}, 4.4, 1.8}, 1.5, Surface::kBody, 7};
  const Solid after{Box2{{50.0, 20.0, 1.0}, 4.4, 1.8}, 1.5, Surface::kBody, 7};
  for (double y = -0.9; y < 0.9; y += 0.07) {
    const Point2 position(-2.2, y);
    EXPECT_EQ(texture.isEven(endOn(before, 0.7), position),
              texture.isEven(endOn(after, 0.7), Pose2(50.0, 20.0, 1.0) * position));
  }
}

TEST(SurfaceTexture, NoneAndAll) {
  const Solid pole{Circle{{10.0, 0.0}, 0.06}, 4.0, Surface::kBody, 3};
  EXPECT_FALSE(SurfaceTexture(kPatch, 0.0, 1.0, 1).isEven(endOn(pole, 1.0), {9.94, 0.0}));
  EXPECT_TRUE(SurfaceTexture(kPatch, 1.0, 0.0, 1).isEven(endOn(pole, 1.0), {9.94, 0.0}));
}

}  // namespace
}  // namespace datmo::simulator::surface_texture_test
