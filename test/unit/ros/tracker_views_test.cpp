// SPDX-License-Identifier: BSD-3-Clause
// How the tracker uses the fields of view of several sensors: a car ahead of the vehicle is lost by
// its scanner, or by its camera too.
#include <cmath>

#include "message_samples.h"
#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/tracker_stage.h"

namespace datmo::tracker_views_test {
namespace {

constexpr double kPeriod = 0.1;        // s
constexpr double kSpeed = 5.0;         // m/s
constexpr double kWallRange = 5.0;     // m
constexpr double kHalfField = 0.5;     // rad
constexpr std::uint32_t kBeams = 101;  // 0.01 rad apart

class TrackerViewsTest : public testing::Test {
 protected:
  explicit TrackerViewsTest(const TrackerStageOptions& options = TrackerStageOptions())
      : stage_(options, buffer_, monitor_) {}

  /// One scan ahead, with or without a wall nearby, or with an unknown field of view.
  enum class Scanner { kFree, kBlocked, kSilent };
  enum class Camera { kNone, kFree, kBlocked };

  /// Runs one step; returns how many tracks are published.
  std::size_t step(Scanner scanner, Camera camera, const std::vector<std::string>& car_seen_by) {
    time_ += kPeriod;
    ObjectList list;
    list.stamp = Stamp::fromSeconds(time_);
    if (!car_seen_by.empty()) {
      list.objects.push_back(car(car_seen_by));
    }
    if (camera != Camera::kNone) {
      list.views.push_back({"camera", {Pose2(), -kHalfField, kHalfField, 60.0, 60.0}});
    }
    if (camera == Camera::kBlocked) {
      list.objects.push_back(van());
    }
    stage_.handleLabeledScan(toMessage(scan(scanner), "base_link", "map"));
    stage_.handleObjects(boost::make_shared<ObjectArray>(toMessage(list, "base_link")), list.stamp);
    const TrackArrayPtr tracks = stage_.next(list.stamp);
    views_ = tracks ? tracks->views.size() : 0;
    return tracks ? tracks->tracks.size() : 0;
  }

  /// Of the last step's message.
  std::size_t views() const { return views_; }

  void follow(const std::vector<std::string>& seen_by = {"lidar", "camera"}) {
    for (int i = 0; i < 40; ++i) {
      step(Scanner::kFree, Camera::kFree, seen_by);
    }
    ASSERT_EQ(step(Scanner::kFree, Camera::kFree, seen_by), 1U);
  }

  /// Returns the number of steps until no track is published, at most 40.
  int lifeWithout(Scanner scanner, Camera camera) {
    int steps = 0;
    while (steps < 40 && step(scanner, camera, {}) > 0) {
      ++steps;
    }
    return steps;
  }

 private:
  Object car(const std::vector<std::string>& sensors) const {
    Object object;
    object.box = {Pose2(12.0 + kSpeed * (time_ - samples::kStart), 0.0, 0.0), 4.2, 1.8};
    object.position_covariance = Eigen::Matrix2d::Identity() * 0.04;
    object.dynamic_state = DynamicState::kMoving;
    object.moving_fraction = 1.0;
    object.sensors = sensors;
    return object;
  }

  /// It is so near that nothing behind it is visible.
  static Object van() {
    Object object;
    object.box = {Pose2(6.0, 0.0, 0.0), 2.0, 8.0};
    object.position_covariance = Eigen::Matrix2d::Identity() * 0.04;
    object.dynamic_state = DynamicState::kStatic;
    object.sensors = {"camera"};
    return object;
  }

  LabeledScan scan(Scanner scanner) const {
    LabeledScan scan;
    scan.stamp = Stamp::fromSeconds(time_);
    if (scanner != Scanner::kSilent) {
      scan.field = {-kHalfField, 2.0 * kHalfField / (kBeams - 1), kBeams, 0.1, 80.0, 80.0};
    }
    for (std::uint32_t beam = 0; scanner == Scanner::kBlocked && beam < kBeams; ++beam) {
      ScanPoint point;
      point.beam = beam;
      point.range = kWallRange;
      point.bearing = scan.field.first_bearing + beam * scan.field.beam_spacing;
      point.position = kWallRange * Point2(std::cos(point.bearing), std::sin(point.bearing));
      scan.points.push_back(point);
    }
    return scan;
  }

