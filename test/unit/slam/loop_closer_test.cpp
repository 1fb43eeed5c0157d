// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/loop_closer.h"

#include <algorithm>
#include <cmath>

#include "drift_drive.h"
#include <gtest/gtest.h>

namespace datmo::loop_closer_test {
namespace {

constexpr double kStart = 1000.0;  // s, of the yard's stamps

Scan yard(const Pose2& base, double seconds) { return Yard().scan(base, seconds); }

/// Two endless walls 10 m apart with a pillar in front of one of them every 7 m.
Scan street(const Pose2& base, double seconds) {
  Scan scan = Yard().scan(base, seconds);
  const Pose2 scanner = base * scan.scanner_in_base;
  for (Ray& ray : scan.rays) {
    const Point2 along(std::cos(scanner.heading() + ray.bearing),
                       std::sin(scanner.heading() + ray.bearing));
    ray.hit = false;
    for (ray.range = 0.5; ray.range < 45.0 && !ray.hit; ray.range += 0.05) {
      const Point2 at = scanner.position() + ray.range * along;
      const bool pillar = at.x() - 7.0 * std::floor(at.x() / 7.0) < 2.0 && at.y() > 3.5;
      ray.hit = std::abs(at.y()) > 5.0 || pillar;
    }
    ray.end = scan.scanner_in_base *
              Point2(ray.range * std::cos(ray.bearing), ray.range * std::sin(ray.bearing));
  }
  return scan;
}

struct Drive {
  std::vector<Pose2> truth;
  std::vector<Pose2> live;
};

/// Adds keyframes with a pose that drifts.
Drive drive(LoopCloser& closer, const ScannedWorld& world, const std::vector<Pose2>& truth) {
  Drive drive{truth, {truth.front()}};
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (i > 0) {
      drive.live.push_back(drive.live.back() * drifting(truth[i - 1].inverse() * truth[i]));
    }
    closer.add(keyframe(world, truth[i], drive.live[i], static_cast<double>(i)));
  }
  return drive;
}

double maxError(const std::vector<Pose2>& truth, const std::vector<Pose2>& poses) {
  double max = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    max = std::max(max, (truth[i].position() - poses[i].position()).norm());
  }
  return max;
}

TEST(LoopCloserTest, TheSecondLapRemovesTheDrift) {
  LoopCloser closer(yardOptions());
  const Drive lapped = drive(closer, yard, roundTheYard(2));
  EXPECT_GT(closer.counts().closed, 5U);
  EXPECT_EQ(closer.counts().refuted, 0U);
  EXPECT_LT(closer.residual(), 1.0);
  const double before = maxError(lapped.truth, lapped.live);
  EXPECT_GT(before, 1.0);
  EXPECT_LT(maxError(lapped.truth, closer.graph().poses()), 0.4 * before);
  const double end =
      (closer.graph().poses().back().position() - lapped.truth.back().position()).norm();
  EXPECT_LT(end, 0.2) << "where the drive began, nothing has drifted";
  const Pose2 corrected = closer.mapInGlobal() * lapped.live.back();
  EXPECT_NEAR((corrected.position() - closer.graph().poses().back().position()).norm(), 0.0, 1e-9);
}

TEST(LoopCloserTest, WithoutALoopThePosesAreUnchanged) {
  LoopCloser closer(yardOptions());
  const Drive lapped = drive(closer, yard, roundTheYard(1));
  EXPECT_EQ(closer.counts().closed, 0U) << "shorter than min_loop before it ends";
  EXPECT_NEAR(maxError(lapped.live, closer.graph().poses()), 0.0, 1e-9);
}

/// Two stretches of 40 m, and the live SLAM's estimate: the second one begins where the first one
/// did, to within `sigma` (m).
LoopCounts returnTo(const ScannedWorld& world, double truth_x, double sigma) {
  LoopCloser closer(yardOptions());
  for (int stretch = 0; stretch < 2; ++stretch) {
    for (int i = 0; i <= 40; ++i) {
      Keyframe next = keyframe(world, Pose2(stretch * truth_x + i, 0.0, 0.0),
                               Pose2(i, 0.2 * stretch, 0.0), 100.0 * stretch + i);
      next.base_in_map.covariance =
          Eigen::Vector3d(stretch * sigma * sigma, stretch * 0.01, stretch * 1e-4).asDiagonal();
      closer.add(std::move(next));
    }
  }
  return closer.counts();
}

TEST(LoopCloserTest, AFalseLoopInARepeatingStreetIsRefused) {
  // The vehicle is 30 periods farther on, where everything looks the same.
  const LoopCounts counts = returnTo(street, 210.0 + 3.0, 10.0);
  EXPECT_EQ(counts.closed, 0U);
  EXPECT_GT(counts.ambiguous, 0U);
}

TEST(LoopCloserTest, AUniquePlaceIsFoundWithTheSameUncertainty) {
  const auto unlike_street = [](const Pose2& base, double seconds) {
    return Yard().scan(base * Pose2(-5.0, 0.0, 0.0), seconds);
  };
  EXPECT_GT(returnTo(unlike_street, 0.0, 10.0).closed, 0U);
}

TEST(LoopCloserTest, InTooWideAnAreaThereIsNoSearch) {
  const auto unlike_street = [](const Pose2& base, double seconds) {
    return Yard().scan(base * Pose2(-5.0, 0.0, 0.0), seconds);
  };
  const LoopCounts counts = returnTo(unlike_street, 0.0, 25.0);
  EXPECT_EQ(counts.closed + counts.ambiguous + counts.unlike, 0U);
}

TEST(LoopCloserTest, AClearlyDifferentPlaceIsNoLoop) {
  const auto other = [](const Pose2& base, double seconds) {
    return base.x() < 100.0 ? Yard().scan(base * Pose2(-5.0, 0.0, 0.0), seconds)
                            : street(base, seconds);
  };
  EXPECT_EQ(returnTo(other, 210.0, 3.0).closed, 0U);
}

