// SPDX-License-Identifier: BSD-3-Clause
// GridSlam that continues from the state of another one, as after its process was killed.
#include <cmath>
#include <optional>
#include <vector>

#include "yard.h"
#include <gtest/gtest.h>

#include "datmo_fusion/slam/grid_slam.h"

namespace datmo::continued_slam_test {
namespace {

constexpr double kPeriod = 0.1;  // s, of scans and odometry

/// The yard with a container in it, so that no two places look alike.
Scan scanAt(const Pose2& base, double seconds) {
  const Box2 container{Pose2(33.0, -2.0, 0.4), 5.0, 2.4};
  return Yard().scan(base, seconds, &container);
}

enum class Odometry { kNone, kTwist, kPose };

/// Drives with odometry.
class Vehicle {
 public:
  explicit Vehicle(Odometry odometry) : odometry_(odometry) {}

  SlamResult step(GridSlam& slam, const Twist2& twist) {
    const Stamp stamp = Stamp::fromSeconds(1000.0 + seconds_);
    if (odometry_ != Odometry::kNone) {
      slam.addOdometry(
          {stamp, twist, odometry_ == Odometry::kPose ? std::make_optional(pose_) : std::nullopt});
    }
    const SlamResult result = slam.process(scanAt(pose_, seconds_));
    truth_ = pose_;
    go(twist, kPeriod);
    return result;
  }

  SlamResult drive(GridSlam& slam, const Twist2& twist, int scans) {
    SlamResult last;
    for (int i = 0; i < scans; ++i) {
      last = step(slam, twist);
    }
    return last;
  }

  /// Without any measurement.
  void go(const Twist2& twist, double seconds) {
    pose_ = pose_ * arc(twist, seconds);
    seconds_ += seconds;
  }
  void carryTo(const Pose2& pose) { pose_ = pose; }

  /// At the last step.
  const Pose2& truth() const { return truth_; }

