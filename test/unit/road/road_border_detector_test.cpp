// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/road_border_detector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "datmo_fusion/common/random.h"

namespace datmo::road_border_detector_test {
namespace {

/// A wall along x, m, map frame.
struct Wall {
  double y = 0.0;
  double first = -100.0;
  double last = 300.0;
};

/// A wall along y, m, map frame.
struct CrossWall {
  double x = 0.0;
  double first = -100.0;
  double last = 100.0;
};

/// A vehicle that drives along x between walls.
class RoadBorderDetectorTest : public testing::Test {
 protected:
  static constexpr double kPeriod = 0.06;  ///< s
  static constexpr double kSigma = 0.1;    ///< m

  /// What a scanner with 161 beams of 1 degree sees from a pose.
  LabeledScan scanFrom(const Pose2& pose) {
    LabeledScan scan;
    scan.stamp = stamp_;
    scan.base_in_map.pose = pose;
    scan.scanner_in_base = Pose2(3.0, 0.0, 0.0);
    scan.field = {degrees(-80.0), degrees(1.0), 161, 1.0, 40.0, 50.0, 0.0};
    const Pose2 scanner = pose * scan.scanner_in_base;
    for (std::uint32_t beam = 0; beam < scan.field.beams; ++beam) {
      const double bearing = scan.field.first_bearing + beam * scan.field.beam_spacing;
      const double range = rangeOf(scanner, scanner.heading() + bearing);
      if (range <= scan.field.range) {
        const double seen = range + random_.normal(kSigma);
        const Point2 end(seen * std::cos(bearing), seen * std::sin(bearing));
        scan.points.push_back(
            {scan.scanner_in_base * end, seen, bearing, beam, PointState::kMoving});
      }
    }
    stamp_ = stamp_ + kPeriod;
    return scan;
  }

  /// Drives this far along x, m; returns the road at its end.
  RoadModel drive(double distance, double speed = 8.0) {
    RoadModel road;
    for (double driven = 0.0; driven < distance; driven += speed * kPeriod) {
      x_ += speed * kPeriod;
      road = detector_.update(scanFrom(Pose2(x_, 0.0, 0.0)));
    }
    return road;
  }

  /// Largest distance of points up to 20 m ahead to the line at y, m; infinite if there are none.
  double worstError(const RoadModel& road, RoadSide side, double y) const {
    double worst = -1.0;
    for (const RoadBorder& border : road.borders) {
      for (const BorderPoint& point : border.points) {
        if (border.side == side && point.position.x() < x_ + 20.0) {
          worst = std::max(worst, std::abs(point.position.y() - y));
        }
      }
    }
    return worst < 0.0 ? std::numeric_limits<double>::infinity() : worst;
  }

  std::vector<Wall> walls_{{4.0}, {-3.0}};
  std::vector<CrossWall> cross_walls_;
  RoadBorderDetector detector_{RoadBorderDetectorOptions()};
  double x_ = 0.0;
  Stamp stamp_ = Stamp::fromSeconds(100.0);

 private:
  double rangeOf(const Pose2& scanner, double direction) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Wall& wall : walls_) {
      const double range = (wall.y - scanner.y()) / std::sin(direction);
      const double x = scanner.x() + range * std::cos(direction);
      if (range > 0.0 && x >= wall.first && x <= wall.last) {
        nearest = std::min(nearest, range);
      }
    }
    for (const CrossWall& wall : cross_walls_) {
      const double range = (wall.x - scanner.x()) / std::cos(direction);
      const double y = scanner.y() + range * std::sin(direction);
      if (range > 0.0 && y >= wall.first && y <= wall.last) {
        nearest = std::min(nearest, range);
      }
    }
    return nearest;
  }

  Random random_{11};
};

TEST_F(RoadBorderDetectorTest, FindsBothBorders) {
  const RoadModel road = drive(30.0);
  EXPECT_LT(worstError(road, RoadSide::kLeft, 4.0), 0.3);
  EXPECT_LT(worstError(road, RoadSide::kRight, -3.0), 0.3);
  EXPECT_FALSE(road.at_intersection);
  for (const RoadBorder& border : road.borders) {
    EXPECT_GE(border.points.size(), 2U);
    EXPECT_GT(border.probability, 0.9);
    EXPECT_EQ(border.unseen_for, 0.0);
  }
}

