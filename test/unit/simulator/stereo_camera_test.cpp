// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/stereo_camera.h"

#include <algorithm>
#include <cmath>

#include "made_worlds.h"
#include "simulator/ground_truth.h"
#include <gtest/gtest.h>

namespace datmo::simulator::stereo_camera_test {
namespace {

constexpr double kTolerance = 1e-4;  // m; points are floats

/// A camera without faults above the origin.
StereoCameraOptions idealStereo() {
  StereoCameraOptions options;
  options.mount_x = 0.0;
  options.mount_y = 0.0;
  options.disparity_noise = 0.0;
  options.weak_texture_share = 0.0;
  options.weak_road_share = 0.0;
  options.edge_mixing = 0.0;
  options.outlier_share = 0.0;
  options.pitch_shake = 0.0;
  return options;
}

std::vector<Eigen::Vector3f> pointsIn(const World& world, const StereoCameraOptions& options,
                                      std::uint64_t seed = 1) {
  return StereoCamera(options, seed).measure(world, 0.0).points;
}

double heightOf(const Eigen::Vector3f& point, const StereoCameraOptions& options) {
  return options.mount_height - point.y();
}

/// Returns the column of the image in which a point is seen.
double columnOf(const Eigen::Vector3f& point, const StereoCameraOptions& options) {
  return options.middleColumn() + options.focal_length * point.x() / point.z();
}

TEST(StereoCamera, SeesTheRoadAndTheFaceOfABox) {
  const StereoCameraOptions options = idealStereo();
  World world = emptyWorld();
  world.addSolid({Box2{{12.0, 1.0, 0.0}, 4.0, 2.0}, 1.5, Surface::kBody, kNoObject});
  int on_face = 0;
  for (const Eigen::Vector3f& point : pointsIn(world, options)) {
    const double height = heightOf(point, options);
    if (height < kTolerance) {
      EXPECT_NEAR(height, 0.0, kTolerance);
      continue;
    }
    // Its front face is at x = 10 m, from y = 0 to 2 m; its right side is visible only from the
    // right.
    EXPECT_NEAR(point.z(), 10.0, kTolerance);
    EXPECT_GE(-point.x(), 0.0);
    EXPECT_LE(-point.x(), 2.0);
    EXPECT_LE(height, 1.5 + kTolerance);
    ++on_face;
  }
  // 76 columns and 57 rows of the image.
  EXPECT_NEAR(on_face, 76 * 57, 76 + 57);
}

TEST(StereoCamera, SitsWhereItIsMounted) {
  StereoCameraOptions options = idealStereo();
  options.mount_x = 1.8;
  options.mount_y = 0.17;
  World world = emptyWorld();
  world.addSolid({Segment{{10.0, 0.17}, {10.0, 50.0}}, 3.0, Surface::kBody, kNoObject});
  for (const Eigen::Vector3f& point : pointsIn(world, options)) {
    if (heightOf(point, options) > kTolerance) {
      EXPECT_NEAR(point.z(), 8.2, kTolerance);
      EXPECT_LE(point.x(), 0.0);
    }
  }
}

TEST(StereoCamera, FenceHidesOnlyObjectsBehindAndBelow) {
  const StereoCameraOptions options = idealStereo();
  World world = emptyWorld();
  world.addSolid(wallAt(10.0, 1.0));
  world.addSolid(wallAt(20.0));
  double lowest = 3.0;
  double highest = 0.0;
  for (const Eigen::Vector3f& point : pointsIn(world, options)) {
    if (std::abs(point.z() - 20.0) < kTolerance) {
      lowest = std::min(lowest, heightOf(point, options));
      highest = std::max(highest, heightOf(point, options));
    }
  }
  constexpr double kRow = 20.0 / 380.0;  // m from row to row
  EXPECT_NEAR(lowest, 0.7, kRow);
  EXPECT_GE(lowest, 0.7);
  EXPECT_NEAR(highest, 3.0, kRow);
}

TEST(StereoCamera, PaintIsRoad) {
  World painted = emptyWorld();
  painted.addSolid({Box2{{15.0, 0.0, 0.0}, 10.0, 5.0}, 0.0, Surface::kPaint, kNoObject});
  EXPECT_EQ(pointsIn(painted, StereoCameraOptions()),
            pointsIn(emptyWorld(), StereoCameraOptions()));
}

TEST(StereoCamera, PoleIsSeen) {
  const StereoCameraOptions options = idealStereo();
  for (const double x : {8.0, 15.0, 20.0}) {
    World world = emptyWorld();
    world.addStanding(objectKind("pole"), {x, 1.0, 0.0});
    const auto points = pointsIn(world, options);
    const auto on_pole = std::count_if(points.begin(), points.end(), [&](const auto& point) {
      return std::hypot(point.z() - x, -point.x() - 1.0) < 0.07 && heightOf(point, options) > 0.5;
    });
    EXPECT_GE(on_pole, 30) << x;
  }
}

TEST(StereoCamera, BackgroundBesideTheLeftBorderIsMissing) {
  const StereoCameraOptions options = idealStereo();
  World world = emptyWorld();
  world.addSolid({Segment{{5.0, -0.5}, {5.0, 0.5}}, 3.0, Surface::kBody, kNoObject});
  world.addSolid(wallAt(20.0));
  // The segment is in columns 217.5 to 293.5; disparities differ by 129.2 (1/5 - 1/20) = 19.4 px.
  double last_on_left = 0.0;
  double first_on_right = options.image_width;
  for (const Eigen::Vector3f& point : pointsIn(world, options)) {
    const double column = columnOf(point, options);
    if (std::abs(point.z() - 20.0) < kTolerance && column < options.middleColumn()) {
      last_on_left = std::max(last_on_left, column);
    } else if (std::abs(point.z() - 20.0) < kTolerance) {
      first_on_right = std::min(first_on_right, column);
    }
  }
  EXPECT_NEAR(last_on_left, 217.5 - 19.4, 3.0);
  EXPECT_NEAR(first_on_right, 293.5, 2.0);
}

/// Standard deviation of the depth of a wall across the image.
double depthDeviation(double x) {
  StereoCameraOptions options = idealStereo();
  options.disparity_noise = StereoCameraOptions().disparity_noise;
  World world = emptyWorld();
  world.addSolid(wallAt(x, 30.0));
  double square_sum = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    for (const Eigen::Vector3f& point : pointsIn(world, options, seed)) {
      if (heightOf(point, options) > 1.0) {
        square_sum += (point.z() - x) * (point.z() - x);
        ++count;
      }
    }
  }
  return std::sqrt(square_sum / count);
}

TEST(StereoCamera, DepthDeviationGrowsWithTheSquareOfDepth) {
  EXPECT_NEAR(depthDeviation(20.0) / depthDeviation(10.0), 4.0, 0.2);
  // Thesis 3.3.3: up to 5 m at 36 m; two standard deviations.
  EXPECT_NEAR(2.0 * depthDeviation(18.0), 5.0 / 4.0, 0.1);
}

TEST(StereoCamera, StepsThinThePointsOut) {
  StereoCameraOptions options = idealStereo();
  const auto all = static_cast<double>(pointsIn(emptyWorld(), options).size());
  options.column_step = 2;
  options.row_step = 4;
  EXPECT_NEAR(8.0 * static_cast<double>(pointsIn(emptyWorld(), options).size()) / all, 1.0, 0.05);
}

TEST(StereoCamera, NodMovesAllPointsUpOrDown) {
  StereoCameraOptions options = idealStereo();
  options.pitch_shake = 1.0;
  World world = emptyWorld();
  world.addSolid(wallAt(10.0));
  double square_sum = 0.0;
  constexpr int kPairs = 200;
  StereoCamera camera(options, 1);
  for (int i = 0; i < kPairs; ++i) {
    double top = 0.0;
    for (const Eigen::Vector3f& point : camera.measure(world, 0.0).points) {
      top = std::max(top, heightOf(point, options));
    }
    square_sum += (top - 3.0) * (top - 3.0);
  }
  EXPECT_NEAR(std::sqrt(square_sum / kPairs), 10.0 * std::tan(degrees(1.0)), 0.03);
}

TEST(StereoCamera, NothingOutsideItsRanges) {
  StereoCameraOptions options;
  options.min_range = 8.0;
  options.max_range = 20.0;
  World world = emptyWorld();
  world.addSolid(wallAt(21.0));
  const auto points = pointsIn(world, options);
  ASSERT_FALSE(points.empty());
  for (const Eigen::Vector3f& point : points) {
    EXPECT_GE(point.z(), 8.0 - kTolerance);
    EXPECT_LE(point.z(), 20.0 + kTolerance);
  }
}

TEST(StereoCamera, SameSeedSamePoints) {
  World world = emptyWorld();
  world.addSolid(wallAt(15.0));
  const StereoCameraOptions options;
  EXPECT_EQ(pointsIn(world, options, 3), pointsIn(world, options, 3));
  EXPECT_NE(pointsIn(world, options, 3), pointsIn(world, options, 4));
}

TEST(StereoCamera, TruthNamesItsVisibleObjects) {
  World world = emptyWorld();
  world.addStanding(objectKind("car"), {20.0, 0.0, kPi / 2.0});
  world.addStanding(objectKind("car"), {45.0, 10.0, kPi / 2.0});  // beyond its effective range
  world.addStanding(objectKind("car"), {10.0, 15.0, kPi / 2.0});  // outside of the image
  LaserScanner scanner(idealScanner(), RandomStream(1, "scanner"));
  const auto truths =
      objectTruths(world, world.at(0.0), scanner.measure(world, 0.0),
                   {scanner.viewpoint(), StereoCamera({}, 1).viewpoint()}, GroundTruthOptions());
  ASSERT_EQ(truths.size(), 3U);
  EXPECT_EQ(truths[0].visible_to, (std::vector<std::string>{"scanner", "stereo"}));
  EXPECT_EQ(truths[1].visible_to, std::vector<std::string>{"scanner"});
  EXPECT_EQ(truths[2].visible_to, std::vector<std::string>{"scanner"});
}

TEST(StereoCamera, ContradictionsAreRefused) {
  StereoCameraOptions options;
  options.min_range = options.max_range;
  EXPECT_THROW(StereoCamera(options, 1), OptionError);
  options = StereoCameraOptions();
  options.baseline = 0.0;
  EXPECT_THROW(StereoCamera(options, 1), OptionError);
}

}  // namespace
}  // namespace datmo::simulator::stereo_camera_test
