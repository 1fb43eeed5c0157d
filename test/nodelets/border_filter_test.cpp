// SPDX-License-Identifier: BSD-3-Clause
// The running moving_objects nodelet with road borders, between a scripted grid_slam and a scripted
// road_border: what it filters out, and that everything passes if the borders are invalid. The
// tests run through one drive, in this order.
#include <limits>
#include <string>
#include <vector>

#include "labeled_scan_harness.h"
#include "ros/road_samples.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/road_conversion.h"

namespace datmo::border_filter_test {
namespace {

class BorderFilterHarness : public LabeledScanHarness {
 public:
  BorderFilterHarness() : LabeledScanHarness("moving_objects") {}

  bool waitForNodelet() {
    return LabeledScanHarness::waitForNodelet() && waitFor([this] {
             return road_borders_.getNumSubscribers() >= 1 && dropped_.getNumPublishers() >= 1;
           });
  }

  /// Waits until the nodelet has received it.
  bool sendRoad(const RoadBorders& road) {
    const double before = diagnostic("road_borders received");
    road_borders_.publish(road);
    return waitFor([&] { return diagnostic("road_borders received") > before; });
  }

  std::vector<DroppedObjectsConstPtr> dropped;

 private:
  ros::Publisher road_borders_ = node_.advertise<RoadBorders>("road_borders", kQueue);
  ros::Subscriber dropped_ = node_.subscribe<DroppedObjects>(
      "objects/dropped", kQueue,
      [this](const DroppedObjectsConstPtr& list) { dropped.push_back(list); });
};

class BorderFilterTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    harness_ = new BorderFilterHarness();
    ASSERT_TRUE(harness_->waitForNodelet());
  }

  static void TearDownTestSuite() { delete harness_; }

  static RoadBorders roadNow(const std::string& frame = "map") {
    RoadModel road = samples::straightRoad();
    road.stamp = Stamp::fromSeconds(samples::kStart + now_);
    return toMessage(road, frame);
  }

  /// Sends what seems to move on the left border, and returns the result: one list of each kind.
  static void scan() {
    const std::size_t before = harness_->objects.size();
    harness_->setClock(now_);
    harness_->send(samples::scanWithMover({10.0, 3.1}, now_));
    ASSERT_TRUE(harness_->waitFor([&] {
      return harness_->objects.size() == before + 1 && harness_->dropped.size() == before + 1;
    })) << harness_->diagnosticMessage();
    EXPECT_EQ(harness_->objects.back()->header.stamp, harness_->dropped.back()->header.stamp);
  }

  static std::size_t passed() { return harness_->objects.back()->objects.size(); }
  static std::size_t dropped() { return harness_->dropped.back()->objects.size(); }

  static BorderFilterHarness* harness_;
  static double now_;  // s, of the drive
};

BorderFilterHarness* BorderFilterTest::harness_ = nullptr;
double BorderFilterTest::now_ = 0.0;

TEST_F(BorderFilterTest, WithoutBordersAllObjectsPass) {
  ASSERT_NO_FATAL_FAILURE(scan());
  EXPECT_EQ(passed(), 1U);
  EXPECT_EQ(dropped(), 0U);
  EXPECT_TRUE(harness_->waitForCount("warned: no_borders", 1.0));
  EXPECT_TRUE(harness_->waitForMessage("no road_borders yet")) << harness_->diagnosticMessage();
}

TEST_F(BorderFilterTest, ByTheThesisAnObjectOnTheBorderIsDroppedAndReported) {
  now_ += 0.06;
  ASSERT_TRUE(harness_->sendRoad(roadNow()));
  ASSERT_NO_FATAL_FAILURE(scan());
  EXPECT_EQ(passed(), 0U);
  ASSERT_EQ(dropped(), 1U);
  EXPECT_EQ(harness_->dropped.back()->header.frame_id, "base_link");
  const DroppedObjectMessage& one = harness_->dropped.back()->objects[0];
  EXPECT_EQ(one.reason, DroppedObjectMessage::ON_BORDER);
  EXPECT_EQ(one.side, RoadBorderMessage::LEFT);
  EXPECT_NEAR(one.object.pose.position.x, 10.0, 1.0);
}

TEST_F(BorderFilterTest, InvalidBordersAreCountedAndTheLastOnesAreKept) {
  now_ += 0.06;
  RoadBorders bad = roadNow();
  bad.borders.at(0).points.at(0).x = std::numeric_limits<float>::quiet_NaN();
  ASSERT_TRUE(harness_->sendRoad(bad));
  EXPECT_TRUE(harness_->waitForCount("dropped: bad_border", 1.0));
  ASSERT_NO_FATAL_FAILURE(scan());
  EXPECT_EQ(passed(), 0U);
}

TEST_F(BorderFilterTest, StaleBordersDropNothingAndItIsReported) {
  now_ += 3.0;
  ASSERT_NO_FATAL_FAILURE(scan());
  EXPECT_EQ(passed(), 1U);
  EXPECT_EQ(dropped(), 0U);
  EXPECT_TRUE(harness_->waitForCount("warned: old_borders", 1.0));
  EXPECT_TRUE(harness_->waitForMessage("no road_borders for")) << harness_->diagnosticMessage();
}

TEST_F(BorderFilterTest, BordersInAnotherFrameDropNothingAndItIsReported) {
  now_ += 0.06;
  ASSERT_TRUE(harness_->sendRoad(roadNow("odom")));
  ASSERT_NO_FATAL_FAILURE(scan());
  EXPECT_EQ(passed(), 1U);
  EXPECT_TRUE(harness_->waitForCount("warned: wrong_frame", 1.0));
}

TEST_F(BorderFilterTest, ALoopedBag) {
  now_ = 0.0;
  harness_->setClock(now_);
  ASSERT_TRUE(harness_->sendRoad(roadNow()));
  ASSERT_NO_FATAL_FAILURE(scan());
  EXPECT_EQ(passed(), 0U);
  EXPECT_EQ(dropped(), 1U);
}

}  // namespace
}  // namespace datmo::border_filter_test
