// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "object_fusion_sample.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/stage/object_fusion_stage.h"

namespace datmo::object_fusion_input_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST_F(ObjectFusionStageTest, BadObjectsAreLeftOutAndTheirSourceIsNamed) {
  std::vector<Object> bad(5, car("stereo", 20.0, 0.0));
  bad[0].position_covariance.setZero();
  bad[1].position_covariance << 1.0, 2.0, 2.0, 1.0;
  bad[2].position_covariance(0, 1) = kNan;
  bad[3].box.center = {kNan, 0.0, 0.0};
  bad[4].side_variance[0] = -1.0;
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const double t = 100.0 + 0.1 * static_cast<double>(i);
    handle("lidar", t);
    handle("stereo", list(t, {bad[i], car("stereo", 20.0, 0.0)}));
    const auto fused = nextAt(t);
    ASSERT_TRUE(fused);
    EXPECT_EQ(sensorsOf(*fused), (std::vector<Sensors>{{"lidar", "stereo"}})) << i;
    EXPECT_EQ(warnings("bad_object"), i + 1U);
    EXPECT_NE(monitor_.lastError().find("1 objects of stereo"), std::string::npos);
  }
  EXPECT_EQ(figure("bad objects"), 5.0);
}

TEST_F(ObjectFusionStageTest, BadViewsAreLeftOutAndReported) {
  ObjectArray objects = list(100.0, {car("stereo", 20.0, 0.0)});
  objects.views.resize(2);
  objects.views[0].min_bearing = -30.0F;  // degrees
  objects.views[0].max_bearing = 30.0F;
  objects.views[1].min_bearing = -0.5F;
  objects.views[1].max_bearing = 0.5F;
  handle("lidar", 100.0);
  handle("stereo", objects);
  const auto fused = nextAt(100.0);
  ASSERT_TRUE(fused);
  EXPECT_EQ(warnings("bad_view"), 1U);
  EXPECT_NE(monitor_.lastError().find("1 bad views of stereo"), std::string::npos);
  ASSERT_EQ(fused->views.size(), 1U);
  EXPECT_EQ(fused->views[0].sensor, "stereo") << "as of objects that do not tell it";
}

TEST_F(ObjectFusionStageTest, OfAThousandObjectsTheFarthestAreLeftOut) {
  std::vector<Object> many;
  for (int i = 0; i < 1000; ++i) {
    many.push_back(car("stereo", 20.0 + 5.0 * (i % 100), 15.0 + 5.0 * (i / 100)));
  }
  handle("lidar", 100.0);
  handle("stereo", list(100.0, many));
  const auto fused = nextAt(100.0);
  ASSERT_TRUE(fused);
  const auto max = static_cast<std::size_t>(options_.fuser.max_objects);
  EXPECT_EQ(fused->objects.size(), max + 1);
  EXPECT_EQ(warnings("many_objects"), 1U);
  EXPECT_NE(monitor_.lastError().find("stereo"), std::string::npos);
  EXPECT_TRUE(bothAt(100.1));
  EXPECT_EQ(warnings("many_objects"), 1U);
}

TEST_F(ObjectFusionStageTest, ObjectsWithoutSensorAreTheSources) {
  Object object = car("stereo", 20.0, 0.0);
  object.sensors.clear();
  handle("stereo", list(100.0, {object}));
  handle("lidar", 100.0);
  EXPECT_EQ(sensorsOf(*nextAt(100.0)), (std::vector<Sensors>{{"lidar", "stereo"}}));
}

TEST_F(ObjectFusionStageTest, AJumpBackStartsOver) {
  EXPECT_TRUE(bothAt(200.0));
  EXPECT_TRUE(bothAt(100.0));
  EXPECT_EQ(warnings("clock_restart"), 1U) << "the other source is part of the same restart";
  stage_.handleOdometry(odometry(200.0));
  stage_.handleOdometry(odometry(100.1));
  EXPECT_EQ(warnings("clock_restart"), 2U);
  EXPECT_TRUE(bothAt(99.9));
  EXPECT_EQ(monitor_.droppedCount(), 0U);
}

