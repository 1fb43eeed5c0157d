// SPDX-License-Identifier: BSD-3-Clause
// The first fixes, which initialize the filter of the earth's frame.
#include <cmath>
#include <vector>

#include "earth_drive.h"
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "datmo_fusion/fusion/earth/consistent_pairs.h"
#include "datmo_fusion/fusion/earth/earth_frame_filter.h"

namespace datmo {
namespace {

// In standard deviations, of three degrees of freedom together: 99.9 % are below 4.03.
double deviationOf(const PoseWithCovariance& map, const Pose2& truth) {
  const Eigen::Vector3d error = errorOf(map.pose, truth);
  return std::sqrt(error.dot(map.covariance.inverse() * error));
}

// One position that is far off in some direction, anywhere at the start, is excluded from the
// estimate: the error stays consistent with the covariance, from the first frame on.
TEST(EarthFrameFilter, FixFarOffAtTheStartIsLeftOut) {
  EarthFrameOptions options;
  options.map_drift = options.map_turn = 0.0;  // this map does not drift
  int starts = 0;
  int large = 0;
  for (const double size : {1.0, 2.0, 5.0, 10.0, 30.0, 100.0}) {
    for (int outlier = 0; outlier < 10; ++outlier) {
      for (unsigned seed = 1; seed <= 20; ++seed) {
        Drive drive(seed, 0.5, options);
        EarthFrameFilter filter(options);
        for (int i = 0; i < 60; ++i) {
          EarthFix fix = drive.next();
          if (i == outlier) {
            fix.in_plane += size * Pose2(0.0, 0.0, 1.3 * seed).rotate({1.0, 0.0});
          }
          filter.add(fix);
          if (const auto map = filter.mapInPlane()) {
            const double deviation = deviationOf(*map, drive.truth());
            ASSERT_LT(deviation, 6.0)
                << size << " m off at " << outlier << ", seed " << seed << ", after " << i;
            ++starts;
            large += deviation > 4.0 ? 1 : 0;
          }
        }
        ASSERT_TRUE(filter.mapInPlane()) << size << " m off at " << outlier;
      }
    }
  }
  EXPECT_LT(large, 0.005 * starts) << "of " << starts;
}

TEST(EarthFrameFilter, FixesThatContradictEachOtherStartNothing) {
  const EarthFrameOptions options;
  Drive drive(3, 0.5, options);
  EarthFrameFilter filter(options);
  for (int i = 0; i < 60; ++i) {
    EarthFix fix = drive.next();
    if (i % 2 == 0) {
      fix.in_plane += Point2(0.0, 30.0);
    }
    filter.add(fix);
    ASSERT_FALSE(filter.mapInPlane()) << i;
  }
}

TEST(EarthFrameFilter, FixThatIsLeftOutAtTheStartIsCounted) {
  const EarthFrameOptions options;
  Drive drive(4, 0.5, options);
  EarthFrameFilter filter(options);
  for (int i = 0; i < 60; ++i) {
    EarthFix fix = drive.next();
    if (i == 3) {
      fix.in_plane += Point2(0.0, 30.0);
    }
    filter.add(fix);
  }
  EXPECT_EQ(filter.counts().gated, 1U);
  EXPECT_EQ(filter.counts().used, 59U);
}

TEST(ConsistentPairs, PairsThatPullTheFitAreDetected) {
  std::vector<PointPair> pairs;
  const Pose2 motion(4e5, -3e5, 2.0);
  for (int i = 0; i < 12; ++i) {
    const Point2 a(2.0 * i, 0.1 * i * i);
    pairs.push_back({a, motion * a, 0.01});
  }
  EXPECT_EQ(consistentPairs(pairs, 13.8).count, 12U);
  EXPECT_LT(consistentPairs(pairs, 13.8).variance_factor, 1e-3);
  pairs.front().b += Point2(0.0, 3.0);
  pairs.back().b += Point2(0.0, 3.0);
  const ConsistentPairs found = consistentPairs(pairs, 13.8);
  EXPECT_EQ(found.count, 10U);
  EXPECT_FALSE(found.fits.front());
  EXPECT_FALSE(found.fits.back());
  EXPECT_LT(found.variance_factor, 1e-3);
}

TEST(ConsistentPairs, FewFixesAreNotFiltered) {
  EXPECT_EQ(consistentPairs({}, 13.8).count, 0U);
  EXPECT_EQ(consistentPairs({PointPair(), PointPair()}, 13.8).count, 2U);
}

}  // namespace
}  // namespace datmo