 private:
  Odometry odometry_;
  Pose2 pose_;
  Pose2 truth_;
  double seconds_ = 0.0;
};

const Pose2& poseOf(const SlamResult& result) { return result.labeled_scan.base_in_map.pose; }

double positionError(const SlamResult& result, const Vehicle& vehicle) {
  return (poseOf(result).position() - vehicle.truth().position()).norm();
}

bool isLocated(const SlamResult& result) {
  return result.localization == Localization::kLocated && !result.may_be_kidnapped;
}

/// Returns whether the result claims to know the pose although it is wrong.
bool isConfidentlyWrong(const SlamResult& result, const Vehicle& vehicle) {
  const Eigen::Matrix3d& covariance = result.labeled_scan.base_in_map.covariance;
  const double sigma = std::sqrt(covariance.topLeftCorner<2, 2>().trace());
  return isLocated(result) && positionError(result, vehicle) > std::max(0.5, 3.0 * sigma);
}

const GridSlamOptions kOptions;
const Twist2 kTwist{2.0, 0.1};

/// Continues in another GridSlam.
GridSlam continued(const GridSlam& slam) {
  GridSlam next{kOptions};
  next.continueFrom(*slam.state(), slam.map().windowEvidence().cells);
  return next;
}

void expectSameCells(const MapEvidence& one, const MapEvidence& other) {
  ASSERT_EQ(one.cells.size(), other.cells.size());
  for (std::size_t i = 0; i < one.cells.size(); ++i) {
    EXPECT_EQ(one.cells[i].cell, other.cells[i].cell);
    EXPECT_EQ(one.cells[i].log_odds, other.cells[i].log_odds);
    EXPECT_NEAR(one.cells[i].age, other.cells[i].age, 1e-5F);
    EXPECT_EQ(one.cells[i].hits.count, other.cells[i].hits.count);
    EXPECT_EQ(one.cells[i].hits.sum, other.cells[i].hits.sum);
  }
}

TEST(ContinuedSlamTest, TheMapAndThePoseAreTheSame) {
  GridSlam slam{kOptions};
  Vehicle vehicle(Odometry::kTwist);
  const SlamResult last = vehicle.drive(slam, kTwist, 40);
  const GridSlam next = continued(slam);
  expectSameCells(slam.map().windowEvidence(), next.map().windowEvidence());
  EXPECT_EQ(next.map().window().corner, slam.map().window().corner);
  const auto state = next.state();
  ASSERT_TRUE(state);
  EXPECT_EQ(state->pose.estimate.pose.position(), poseOf(last).position());
  EXPECT_EQ(state->map.drift, slam.state()->map.drift);
}

TEST(ContinuedSlamTest, WithoutAGapItGoesOnAsBefore) {
  GridSlam slam{kOptions};
  Vehicle vehicle(Odometry::kTwist);
  vehicle.drive(slam, kTwist, 40);
  GridSlam next = continued(slam);
  for (int i = 0; i < 20; ++i) {
    const SlamResult result = vehicle.step(next, kTwist);
    EXPECT_TRUE(isLocated(result));
    EXPECT_LT(positionError(result, vehicle), 0.15);
  }
}

TEST(ContinuedSlamTest, AtRestAnOutageIsAGapOfScans) {
  GridSlam slam{kOptions};
  Vehicle vehicle(Odometry::kTwist);
  vehicle.drive(slam, kTwist, 40);
  vehicle.drive(slam, {}, 20);
  GridSlam next = continued(slam);
  vehicle.go({}, 2.0);
  Vehicle never_killed = vehicle;
  SlamResult result;
  for (int i = 0; i < 40; ++i) {
    result = vehicle.step(next, {});
    const SlamResult expected = never_killed.step(slam, {});
    EXPECT_EQ(result.localization, expected.localization) << i;
    EXPECT_LT((poseOf(result).position() - poseOf(expected).position()).norm(), 0.05) << i;
  }
  EXPECT_TRUE(isLocated(result));
  EXPECT_EQ(result.maps_begun, 0) << "found in the old map";
  EXPECT_LT(positionError(result, vehicle), 0.1);
}

TEST(ContinuedSlamTest, WhileDrivingItSoonContinuesInANewMapInTheSameFrame) {
  for (const Odometry odometry : {Odometry::kNone, Odometry::kTwist}) {
    for (const Twist2& meanwhile : {kTwist, Twist2{0.5, 0.0}, Twist2{3.0, 0.2}}) {
      GridSlam slam{kOptions};
      Vehicle vehicle(odometry);
      vehicle.drive(slam, kTwist, 40);
      GridSlam next = continued(slam);
      vehicle.go(meanwhile, 2.0);
      EXPECT_EQ(vehicle.step(next, kTwist).localization, Localization::kUncertain);
      vehicle.drive(next, kTwist, 7);
      for (int i = 0; i < 40; ++i) {
        const SlamResult result = vehicle.step(next, kTwist);
        EXPECT_TRUE(isLocated(result)) << meanwhile.forward_speed << ", " << i;
        EXPECT_FALSE(isConfidentlyWrong(result, vehicle)) << meanwhile.forward_speed << ", " << i;
        EXPECT_EQ(result.maps_begun, 1) << meanwhile.forward_speed << ", " << i;
      }
    }
  }
}

TEST(ContinuedSlamTest, PosesOfTheOdometryMeasureTheOutage) {
  for (const bool odometry_first : {false, true}) {
    GridSlam slam{kOptions};
    Vehicle vehicle(Odometry::kPose);
    vehicle.drive(slam, kTwist, 40);
    const SlamState state = *slam.state();
    const MapEvidence window = slam.map().windowEvidence();
    vehicle.go({1.0, -0.1}, 2.0);
    GridSlam next{kOptions};
    if (odometry_first) {  // received before the first scan
      vehicle.step(slam, kTwist);
      next.addOdometry(*slam.odometry().newest());
    }
    next.continueFrom(state, window.cells);
    const SlamResult result = vehicle.step(next, kTwist);
    EXPECT_TRUE(isLocated(result)) << odometry_first;
    EXPECT_LT(positionError(result, vehicle), 0.2) << odometry_first;
  }
}

TEST(ContinuedSlamTest, CarriedElsewhereMeanwhileItIsNeverConfidentlyWrong) {
  for (const Pose2& elsewhere : {Pose2(25.0, 3.0, 2.5), Pose2(2.0, -4.0, -1.5)}) {
    for (const Odometry odometry : {Odometry::kTwist, Odometry::kPose}) {
      GridSlam slam{kOptions};
      Vehicle vehicle(odometry);
      vehicle.drive(slam, kTwist, 40);
      GridSlam next = continued(slam);
      vehicle.go({0.0, 0.0}, 3.0);
      vehicle.carryTo(elsewhere);
      for (int i = 0; i < 80; ++i) {
        const SlamResult result = vehicle.step(next, kTwist);
        EXPECT_FALSE(isConfidentlyWrong(result, vehicle)) << elsewhere.x() << ", scan " << i;
      }
    }
  }
}

TEST(ContinuedSlamTest, InAPriorMapItContinuesInIt) {
  GridSlam mapping{kOptions};
  Vehicle before(Odometry::kTwist);
  before.drive(mapping, {2.0, 0.0}, 80);
  SearchRegion guess;
  guess.prior.covariance = Eigen::Vector3d(0.01, 0.01, 0.001).asDiagonal();
  const PriorMap prior{OccupancyMap::restored(kOptions.map, mapping.map().evidence()), guess};
  GridSlam slam{kOptions};
  slam.startIn(prior);
  Vehicle vehicle(Odometry::kTwist);
  ASSERT_TRUE(isLocated(vehicle.drive(slam, {2.0, 0.0}, 40)));
  GridSlam next{kOptions};
  next.startIn(prior);
  next.continueFrom(*slam.state(), slam.map().windowEvidence().cells);
  EXPECT_GE(next.map().evidence().cells.size(), prior.map.evidence().cells.size());
  const SlamResult result = vehicle.step(next, {2.0, 0.0});
  EXPECT_TRUE(isLocated(result));
  EXPECT_LT(positionError(result, vehicle), 0.2);
}

TEST(ContinuedSlamTest, ThereIsNoStateUnlessThePoseIsKnown) {
  GridSlam slam{kOptions};
  Vehicle vehicle(Odometry::kTwist);
  EXPECT_FALSE(slam.state()) << "no scan";
  vehicle.step(slam, kTwist);
  EXPECT_FALSE(slam.state()) << "the scans' interval is not known";
  vehicle.drive(slam, kTwist, 20);
  EXPECT_TRUE(slam.state());
  vehicle.go(kTwist, 2.0);
  ASSERT_EQ(vehicle.step(slam, kTwist).localization, Localization::kUncertain);
  EXPECT_FALSE(slam.state());
}

}  // namespace
}  // namespace datmo::continued_slam_test
