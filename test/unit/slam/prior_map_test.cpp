// SPDX-License-Identifier: BSD-3-Clause
#include <functional>
#include <map>
#include <utility>

#include "yard.h"
#include <gtest/gtest.h>

#include "datmo_fusion/slam/grid_slam.h"

namespace datmo::prior_map_test {
namespace {

/// The yard with a container in it, so that no two places look alike.
Scan scanAt(const Pose2& base, double seconds) {
  const Box2 container{Pose2(33.0, -2.0, 0.4), 5.0, 2.4};
  return Yard().scan(base, seconds, &container);
}

/// Drives with odometry from a pose, at 2 m/s.
class Vehicle {
 public:
  explicit Vehicle(const Pose2& start) : pose_(start) {}

  SlamResult step(GridSlam& slam, const Twist2& twist) {
    slam.addOdometry({Stamp::fromSeconds(1000.0 + seconds_), twist});
    const SlamResult result = slam.process(scanAt(pose_, seconds_));
    truth_ = pose_;
    pose_ = pose_ * arc(twist, 0.1);
    seconds_ += 0.1;
    return result;
  }

  void wait(double seconds) { seconds_ += seconds; }
  void carryTo(const Pose2& pose) { pose_ = pose; }

  /// At the last step.
  const Pose2& truth() const { return truth_; }

