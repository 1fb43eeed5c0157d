// SPDX-License-Identifier: BSD-3-Clause
// Scanner and stereo camera, fused at the low level, on a simulated drive: the output, and what
// happens if one of them is silent or sends invalid messages. The tests run through one drive, in
// this order.
#include <algorithm>
#include <functional>
#include <limits>

#include "stereo_drive.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/grid_conversion.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/parameters.h"
#include "datmo_fusion/ros/stage/grid_fusion_stage.h"

namespace datmo::low_level_test {
namespace {

constexpr std::uint32_t kQueue = 1000;

/// Echoes from a painted line on the road, where no object is (m ahead of the scanner).
constexpr float kPaintAhead = 6.1F;

/// The low level's output from both sensors.
class LowLevel : public StereoChain {
 public:
  static constexpr char kFusion[] = "grid_fusion";

  LowLevel() {
    for (const std::string name : {"lidar", "stereo", "fused", "conflict"}) {
      subscribers_.push_back(node_.subscribe<nav_msgs::OccupancyGrid>(
          "grids/" + name, kQueue, [this, name](const nav_msgs::OccupancyGridConstPtr& grid) {
            grids[name].push_back(grid);
          }));
    }
  }

  /// Waits until all nodelets are subscribed and report.
  bool waitForNodelets() {
    return StereoChain::waitForNodelets({"lidar_grid", "stereo_grid", "grid_fusion", "tracker"}) &&
           waitFor([this] {
             return std::all_of(subscribers_.begin(), subscribers_.end(),
                                [](const auto& grid) { return grid.getNumPublishers() >= 1; }) &&
                    stereo_grid_.getNumSubscribers() >= 2;  // this test and grid_fusion
           });
  }

  void sendStereoGrid(const nav_msgs::OccupancyGrid& grid) { stereo_grid_.publish(grid); }

  /// Returns whether the newest grid of a name has this stamp.
  bool isAt(const std::string& name, const ros::Time& stamp) {
    return !grids[name].empty() && grids[name].back()->header.stamp == stamp;
  }

  bool isFusedAt(const ros::Time& stamp) { return isAt("fused", stamp); }

  std::map<std::string, std::vector<nav_msgs::OccupancyGridConstPtr>> grids;  ///< by name

 private:
  ros::NodeHandle node_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Publisher stereo_grid_ = node_.advertise<nav_msgs::OccupancyGrid>("grids/stereo", kQueue);
};

/// With paint on the road ahead.
sensor_msgs::LaserScan painted(sensor_msgs::LaserScan scan) {
  const std::size_t ahead = scan.ranges.size() / 2;
  std::fill(scan.ranges.begin() + static_cast<std::ptrdiff_t>(ahead - 2),
            scan.ranges.begin() + static_cast<std::ptrdiff_t>(ahead + 3), kPaintAhead);
  return scan;
}

Percent percentAt(const nav_msgs::OccupancyGrid& message, const Point2& position) {
  const SensorGrid grid = fromMessage(message);
  return grid.atOrUnknown(grid.window().cellAt(position));
}

/// Returns whether a cell with its center in the box (vehicle's frame), or 0.3 m from it, is
/// occupied.
bool isOccupiedAt(const nav_msgs::OccupancyGrid& message, const Box2& box) {
  constexpr double kNear = 0.3;  // m, a cell
  const SensorGrid grid = fromMessage(message);
  bool found = false;
  grid.forEach([&](CellIndex cell, Percent percent) {
    found = found || (isOccupied(percent) && box.distanceTo(grid.window().centerOf(cell)) < kNear);
  });
  return found;
}

class LowLevelTest : public StereoDriveTest<LowLevel> {
 protected:
  /// Runs one step of the drive with both sensors, while there is paint on the road.
  void stepOnPaint() { step(painted(world_.scan(now_))); }

  /// Runs a step with the scanner alone; waits for its grid.
  void stepToLidarsGrid() {
    chain_->sendMotion(now_);
    const auto scan = world_.scan(now_);
    chain_->sendScan(scan);
    ASSERT_TRUE(chain_->waitFor([&] { return chain_->isAt("lidar", scan.header.stamp); }));
    now_ += kStep;
  }

