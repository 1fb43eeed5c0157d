// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/cloud_objects_stage.h"

#include "cloud_stage_sample.h"
#include "monitor_counts.h"
#include <gtest/gtest.h>

namespace datmo::cloud_objects_stage_test {
namespace {

using samples::kStart;

using CloudObjectsStageTest = samples::CloudStageTest<CloudObjectsStage>;

TEST_F(CloudObjectsStageTest, ACloudMakesObjectsOfTheVehiclesFrame) {
  mountLidar();
  const auto objects = stage_.handle(cloudAt(kStart));
  ASSERT_NE(objects, nullptr);
  EXPECT_EQ(objects->header.frame_id, "base_link");
  EXPECT_EQ(objects->header.stamp, ros::Time(kStart));
  ASSERT_EQ(objects->objects.size(), 1U);
  EXPECT_NEAR(objects->objects[0].pose.position.x, 10.5, 0.2);
  EXPECT_EQ(objects->objects[0].sensors, std::vector<std::string>{"cloud"});
  EXPECT_EQ(monitor_.processedCount(), 1U);
}

TEST_F(CloudObjectsStageTest, WithoutAMountACloudIsDropped) {
  EXPECT_EQ(stage_.handle(cloudAt(kStart)), nullptr);
  EXPECT_EQ(monitor_.drops().at("missing_transform"), 1U);
}

TEST_F(CloudObjectsStageTest, BadCloudsAreDroppedAndCounted) {
  mountLidar();
  auto without_height = cloudAt(kStart);
  without_height.fields[2].name = "height";
  EXPECT_EQ(stage_.handle(without_height), nullptr);
  EXPECT_EQ(stage_.handle(sensor_msgs::PointCloud2()), nullptr);
  EXPECT_EQ(monitor_.droppedCount(), 2U);
  EXPECT_NE(stage_.handle(cloudAt(kStart)), nullptr);
  EXPECT_EQ(stage_.handle(cloudAt(kStart)), nullptr) << "it was there already";
}

TEST_F(CloudObjectsStageTest, AClockJumpBackStartsOver) {
  mountLidar();
  EXPECT_NE(stage_.handle(cloudAt(kStart + 10.0)), nullptr);
  EXPECT_NE(stage_.handle(cloudAt(kStart)), nullptr);
  EXPECT_EQ(monitor_.warnings().at("clock_restart"), 1U);
}

}  // namespace
}  // namespace datmo::cloud_objects_stage_test
