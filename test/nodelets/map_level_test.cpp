// SPDX-License-Identifier: BSD-3-Clause
// Scanner and stereo camera, each with its own map, on a simulated drive: the output, and what
// remains while the camera is silent. The tests run through one drive, in this order.
#include <algorithm>

#include "stereo_drive.h"
#include <gtest/gtest.h>

#include "datmo_fusion/ros/convert/grid_conversion.h"

namespace datmo::map_level_test {
namespace {

constexpr std::uint32_t kQueue = 1000;

class MapLevel : public StereoChain {
 public:
  static constexpr char kFusion[] = "map_fusion";

  MapLevel() {
    for (const std::string name : {"fused", "conflicts"}) {
      subscribers_.push_back(node_.subscribe<nav_msgs::OccupancyGrid>(
          "map/" + name, kQueue, [this, name](const nav_msgs::OccupancyGridConstPtr& map) {
            levels[name].push_back(map);
          }));
    }
  }

  bool waitForNodelets() {
    return StereoChain::waitForNodelets({"lidar_grid", "stereo_grid", "map_fusion", "tracker"}) &&
           waitFor([this] {
             return std::all_of(subscribers_.begin(), subscribers_.end(),
                                [](const auto& map) { return map.getNumPublishers() >= 1; });
           });
  }

  /// Maps are published once a second: each step waits for the pose.
  bool isFusedAt(const ros::Time& stamp) {
    return !labeled_scans.empty() && labeled_scans.back()->header.stamp == stamp;
  }

  std::map<std::string, std::vector<nav_msgs::OccupancyGridConstPtr>> levels;  ///< by name

 private:
  ros::NodeHandle node_;
  std::vector<ros::Subscriber> subscribers_;
};

class MapLevelTest : public StereoDriveTest<MapLevel> {
 protected:
  /// Waits until this many maps have arrived.
  static bool waitForMaps(std::size_t maps) {
    return chain_->waitFor([&] {
      return chain_->levels["fused"].size() >= maps && chain_->levels["conflicts"].size() >= maps;
    });
  }

  static long occupiedCells(const nav_msgs::OccupancyGrid& map) {
    return std::count_if(map.data.begin(), map.data.end(), isOccupied);
  }
};

TEST_F(MapLevelTest, BothSensorsLeadToOneMap) {
  chain_->sendCameraInfo();
  chain_->mountSensors();
  ASSERT_NO_FATAL_FAILURE(start());
  ASSERT_NO_FATAL_FAILURE(driveOn(3.0));
  ASSERT_TRUE(waitForMaps(2)) << chain_->diagnosticMessage("map_fusion");
  const auto& map = *chain_->levels["fused"].back();
  EXPECT_EQ(map.header.frame_id, "map");
  const SensorGrid cells = fromMessage(map);
  const Point2 vehicle = world_.baseInMap(map.header.stamp.toSec() - World::kStart).position() -
                         world_.baseInMap(0.0).position();
  EXPECT_TRUE(isFree(cells.atOrUnknown(cells.window().cellAt(vehicle + Point2(8.0, 0.0)))));
  EXPECT_GT(occupiedCells(map), 50);
  EXPECT_EQ(chain_->levels["conflicts"].back()->header.frame_id, "map");
  EXPECT_EQ(chain_->diagnostic("map_fusion", "dropped"), 0.0);
  EXPECT_TRUE(chain_->diagnosticMessage("grid_fusion").empty()) << "it is not needed";
}

TEST_F(MapLevelTest, WhileTheCameraIsSilentItsMapIsStillThere) {
  const std::size_t before = chain_->levels["fused"].size();
  for (int i = 0; i < 32; ++i) {
    ASSERT_NO_FATAL_FAILURE(stepWithoutStereo());
  }
  ASSERT_TRUE(waitForMaps(before + 1));
  EXPECT_GT(occupiedCells(*chain_->levels["fused"].back()), 50);
  EXPECT_TRUE(chain_->waitFor(
      [] { return chain_->diagnostic("map_fusion", "fused without stereo") > 0.0; }));
}

}  // namespace
}  // namespace datmo::map_level_test