  /// Sends the world's current cloud after `spoil`; expects that stereo_grid counts it under `key`.
  void expectCounted(const std::string& key,
                     const std::function<void(sensor_msgs::PointCloud2&)>& spoil) {
    const double before = chain_->diagnostic("stereo_grid", key);
    auto cloud = world_.cloud(now_);
    spoil(cloud);
    chain_->sendMotion(now_);
    chain_->sendCloud(cloud);
    EXPECT_TRUE(chain_->waitFor([&] { return chain_->diagnostic("stereo_grid", key) > before; }))
        << key;
    now_ += kStep;
  }

  /// Positions in the vehicle's frame, m.
  static Point2 paint() { return {3.6 + kPaintAhead, 0.1}; }
  static Point2 behindTheVehicle() { return {-10.0, -11.0}; }

  static std::string askForRule(const std::string& rule) {
    return askForChoice("grid_fusion", "rule", rule);
  }
};

TEST_F(LowLevelTest, CloudsBeforeTheirMountIsKnownAreCounted) {
  chain_->sendCameraInfo();
  expectCounted("dropped: missing_transform", [](auto&) {});
  chain_->mountSensors();
  now_ += kStep;
  ASSERT_NO_FATAL_FAILURE(start());
}

TEST_F(LowLevelTest, BothSensorsLeadToAFusedGridForEachScan) {
  ASSERT_NO_FATAL_FAILURE(driveOn(2.0));
  EXPECT_TRUE(chain_->waitFor([] {
    return chain_->grids["fused"].size() == chain_->grids["lidar"].size();
  })) << "each of its own connection";
  EXPECT_TRUE(chain_->waitFor(
      [] { return chain_->grids["conflict"].size() == chain_->grids["fused"].size(); }));
  const auto& fused = *chain_->grids["fused"].back();
  EXPECT_EQ(fused.header.frame_id, "base_link");
  const double then = fused.header.stamp.toSec() - World::kStart;
  Box2 car = world_.otherCar(then);
  car.center = world_.baseInMap(then).inverse() * car.center;
  EXPECT_TRUE(isOccupiedAt(fused, car));
  EXPECT_TRUE(isFree(percentAt(fused, {8.0, 0.0}))) << "the road before it";
  EXPECT_EQ(chain_->diagnostic("grid_fusion", "dropped"), 0.0);
  EXPECT_EQ(chain_->diagnostic("lidar_grid", "dropped"), 0.0);
}

TEST_F(LowLevelTest, TheFusedGridLeadsToTracks) {
  ASSERT_NO_FATAL_FAILURE(driveOn(1.5));
  const ros::Time last = chain_->grids["fused"].back()->header.stamp;
  ASSERT_TRUE(chain_->waitFor([&] {
    return !chain_->tracks.empty() && chain_->tracks.back()->header.stamp == last;
  })) << chain_->diagnosticMessage("grid_slam")
      << chain_->diagnosticMessage("tracker");
  const TrackMessage* car = chain_->otherCarIn(*chain_->tracks.back());
  ASSERT_TRUE(car) << chain_->tracks.back()->tracks.size() << " tracks, none there";
  EXPECT_TRUE(car->moving);
}

TEST_F(LowLevelTest, TheRuleChangesWhileItRuns) {
  EXPECT_EQ(askForRule("maximum"), "maximum");
  ASSERT_NO_FATAL_FAILURE(stepOnPaint());
  EXPECT_TRUE(isOccupied(percentAt(*chain_->grids["fused"].back(), paint())));
  EXPECT_EQ(askForRule("priority"), "priority");
  ASSERT_NO_FATAL_FAILURE(stepOnPaint());
  EXPECT_TRUE(isFree(percentAt(*chain_->grids["fused"].back(), paint())))
      << "stereo sees that there is nothing";
  EXPECT_EQ(askForRule("by luck"), "priority") << "it stays";
}

TEST_F(LowLevelTest, TheParameterServerHasTheNodeletsParameters) {
  EXPECT_NO_THROW(loadOptions<GridFusionStageOptions>(ros::NodeHandle("/grid_fusion")));
  EXPECT_EQ(ros::param::param<std::string>("/grid_fusion/rule", ""), "priority");
}

TEST_F(LowLevelTest, ConflictIsWhereTheSensorsContradictEachOther) {
  askForRule("dempster_shafer");
  ASSERT_NO_FATAL_FAILURE(stepOnPaint());
  const ros::Time stamp = chain_->grids["fused"].back()->header.stamp;
  ASSERT_TRUE(chain_->waitFor([&] { return chain_->isAt("conflict", stamp); }));
  const auto& conflict = *chain_->grids["conflict"].back();
  EXPECT_GT(percentAt(conflict, paint()), 20);
  EXPECT_LT(percentAt(conflict, {8.0, 0.0}), 20) << "both say free";
  EXPECT_EQ(percentAt(conflict, behindTheVehicle()), kUnknownPercent) << "one alone says nothing";
}

TEST_F(LowLevelTest, WithoutStereoTheFusedGridsContinueWithTheScanner) {
  for (int i = 0; i < 20; ++i) {
    ASSERT_NO_FATAL_FAILURE(stepToLidarsGrid());
  }
  const ros::Time last = chain_->grids["lidar"].back()->header.stamp;
  EXPECT_TRUE(chain_->waitFor([&] { return chain_->isAt("fused", last); }))
      << "at once, since stereo is silent";
  EXPECT_TRUE(chain_->waitFor([] {
    return chain_->grids["fused"].size() == chain_->grids["lidar"].size();
  })) << "none is left out";
  EXPECT_TRUE(chain_->waitFor(
      [] { return chain_->diagnostic("grid_fusion", "warned: silent_source") >= 1.0; }));
  EXPECT_TRUE(chain_->waitFor(
      [] { return chain_->diagnostic("grid_fusion", "fused without stereo") > 5.0; }));
  EXPECT_TRUE(chain_->waitFor([] {
    return chain_->diagnosticMessage("grid_fusion").find("no grids/stereo") != std::string::npos;
  })) << chain_->diagnosticMessage("grid_fusion");
  ASSERT_NO_FATAL_FAILURE(driveOn(0.5));
}

TEST_F(LowLevelTest, BadCloudsAreCounted) {
  expectCounted("dropped: empty_cloud", [](auto& cloud) { cloud.width = 0; });
  expectCounted("dropped: no_valid_point",
                [](auto& cloud) { std::fill(cloud.data.begin(), cloud.data.end(), 0xFF); });
  expectCounted("dropped: missing_transform",
                [](auto& cloud) { cloud.header.frame_id = "nowhere"; });
  expectCounted("dropped: missing_field", [](auto& cloud) { cloud.fields.pop_back(); });
  expectCounted("dropped: wrong_size", [](auto& cloud) { cloud.data.resize(7); });
  expectCounted("dropped: big_endian", [](auto& cloud) { cloud.is_bigendian = 1; });
  expectCounted("dropped: zero_stamp", [](auto& cloud) { cloud.header.stamp = ros::Time(); });
  expectCounted("dropped: old_stamp", [](auto& cloud) {
    cloud.header.stamp = chain_->grids["stereo"].back()->header.stamp - ros::Duration(0.5);
  });
  ASSERT_NO_FATAL_FAILURE(driveOn(0.5));
}

TEST_F(LowLevelTest, GridsOfAnotherWindowAreRefusedWithBothSizes) {
  // After the last cloud, whose grid may not have arrived at this test yet.
  SensorGrid other(Stamp::fromSeconds(World::kStart + now_ - 0.5 * kStep),
                   {0.5, 100, 100, {-50, -50}});
  chain_->sendStereoGrid(toMessage(other, "base_link"));
  ASSERT_TRUE(chain_->waitFor(
      [] { return chain_->diagnostic("grid_fusion", "dropped: wrong_window") == 1.0; }));
  ASSERT_NO_FATAL_FAILURE(driveOn(0.5));
  EXPECT_GT(chain_->diagnostic("grid_fusion", "processed"), 50.0);
}

TEST_F(LowLevelTest, ALoopedBag) {
  now_ = 0.0;
  ASSERT_NO_FATAL_FAILURE(start());
  ASSERT_NO_FATAL_FAILURE(driveOn(1.0));
  EXPECT_TRUE(chain_->waitFor(
      [] { return chain_->diagnostic("grid_fusion", "warned: clock_restart") > 0.0; }));
}

}  // namespace
}  // namespace datmo::low_level_test
