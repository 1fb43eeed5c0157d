// SPDX-License-Identifier: BSD-3-Clause
// Fields of view as fans of beams: from a visibility, into another frame, and back.
#include "datmo_fusion/common/view_fan.h"

#include <vector>

#include "tracking/tracking_scene.h"
#include <gtest/gtest.h>

#include "datmo_fusion/visibility/visibility.h"

namespace datmo::view_fan_test {
namespace {

const VisibilityOptions kOptions;

/// 181 beams ahead, some of them blind, some ending at a wall, from a scanner in front.
Visibility scanner() {
  LabeledScan scan;
  scan.scanner_in_base = Pose2(3.0, 0.5, 0.2);
  scan.field = {degrees(-90.0), degrees(1.0), 181, 0.5, 40.0, 80.0};
  scan.blind_beams = {30, 31, 32, 33, 34, 35};
  for (std::uint32_t beam = 60; beam < 90; ++beam) {
    scan.points.push_back({Point2::Zero(), 15.0, 0.0, beam, PointState::kStatic});
  }
  return {scan, kOptions};
}

/// A camera facing left, with an obstacle in front of it.
Visibility camera() {
  const FieldOfView field{Pose2(1.0, 0.0, 1.0), degrees(-40.0), degrees(40.0), 20.0, 60.0};
  return {field, {{{8.0, 8.0, 0.3}, 3.0, 2.0}}, kOptions};
}

Visibility both() {
  Visibility joint = scanner();
  joint.join(camera());
  return joint;
}

/// All around, near and far.
std::vector<Box2> positions() {
  std::vector<Box2> boxes;
  for (double x = -20.0; x <= 80.0; x += 4.7) {
    for (double y = -30.0; y <= 40.0; y += 5.3) {
      boxes.push_back({{x, y, 0.1 * x}, 3.0, 1.5});
    }
  }
  return boxes;
}

TEST(ViewFan, AVisibilityOfItsFansIsTheSame) {
  for (const Visibility& original : {scanner(), camera(), both()}) {
    const Visibility again(original.fans(), kOptions);
    for (const Box2& box : positions()) {
      EXPECT_EQ(again.detectionProbability(box, 0.5), original.detectionProbability(box, 0.5));
    }
  }
}

TEST(ViewFan, OneOfEachSensorWhoseViewIsKnown) {
  EXPECT_EQ(both().fans().size(), 2U);
  EXPECT_TRUE(both().fans()[0].by_beams);
  EXPECT_FALSE(both().fans()[1].by_beams);
  EXPECT_TRUE(Visibility(kOptions).fans().empty());
  Visibility joint(kOptions);
  joint.join(scanner());
  EXPECT_EQ(joint.fans().size(), 1U);
}

TEST(ViewFan, ReportsTheScansBeams) {
  const ViewFan fan = scanner().fans().at(0);
  EXPECT_EQ(fan.sensor.x(), 3.0);
  EXPECT_EQ(fan.first_bearing, degrees(-90.0));
  EXPECT_EQ(fan.beam_spacing, degrees(1.0));
  EXPECT_EQ(fan.min_range, 0.5);
  EXPECT_EQ(fan.sure_range, 40.0);
  EXPECT_EQ(fan.range, 80.0);
  ASSERT_EQ(fan.reach.size(), 181U);
  EXPECT_EQ(fan.reach[0], 80.0) << "no return";
  EXPECT_EQ(fan.reach[30], 0.0) << "blind";
  EXPECT_EQ(fan.reach[60], 15.0) << "a wall";
}

TEST(ViewFan, WithoutFansItIsUnknown) {
  const Box2 box{{20.0, 0.0, 0.0}, 4.0, 2.0};
  const std::vector<ViewFan> none;
  EXPECT_EQ(Visibility(none, kOptions).detectionProbability(box, 0.0),
            kOptions.unknown_probability);
  std::vector<ViewFan> fans = {ViewFan()};
  EXPECT_EQ(Visibility(fans, kOptions).detectionProbability(box, 0.0), kOptions.unknown_probability)
      << "without beams";
  fans.push_back(scanner().fans()[0]);
  fans.emplace_back();
  EXPECT_EQ(Visibility(fans, kOptions).detectionProbability(box, 0.0),
            scanner().detectionProbability(box, 0.0))
      << "those without beams tell nothing";
}

TEST(ViewFan, InAnotherFrameItSeesTheSame) {
  const Pose2 base_in_fixed(100.0, -50.0, 2.5);
  std::vector<ViewFan> fans = both().fans();
  for (ViewFan& fan : fans) {
    fan = transformed(base_in_fixed, fan);
  }
  const Visibility moved(fans, kOptions);
  for (const Box2& box : positions()) {
    const Box2 moved_box{base_in_fixed * box.center, box.length, box.width};
    EXPECT_NEAR(moved.detectionProbability(moved_box, 0.5), both().detectionProbability(box, 0.5),
                1e-6);
  }
}

TEST(ViewFan, TheTrackerPublishesThemInTheFixedFrame) {
  Tracker tracker{TrackerOptions()};
  const Pose2 base_in_fixed(10.0, 20.0, 0.5 * kPi);
  const TrackList list = tracker.process({Stamp::fromSeconds(1.0), {}, {}}, base_in_fixed, both());
  ASSERT_EQ(list.views.size(), 2U);
  EXPECT_NEAR(list.views[0].sensor.x(), 9.5, 1e-12) << "0.5 m to the left of the vehicle's axis";
  EXPECT_NEAR(list.views[0].sensor.y(), 23.0, 1e-12);
  EXPECT_NEAR(list.views[0].sensor.heading(), 0.5 * kPi + 0.2, 1e-12);
  EXPECT_EQ(list.views[0].reach, both().fans()[0].reach);
  EXPECT_NEAR(list.views[1].sensor.y(), 21.0, 1e-12);
  EXPECT_TRUE(tracker.process({Stamp::fromSeconds(1.1), {}, {}}, base_in_fixed).views.empty())
      << "nothing is known of the view";
}

}  // namespace
}  // namespace datmo::view_fan_test