 private:
  Pose2 pose_;
  Pose2 truth_;
  double seconds_ = 0.0;
};

/// A map of the yard, driven there and back, in its own frame.
OccupancyMap mapOfYard() {
  GridSlam slam{GridSlamOptions{}};
  Vehicle vehicle{Pose2()};
  for (int i = 0; i < 60; ++i) {
    vehicle.step(slam, {2.0, 0.0});
  }
  for (int i = 0; i < 60; ++i) {
    vehicle.step(slam, {2.0, 0.55});
  }
  for (int i = 0; i < 60; ++i) {
    vehicle.step(slam, {2.0, 0.0});
  }
  return OccupancyMap::restored(GridSlamOptions{}.map, slam.map().evidence());
}

double positionError(const SlamResult& result, const Pose2& truth) {
  return (result.labeled_scan.base_in_map.pose.position() - truth.position()).norm();
}

/// Returns whether the result claims to be located although the pose is wrong.
bool isConfidentlyWrong(const SlamResult& result, const Pose2& truth) {
  return result.localization == Localization::kLocated &&
         (positionError(result, truth) > 0.5 ||
          std::abs(angleBetween(truth.heading(), result.labeled_scan.base_in_map.pose.heading())) >
              degrees(3.0));
}

TEST(PriorMapTest, GlobalLocalizationSucceedsWhileDriving) {
  const OccupancyMap map = mapOfYard();
  for (const Pose2& start :
       {Pose2(2.0, 1.0, 0.1), Pose2(20.0, -3.0, 3.0), Pose2(-5.0, 4.0, -0.8)}) {
    GridSlam slam{GridSlamOptions{}};
    slam.startIn({map, {{}, true}});
    Vehicle vehicle(start);
    SlamResult result = vehicle.step(slam, {2.0, 0.1});
    EXPECT_EQ(result.localization, Localization::kLost);
    EXPECT_TRUE(result.searches_prior_map);
    for (int i = 0; i < 80; ++i) {
      result = vehicle.step(slam, {1.5, 0.1});
      EXPECT_FALSE(isConfidentlyWrong(result, vehicle.truth())) << start.x();
    }
    EXPECT_EQ(result.localization, Localization::kLocated) << start.x();
    EXPECT_LT(positionError(result, vehicle.truth()), 0.3) << start.x();
    EXPECT_EQ(result.maps_begun, 0);
  }
}

TEST(PriorMapTest, InAPriorMapThePoseDoesNotDrift) {
  SearchRegion guess;
  guess.prior.covariance = Eigen::Vector3d(0.01, 0.01, 0.001).asDiagonal();
  GridSlam in_prior_map{GridSlamOptions{}};
  in_prior_map.startIn({mapOfYard(), guess});
  GridSlam in_new_map{GridSlamOptions{}};
  SlamResult found;
  SlamResult made;
  Vehicle one{Pose2()};
  Vehicle other{Pose2()};
  for (int i = 0; i < 80; ++i) {
    found = one.step(in_prior_map, {2.0, 0.2});
    made = other.step(in_new_map, {2.0, 0.2});
  }
  ASSERT_EQ(found.localization, Localization::kLocated);
  EXPECT_LT(found.drift(2, 2), 0.01 * made.drift(2, 2));
  EXPECT_LT(found.drift(0, 0), 0.01 * made.drift(0, 0));
}

TEST(PriorMapTest, FromAGuessItIsFoundThere) {
  GridSlam slam{GridSlamOptions{}};
  SearchRegion guess;
  guess.prior.pose = {4.0, 0.0, 0.0};
  guess.prior.covariance = Eigen::Vector3d(1.0, 1.0, 0.03).asDiagonal();
  slam.startIn({mapOfYard(), guess});
  Vehicle vehicle{Pose2(3.0, 1.0, 0.1)};
  SlamResult result = vehicle.step(slam, {2.0, 0.0});
  EXPECT_EQ(result.localization, Localization::kUncertain);
  EXPECT_NEAR(result.labeled_scan.base_in_map.pose.x(), 4.0, 1e-9);
  for (int i = 0; i < 50; ++i) {
    result = vehicle.step(slam, {2.0, 0.0});
    EXPECT_FALSE(isConfidentlyWrong(result, vehicle.truth()));
  }
  EXPECT_EQ(result.localization, Localization::kLocated);
  EXPECT_LT(positionError(result, vehicle.truth()), 0.3);
}

TEST(PriorMapTest, AWrongGuessIsAbandoned) {
  GridSlam slam{GridSlamOptions{}};
  SearchRegion guess;
  guess.prior.pose = {11.0, 1.0, 0.1};
  guess.prior.covariance = Eigen::Vector3d(1.0, 1.0, 0.03).asDiagonal();
  slam.startIn({mapOfYard(), guess});
  Vehicle vehicle{Pose2(2.0, 1.0, 0.1)};
  SlamResult result = vehicle.step(slam, {1.5, 0.25});
  for (int i = 0; i < 150; ++i) {
    result = vehicle.step(slam, {1.5, 0.25});
    EXPECT_FALSE(isConfidentlyWrong(result, vehicle.truth()));
  }
  EXPECT_EQ(result.localization, Localization::kLocated);
  EXPECT_LT(positionError(result, vehicle.truth()), 0.3);
}

TEST(PriorMapTest, WhileItIsLostThePriorMapIsUnchanged) {
  GridSlam slam{GridSlamOptions{}};
  slam.startIn({mapOfYard(), {{}, true}});
  const MapEvidence before = mapOfYard().evidence();
  Vehicle vehicle{Pose2(2.0, 1.0, 0.1)};
  for (int i = 0; i < 10; ++i) {
    vehicle.step(slam, {0.0, 0.0});
  }
  std::map<std::pair<int, int>, float> log_odds;
  for (const CellEvidence& known : slam.lastingMap().evidence().cells) {
    log_odds[{known.cell.column, known.cell.row}] = known.log_odds;
  }
  ASSERT_EQ(log_odds.size(), before.cells.size());
  for (const CellEvidence& known : before.cells) {
    EXPECT_EQ((log_odds[{known.cell.column, known.cell.row}]), known.log_odds);
  }
}

TEST(PriorMapTest, AtRestNothingIsConfirmed) {
  GridSlam slam{GridSlamOptions{}};
  slam.startIn({mapOfYard(), {{}, true}});
  Vehicle vehicle{Pose2(2.0, 1.0, 0.1)};
  for (int i = 0; i < 60; ++i) {
    EXPECT_EQ(vehicle.step(slam, {0.0, 0.0}).localization, Localization::kLost);
  }
}

/// A scan in which each beam ends at the first point (m, fixed frame) for which this is true.
Scan scanUpTo(const std::function<bool(const Point2&)>& isOccupied, const Pose2& base,
              double seconds) {
  Scan scan = scanAt(base, seconds);
  const Pose2 scanner = base * scan.scanner_in_base;
  for (Ray& ray : scan.rays) {
    const double direction = scanner.heading() + ray.bearing;
    const Point2 along(std::cos(direction), std::sin(direction));
    ray.range = 60.0;
    for (double range = 0.1; range < 60.0; range += 0.02) {
      if (isOccupied(scanner.position() + range * along)) {
        ray.range = range;
        break;
      }
    }
    ray.end = scan.scanner_in_base *
              Point2(ray.range * std::cos(ray.bearing), ray.range * std::sin(ray.bearing));
  }
  return scan;
}

/// The yard is unchanged by half a turn about its own center.
Scan scanInSymmetricYard(const Pose2& base, double seconds) {
  return scanUpTo(
      [](const Point2& at) {
        const bool pillar = std::hypot(std::abs(at.x()) - 11.0, std::abs(at.y()) - 5.0) < 0.8;
        return pillar || std::abs(at.x()) > 25.0 || std::abs(at.y()) > 12.0;
      },
      base, seconds);
}

TEST(PriorMapTest, IfTwoPlacesFitNoneIsChosen) {
  OccupancyMap map{GridSlamOptions{}.map};
  const auto show = [](OccupancyMap& shown, const Pose2& base, double seconds) {
    const Scan scan = scanInSymmetricYard(base, seconds);
    shown.update(scan, std::vector<PointState>(scan.rays.size(), PointState::kUnknown), base);
  };
  for (int i = 0; i < 40; ++i) {
    show(map, Pose2(-8.0 + 0.4 * i, 0.0, 0.0), 0.2 * i);
    show(map, Pose2(8.0 - 0.4 * i, 0.0, kPi), 0.2 * i + 0.1);
  }
  GridSlam slam{GridSlamOptions{}};
  slam.startIn({map, {{}, true}});
  Pose2 truth(-6.0, 1.0, 0.2);
  for (int i = 0; i < 70; ++i) {
    const Stamp stamp = Stamp::fromSeconds(1000.0 + 0.1 * i);
    slam.addOdometry({stamp, {1.5, 0.0}});
    EXPECT_EQ(slam.process(scanInSymmetricYard(truth, 0.1 * i)).localization, Localization::kLost);
    truth = truth * arc({1.5, 0.0}, 0.1);
  }
}

/// Another place: two walls that meet at an angle that no walls of the yard have.
Scan scanElsewhere(const Pose2& base, double seconds) {
  return scanUpTo(
      [](const Point2& at) {
        return at.y() > 3.0 + 0.25 * at.x() || at.y() < -3.0 - 0.3 * at.x() || at.x() > 40.0;
      },
      base, seconds);
}

TEST(PriorMapTest, InTheMapOfAnotherPlaceItStaysLost) {
  GridSlamOptions options;
  options.recovery.prior_search.max_boxes = 150000;  // several searches complete
  GridSlam slam{options};
  slam.startIn({mapOfYard(), {{}, true}});
  Pose2 truth;
  for (int i = 0; i < 40; ++i) {
    const Stamp stamp = Stamp::fromSeconds(1000.0 + 0.1 * i);
    slam.addOdometry({stamp, {1.5, 0.0}});
    EXPECT_EQ(slam.process(scanElsewhere(truth, 0.1 * i)).localization, Localization::kLost);
    truth = truth * arc({1.5, 0.0}, 0.1);
  }
}

TEST(PriorMapTest, CarriedElsewhereItIsFoundInAllOfTheMap) {
  GridSlam slam{GridSlamOptions{}};
  slam.startIn({mapOfYard(), {{}, true}});
  Vehicle vehicle{Pose2(2.0, 1.0, 0.1)};
  SlamResult result;
  for (int i = 0; i < 80; ++i) {
    result = vehicle.step(slam, {1.5, 0.1});
  }
  ASSERT_EQ(result.localization, Localization::kLocated);
  vehicle.wait(3.0);
  vehicle.carryTo(Pose2(22.0, -3.0, 3.0));
  for (int i = 0; i < 160; ++i) {
    result = vehicle.step(slam, {1.2, 0.0});
    EXPECT_FALSE(isConfidentlyWrong(result, vehicle.truth()));
  }
  EXPECT_EQ(result.localization, Localization::kLocated);
  EXPECT_EQ(result.maps_begun, 0);
  EXPECT_LT(positionError(result, vehicle.truth()), 0.3);
}

TEST(PriorMapTest, AResetStartsInThePriorMapAgain) {
  GridSlam slam{GridSlamOptions{}};
  slam.startIn({mapOfYard(), {{}, true}});
  Vehicle first{Pose2(2.0, 1.0, 0.1)};
  first.step(slam, {1.5, 0.1});
  slam.reset();
  Vehicle again{Pose2(2.0, 1.0, 0.1)};
  EXPECT_TRUE(again.step(slam, {1.5, 0.1}).searches_prior_map);
}

TEST(PriorMapTest, AMapTooLargeToSearchIsRefused) {
  const OccupancyMap yard = mapOfYard();
  MapEvidence evidence = yard.evidence();
  evidence.cells.push_back({{5000, 5000}, 1.0F, 1.0F, 0, 0, {}});
  const OccupancyMap wide = OccupancyMap::restored(GridSlamOptions{}.map, evidence);
  GridSlam slam{GridSlamOptions{}};
  EXPECT_THROW(slam.startIn({wide, {{}, true}}), std::invalid_argument);
}

}  // namespace
}  // namespace datmo::prior_map_test
