// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/box_projection.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace datmo::box_projection_test {
namespace {

const PinholeCamera kCamera{100.0, 200.0, 320.0, 240.0};
constexpr double kNear = 0.5;  // m

/// Right, up, forward of the camera as x, y, z of a box: it is on a plane `down` below the camera,
/// the middle of its bottom `forward` ahead.
Box3 boxAhead(double forward, double down, const Eigen::Vector3d& size) {
  Box3 box;
  box.pose.linear() << 0.0, -1.0, 0.0,  // its y is the camera's left
      0.0, 0.0, -1.0,                   // its z the camera's up
      1.0, 0.0, 0.0;                    // its x the camera's forward
  box.pose.translation() = Eigen::Vector3d(0.0, down, forward);
  box.size = size;
  return box;
}

TEST(BoxProjection, CornersByHand) {
  // From 9 to 11 m ahead, 1 m to each side, from 2 m below the camera to 1 m below it.
  const auto edges = projectBox(kCamera, boxAhead(10.0, 2.0, {2.0, 2.0, 1.0}), kNear);
  ASSERT_EQ(edges.size(), 12U);
  // Far left corner of the bottom: (-1, 2, 11).
  EXPECT_NEAR(edges[0].from.x(), 320.0 - 100.0 / 11.0, 1e-9);
  EXPECT_NEAR(edges[0].from.y(), 240.0 + 400.0 / 11.0, 1e-9);
  // Near left one: (-1, 2, 9).
  EXPECT_NEAR(edges[0].to.x(), 320.0 - 100.0 / 9.0, 1e-9);
  EXPECT_NEAR(edges[0].to.y(), 240.0 + 400.0 / 9.0, 1e-9);
  // Near right corner of the top: (1, 1, 9).
  EXPECT_NEAR(edges[6].from.x(), 320.0 + 100.0 / 9.0, 1e-9);
  EXPECT_NEAR(edges[6].from.y(), 240.0 + 200.0 / 9.0, 1e-9);
}

TEST(BoxProjection, UprightEdgesOfAnUprightBoxAreUpright) {
  const auto edges = projectBox(kCamera, boxAhead(10.0, 2.0, {4.0, 2.0, 1.5}), kNear);
  for (std::size_t i = 8; i < 12; ++i) {
    EXPECT_NEAR(edges[i].from.x(), edges[i].to.x(), 1e-9);
    EXPECT_GT(edges[i].from.y(), edges[i].to.y()) << "y is down, and edges begin at the bottom";
  }
}

TEST(BoxProjection, ABoxBehindTheCameraIsNotProjected) {
  EXPECT_TRUE(projectBox(kCamera, boxAhead(-10.0, 2.0, {4.0, 2.0, 1.5}), kNear).empty());
  EXPECT_TRUE(projectBox(kCamera, boxAhead(0.0, 2.0, {0.8, 2.0, 1.5}), kNear).empty())
      << "nearer than the limit";
}

TEST(BoxProjection, ABoxPartlyBehindTheCameraIsCutAtTheNearPlane) {
  // From 2 m behind the camera to 2 m ahead, 1 m to each side.
  const auto edges = projectBox(kCamera, boxAhead(0.0, 2.0, {4.0, 2.0, 1.0}), kNear);
  // Removed: those between the rear corners, one of the bottom and of the top, and two upright
  // ones.
  ASSERT_EQ(edges.size(), 8U);
  // The left edge of the bottom extends from (-1, 2, 2) to where it is clipped, (-1, 2, 0.5).
  EXPECT_NEAR(edges[0].from.x(), 270.0, 1e-9);
  EXPECT_NEAR(edges[0].from.y(), 440.0, 1e-9);
  EXPECT_NEAR(edges[0].to.x(), 120.0, 1e-9);
  EXPECT_NEAR(edges[0].to.y(), 1040.0, 1e-9);
}

TEST(BoxProjection, BoundsHoldTheBoxAndEndWithTheImage) {
  const auto inside =
      boundsInImage(projectBox(kCamera, boxAhead(10.0, 2.0, {2.0, 2.0, 1.0}), kNear), 640.0, 480.0);
  EXPECT_NEAR(inside.min().x(), 320.0 - 100.0 / 9.0, 1e-9);
  EXPECT_NEAR(inside.min().y(), 240.0 + 200.0 / 11.0, 1e-9);
  EXPECT_NEAR(inside.max().y(), 240.0 + 400.0 / 9.0, 1e-9);
  const auto cut =
      boundsInImage(projectBox(kCamera, boxAhead(0.0, 2.0, {4.0, 2.0, 1.0}), kNear), 640.0, 480.0);
  EXPECT_DOUBLE_EQ(cut.max().y(), 480.0);
}

TEST(BoxProjection, BoundsOutsideTheImageAreEmpty) {
  Box3 box = boxAhead(10.0, 2.0, {2.0, 2.0, 1.0});
  box.pose.translation().x() = 100.0;
  EXPECT_TRUE(boundsInImage(projectBox(kCamera, box, kNear), 640.0, 480.0).isEmpty());
  EXPECT_TRUE(boundsInImage({}, 640.0, 480.0).isEmpty());
}

}  // namespace
}  // namespace datmo::box_projection_test