TEST(LoopCloserTest, APlaceIsSearchedWithinItsOwnUncertainty) {
  // Two places 100 m apart, each visited twice. The path between them is known to 4 m, except for
  // the last time; on the first visit the second place is assumed to be 8 m to the left.
  const auto places = [](const Pose2& base, double seconds) {
    return base.x() < 70.0 ? Yard().scan(Pose2(-5.0, 0.0, 0.0) * base, seconds)
                           : Yard().scan(Pose2(134.0, 2.0, kPi) * base, seconds);
  };
  struct Visit {
    double x;       ///< m
    double left;    ///< m, of the live pose
    double sigmas;  ///< variances of the path up to here, in those of one path
  };
  LoopCloser closer(yardOptions());
  double seconds = 0.0;
  for (const Visit& visit : {Visit{0.0, 0.0, 0.0}, Visit{100.0, 8.0, 1.0}, Visit{0.0, 0.0, 2.0},
                             Visit{100.0, 0.0, 2.0}}) {
    for (int i = 0; i <= 40; ++i, seconds += 1.0) {
      Keyframe next = keyframe(places, Pose2(visit.x + i, 0.0, 0.0),
                               Pose2(visit.x + i, visit.left, 0.0), seconds);
      next.base_in_map.covariance = visit.sigmas * Eigen::Vector3d(16.0, 16.0, 1e-4).asDiagonal();
      closer.add(std::move(next));
    }
  }
  constexpr std::size_t kMiddleOfSecondVisit = 41 + 20;
  EXPECT_NEAR(closer.graph().poses()[kMiddleOfSecondVisit].y(), 0.0, 1.4);
  EXPECT_EQ(closer.counts().refuted, 0U);
}

TEST(LoopCloserTest, ALoopIsNoShorterThanASubmap) {
  LoopCloserOptions options = yardOptions();
  options.min_loop = 9.0;
  EXPECT_THROW(LoopCloser{options}, OptionError);
}

TEST(LoopCloserTest, LoopsHaveTheirTimes) {
  LoopCloser closer(yardOptions());
  const Drive lapped = drive(closer, yard, roundTheYard(2));
  ASSERT_EQ(closer.loops().size(), closer.counts().closed);
  for (const ClosedLoop& loop : closer.loops()) {
    const auto at = [&lapped](Stamp stamp) {
      return lapped.truth.at(std::lround(stamp.seconds() - kStart));
    };
    const Pose2 error = (at(loop.from).inverse() * at(loop.to)).inverse() * loop.motion;
    EXPECT_LT(error.position().norm(), 0.3);
    EXPECT_LT(std::abs(error.heading()), degrees(1.5));
  }
}

TEST(LoopCloserTest, MemoryIsBounded) {
  LoopCloserOptions options = yardOptions();
  options.max_scans = 20;
  LoopCloser closer(options);
  const std::vector<Pose2> truth = roundTheYard(3);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    closer.add(keyframe(yard, truth[i], truth[i], static_cast<double>(i)));
    ASSERT_LE(closer.scans(), 20U);
  }
  constexpr std::size_t kBytesPerScan = 81 * 4;
  constexpr std::size_t kBytesPerKeyframe = 700;
  EXPECT_LE(closer.bytes(), 20 * kBytesPerScan + truth.size() * kBytesPerKeyframe);
}

TEST(LoopCloserTest, TheTrajectoryHasAllPosesButThoseAtRest) {
  LoopCloser closer(yardOptions());
  closer.addPose({Stamp::fromSeconds(999.0), Pose2()});
  EXPECT_TRUE(closer.trajectory().empty()) << "before the first keyframe";
  closer.add(keyframe(yard, Pose2(), Pose2(5.0, 0.0, kPi / 2.0), 0.0));
  for (int i = 1; i <= 10; ++i) {
    closer.addPose({Stamp::fromSeconds(1000.0 + 0.1 * i), Pose2(5.0, 0.0, kPi / 2.0)});
  }
  EXPECT_LE(closer.trajectory().size(), 3U) << "two a second";
  closer.addPose({Stamp::fromSeconds(1001.1), Pose2(5.0, 0.5, kPi / 2.0)});
  EXPECT_NEAR(closer.trajectory().back().pose.y(), 0.5, 1e-9);
  closer.clear();
  EXPECT_TRUE(closer.trajectory().empty());
}

TEST(LoopCloserTest, TheMapCoversAllScans) {
  LoopCloser closer(yardOptions());
  drive(closer, yard, roundTheYard(1));
  const OccupancyMap map = closer.map();
  EXPECT_GT(map.occupancy(map.window().cellAt({40.0, 0.0})), 0.6) << "the yard's wall";
  EXPECT_LT(map.occupancy(map.window().cellAt({15.0, 0.0})), 0.4);
}

TEST(LoopCloserTest, AMapFarFromTheOriginIsNoLarger) {
  LoopCloser closer(yardOptions());
  closer.add(keyframe(yard, Pose2(), Pose2(30000.0, 30000.0, 0.0), 0.0));
  EXPECT_EQ(closer.map().window().cell_size, yardOptions().submaps.map.window.cell_size);
}

TEST(LoopCloserTest, AWideMapHasLargerCells) {
  LoopCloser closer(yardOptions());
  closer.add(keyframe(yard, Pose2(), Pose2(), 0.0));
  closer.add(keyframe(yard, Pose2(), Pose2(3000.0, 3000.0, 0.0), 1.0));
  EXPECT_GT(closer.map().window().cell_size, 1.0);
}

}  // namespace
}  // namespace datmo::loop_closer_test