  TransformBuffer buffer_{1.0};
  StageMonitor monitor_{"tracker"};
  TrackerStage stage_;
  std::size_t views_ = 0;
  double time_ = samples::kStart;
};

TEST_F(TrackerViewsTest, HiddenFromTheScannerAndSeenByTheCameraItIsKept) {
  follow();
  for (int i = 0; i < 30; ++i) {
    EXPECT_EQ(step(Scanner::kBlocked, Camera::kFree, {"camera"}), 1U) << i;
  }
}

TEST_F(TrackerViewsTest, TracksMissedByBothEnd) {
  follow();
  EXPECT_LE(lifeWithout(Scanner::kFree, Camera::kFree), 10);
}

TEST_F(TrackerViewsTest, TracksMissedByTheCameraEndThoughTheScannerIsBlocked) {
  follow();
  EXPECT_LE(lifeWithout(Scanner::kBlocked, Camera::kFree), 10);
}

TEST_F(TrackerViewsTest, HiddenFromBothItContinuesUnseen) {
  follow();
  const double silence = TrackerOptions().published_silence;
  EXPECT_NEAR(kPeriod * lifeWithout(Scanner::kBlocked, Camera::kBlocked), silence, kPeriod);
}

TEST_F(TrackerViewsTest, WithoutACameraTheScanDecidesAlone) {
  follow();
  const double silence = TrackerOptions().published_silence;
  EXPECT_NEAR(kPeriod * lifeWithout(Scanner::kBlocked, Camera::kNone), silence, kPeriod);
}

TEST_F(TrackerViewsTest, AScanWithoutFieldIsNoEvidenceAgainstWhatTheCameraCannotSee) {
  follow();
  const double silence = TrackerOptions().published_silence;
  EXPECT_NEAR(kPeriod * lifeWithout(Scanner::kSilent, Camera::kBlocked), silence, kPeriod);
}

TEST_F(TrackerViewsTest, TheTracksHaveTheirSensorsViews) {
  step(Scanner::kFree, Camera::kFree, {});
  EXPECT_EQ(views(), 2U);
  step(Scanner::kFree, Camera::kNone, {});
  EXPECT_EQ(views(), 1U);
  step(Scanner::kSilent, Camera::kNone, {});
  EXPECT_EQ(views(), 0U);
}

/// It tracks only the camera's objects.
class CameraTrackerTest : public TrackerViewsTest {
 protected:
  CameraTrackerTest() : TrackerViewsTest(options()) {}

 private:
  static TrackerStageOptions options() {
    TrackerStageOptions options;
    options.scan_view = false;
    return options;
  }
};

TEST_F(CameraTrackerTest, HiddenFromTheCameraItContinuesWhateverTheScannerSees) {
  follow({"camera"});
  const double silence = TrackerOptions().published_silence;
  EXPECT_NEAR(kPeriod * lifeWithout(Scanner::kFree, Camera::kBlocked), silence, kPeriod);
}

TEST_F(CameraTrackerTest, TracksMissedByTheCameraEnd) {
  follow({"camera"});
  EXPECT_LE(lifeWithout(Scanner::kFree, Camera::kFree), 10);
}

TEST_F(CameraTrackerTest, TheTracksHaveTheCamerasViewAlone) {
  step(Scanner::kFree, Camera::kFree, {});
  EXPECT_EQ(views(), 1U);
}

TEST_F(TrackerViewsTest, HiddenFromTheCameraItEndsWhereTheScannerWouldSeeIt) {
  follow({"camera"});
  EXPECT_LE(lifeWithout(Scanner::kFree, Camera::kBlocked), 10);
}

}  // namespace
}  // namespace datmo::tracker_views_test