/// Beams one degree apart, the middle one straight ahead; all beams toward the car end there on
/// what is in the map.
LabeledScanMessage wallAt(double ahead, double seconds) {
  LabeledScan scan;
  scan.stamp = Stamp::fromSeconds(seconds);
  scan.field.beams = 181;
  scan.field.first_bearing = -kPi / 2.0;
  scan.field.beam_spacing = kPi / 180.0;
  scan.field.free_range = 80.0;
  scan.field.range = 80.0;
  for (std::uint32_t beam = 80; beam <= 100; ++beam) {
    const double bearing = scan.field.first_bearing + beam * scan.field.beam_spacing;
    const double range = ahead / std::cos(bearing);
    scan.points.push_back(
        {{ahead, range * std::sin(bearing)}, range, bearing, beam, PointState::kStatic});
  }
  return toMessage(scan, "base_link", "map");
}

class ObjectFusionScanSupportTest : public ObjectFusionStageTest {
 protected:
  /// State of the object that stereo sees and the scanner does not list.
  std::uint8_t stateAt(double seconds) {
    handle("lidar", list(seconds, {}));
    handle("stereo", seconds, 20.0);
    const auto fused = nextAt(seconds);
    return fused && fused->objects.size() == 1 ? fused->objects[0].dynamic_state : 255;
  }
};

TEST_F(ObjectFusionScanSupportTest, TheScanOfTheSameStampShowsWhatIsStatic) {
  EXPECT_EQ(stateAt(100.0), ObjectMessage::STATE_UNKNOWN) << "no scan";
  stage_.handleLabeledScan(wallAt(18.0, 100.1));
  EXPECT_EQ(stateAt(100.1), ObjectMessage::STATE_STATIC);
  EXPECT_EQ(stateAt(100.2), ObjectMessage::STATE_UNKNOWN) << "the scan is of another time";
  EXPECT_EQ(figure("fused without a labeled scan"), 2.0);
}

TEST_F(ObjectFusionScanSupportTest, AScanMayArriveBeforeOthers) {
  for (int i = 0; i < 40; ++i) {
    stage_.handleLabeledScan(wallAt(18.0, 100.0 + 0.02 * i));
  }
  EXPECT_EQ(stateAt(100.0), ObjectMessage::STATE_STATIC);
}

TEST_F(ObjectFusionScanSupportTest, BadScansAreDroppedAndCounted) {
  LabeledScanMessage scan = wallAt(18.0, 100.0);
  scan.points[0].x = std::numeric_limits<float>::infinity();
  stage_.handleLabeledScan(scan);
  EXPECT_EQ(drops("bad_point"), 1U);
  scan = wallAt(18.0, 100.0);
  scan.header.frame_id = "scanner";
  stage_.handleLabeledScan(scan);
  EXPECT_EQ(drops("wrong_frame"), 1U);
  EXPECT_EQ(stateAt(100.0), ObjectMessage::STATE_UNKNOWN);
}

TEST_F(ObjectFusionScanSupportTest, AJumpBackForgetsTheScans) {
  EXPECT_TRUE(bothAt(199.0));
  stage_.handleLabeledScan(wallAt(18.0, 200.0));
  EXPECT_TRUE(bothAt(100.0));
  EXPECT_EQ(warnings("clock_restart"), 1U);
  EXPECT_EQ(stateAt(200.0), ObjectMessage::STATE_UNKNOWN);
}

TEST_F(ObjectFusionScanSupportTest, AScanOfANewRunIsNotLostBehindThoseOfTheOldOne) {
  stage_.handleLabeledScan(wallAt(18.0, 200.0));
  stage_.handleLabeledScan(wallAt(18.0, 100.0));
  EXPECT_EQ(stateAt(100.0), ObjectMessage::STATE_STATIC);
}

}  // namespace
}  // namespace datmo::object_fusion_input_test