TEST_F(RoadBorderDetectorTest, OneSideOnly) {
  walls_ = {{-3.0}};
  const RoadModel road = drive(30.0);
  EXPECT_LT(worstError(road, RoadSide::kRight, -3.0), 0.3);
  EXPECT_TRUE(std::isinf(worstError(road, RoadSide::kLeft, 4.0)));
}

TEST_F(RoadBorderDetectorTest, BordersEndAtASideStreetAndContinueBehindIt) {
  walls_ = {{-3.0}, {4.0, -100.0, 45.0}, {4.0, 60.0, 300.0}};
  drive(30.0);
  bool before = false;
  bool behind = false;
  while (x_ < 56.0) {
    for (const RoadBorder& border : drive(1.0).borders) {
      for (const BorderPoint& point : border.points) {
        const double x = point.position.x();
        const bool left = border.side == RoadSide::kLeft && !border.side_street;
        EXPECT_FALSE(left && x > 48.0 && x < 57.0) << x;
        before = before || (left && x < 45.0);
        behind = behind || (left && x > 60.0);
      }
    }
  }
  EXPECT_TRUE(before);
  EXPECT_TRUE(behind);
}

TEST_F(RoadBorderDetectorTest, IsAtAnIntersectionWhereAStreetCrosses) {
  walls_ = {{-5.0, -100.0, 45.0}, {5.0, -100.0, 45.0}, {-5.0, 65.0, 300.0}, {5.0, 65.0, 300.0}};
  cross_walls_ = {{45.0, 5.0}, {65.0, 5.0}, {45.0, -100.0, -5.0}, {65.0, -100.0, -5.0}};
  EXPECT_FALSE(drive(30.0).at_intersection);
  bool found = false;
  while (x_ < 65.0) {
    found = drive(0.5).at_intersection || found;
  }
  EXPECT_TRUE(found);
  EXPECT_FALSE(drive(20.0).at_intersection);
}

TEST_F(RoadBorderDetectorTest, IsAtAnIntersectionAtWhichItTurns) {
  walls_ = {{-5.0, -100.0, 45.0}, {5.0, -100.0, 45.0}, {-5.0, 65.0, 300.0}, {5.0, 65.0, 300.0}};
  cross_walls_ = {{45.0, 5.0}, {65.0, 5.0}, {45.0, -100.0, -5.0}, {65.0, -100.0, -5.0}};
  bool found = drive(46.0).at_intersection;
  constexpr double kRadius = 8.0;  // m, to the right
  for (double turned = 0.0; turned < 0.5 * kPi; turned += 0.05) {
    const Pose2 pose(x_ + kRadius * std::sin(turned), kRadius * (std::cos(turned) - 1.0), -turned);
    found = detector_.update(scanFrom(pose)).at_intersection || found;
  }
  EXPECT_TRUE(found);
}

TEST_F(RoadBorderDetectorTest, KeepsABorderThatIsHiddenForAShortTime) {
  drive(30.0);
  walls_ = {{4.0}, {-2.0, x_ + 4.0, x_ + 16.0}};  // a lorry that keeps up with the vehicle
  const RoadModel road = drive(1.0);
  EXPECT_LT(worstError(road, RoadSide::kRight, -3.0), 1.2);
}

TEST_F(RoadBorderDetectorTest, NothingReflects) {
  walls_ = {};
  const RoadModel road = drive(30.0);
  EXPECT_TRUE(road.borders.empty());
  EXPECT_FALSE(road.at_intersection);
}

TEST_F(RoadBorderDetectorTest, AStationaryVehicleSeesTheSameRoad) {
  drive(30.0);
  RoadModel road;
  for (int scan = 0; scan < 300; ++scan) {
    road = detector_.update(scanFrom(Pose2(x_, 0.0, 0.0)));
  }
  EXPECT_LT(worstError(road, RoadSide::kLeft, 4.0), 0.3);
  EXPECT_LT(worstError(road, RoadSide::kRight, -3.0), 0.3);
  EXPECT_FALSE(road.at_intersection);
}

TEST_F(RoadBorderDetectorTest, AWaitingVehicleDoesNotBecomeMoreCertainOfItsBorders) {
  const auto sigmaAhead = [this](const RoadModel& road) {
    double sigma = 0.0;
    for (const RoadBorder& border : road.borders) {
      for (const BorderPoint& point : border.points) {
        const bool here = std::abs(point.position.x() - x_ - 10.0) < 1.0;
        sigma = here ? std::max(sigma, point.sigma) : sigma;
      }
    }
    return sigma;
  };
  const double arrived = sigmaAhead(drive(30.0));
  RoadModel road;
  for (int scan = 0; scan < 200; ++scan) {
    road = detector_.update(scanFrom(Pose2(x_, 0.0, 0.0)));
  }
  ASSERT_GT(arrived, 0.0);
  EXPECT_GT(sigmaAhead(road), 0.6 * arrived);
}

TEST_F(RoadBorderDetectorTest, ForgetsAllAfterAJumpAGapAndAReset) {
  EXPECT_FALSE(drive(30.0).borders.empty());
  x_ += 1000.0;
  EXPECT_TRUE(drive(0.1).borders.empty());
  x_ = 0.0;
  EXPECT_FALSE(drive(30.0).borders.empty());
  stamp_ = stamp_ + 60.0;
  EXPECT_TRUE(drive(0.1).borders.empty());
  EXPECT_FALSE(drive(30.0).borders.empty());
  detector_.reset();
  EXPECT_TRUE(drive(0.1).borders.empty());
}

TEST_F(RoadBorderDetectorTest, TheSameScansGiveTheSameRoad) {
  std::vector<LabeledScan> scans;
  for (int i = 0; i < 60; ++i) {
    scans.push_back(scanFrom(Pose2(0.5 * i, 0.0, 0.0)));
  }
  RoadBorderDetector again{RoadBorderDetectorOptions()};
  for (const LabeledScan& scan : scans) {
    const RoadModel first = detector_.update(scan);
    const RoadModel second = again.update(scan);
    ASSERT_EQ(first.borders.size(), second.borders.size());
    for (std::size_t i = 0; i < first.borders.size(); ++i) {
      ASSERT_EQ(first.borders[i].points.back().position, second.borders[i].points.back().position);
    }
  }
}

TEST_F(RoadBorderDetectorTest, ThesisTakesTheBestWindowOfEachSide) {
  RoadBorderDetectorOptions options;
  options.method = RoadBorderMethod::kThesis;
  detector_ = RoadBorderDetector(options);
  const RoadModel road = drive(30.0);
  ASSERT_EQ(road.borders.size(), 2U);
  EXPECT_LT(worstError(road, RoadSide::kLeft, 4.0), 0.5);
  EXPECT_LT(worstError(road, RoadSide::kRight, -3.0), 0.5);
  EXPECT_FALSE(road.at_intersection);
}

TEST_F(RoadBorderDetectorTest, AWindowShorterThanTheSpacingHasBothItsEnds) {
  RoadBorderDetectorOptions options;
  options.method = RoadBorderMethod::kThesis;
  options.search.length = 15.0;
  options.published.spacing = 20.0;
  detector_ = RoadBorderDetector(options);
  const RoadModel road = drive(30.0);
  ASSERT_FALSE(road.borders.empty());
  for (const RoadBorder& border : road.borders) {
    ASSERT_EQ(border.points.size(), 2U);
    EXPECT_NEAR((border.points[1].position - border.points[0].position).norm(), 15.0, 1e-9);
  }
}

TEST_F(RoadBorderDetectorTest, RefusesAnUnknownMethod) {
  EXPECT_THROW(readOptions<RoadBorderDetectorOptions>({{"method", std::string("guess")}}),
               OptionError);
}

}  // namespace
}  // namespace datmo::road_border_detector_test
