// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/shared_options.h"

#include <sstream>

#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/option_table.h"
#include "datmo_fusion/ros/display/markers.h"
#include "datmo_fusion/ros/scanner_options.h"
#include "datmo_fusion/ros/stage/grid_slam_stage.h"
#include "datmo_fusion/ros/stage/lidar_grid_stage.h"
#include "datmo_fusion/ros/stage/loop_closing_stage.h"
#include "datmo_fusion/ros/stage/moving_objects_stage.h"
#include "datmo_fusion/ros/stage/risk_stage.h"
#include "datmo_fusion/ros/stage/road_border_stage.h"
#include "datmo_fusion/ros/stage/stereo_alignment_stage.h"
#include "datmo_fusion/ros/stage/stereo_grid_stage.h"
#include "datmo_fusion/ros/stage/stereo_objects_stage.h"
#include "datmo_fusion/ros/stage/tracker_stage.h"
#include "datmo_fusion/ros/vehicle_options.h"

namespace datmo::shared_options_test {
namespace {

/// Returns the message of the OptionError that `read` throws; empty if it throws none.
template <typename Read>
std::string errorOf(const Read& read) {
  try {
    read();
  } catch (const OptionError& error) {
    return error.what();
  }
  return "";
}

void expectMentions(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    EXPECT_NE(message.find(part), std::string::npos) << part << " not in: " << message;
  }
}

/// Reads the options from these sections.
SharedOptions sharedOf(const std::map<std::string, OptionValues>& sections) {
  return readSharedOptions([&sections](const std::string& name) {
    const auto found = sections.find(name);
    return found == sections.end() ? OptionValues() : found->second;
  });
}

TEST(SharedOptions, FramesAreSetOnceAndUsedByEachStage) {
  const SharedOptions shared =
      sharedOf({{"frames", {{"odom", std::string("/wheels")}, {"base", std::string("robot")}}}});
  const auto slam = readStageOptions<GridSlamStageOptions>({}, shared);
  EXPECT_EQ(slam.frames.odom, "wheels") << "without the slash";
  EXPECT_EQ(slam.frames.base, "robot");
  EXPECT_EQ(slam.frames.map, "map") << "the default";
  EXPECT_EQ(readStageOptions<TrackerStageOptions>({}, shared).frames.base, "robot");
}

TEST(SharedOptions, APrefixIsAddedToAllFrames) {
  const SharedOptions shared =
      sharedOf({{"frames", {{"prefix", std::string("/car1/")}}}, {"mounts", {{"laser/x", 2.0}}}});
  EXPECT_EQ(shared.frames.map, "car1/map");
  EXPECT_EQ(shared.frames.odom, "car1/odom");
  EXPECT_EQ(shared.frames.base, "car1/base_link");
  EXPECT_EQ(shared.frames.scanner, "car1/scanner");
  EXPECT_EQ(shared.frames.camera, "") << "the default: the cloud's";
  EXPECT_EQ(shared.mounts.at("car1/laser").x, 2.0);
}

TEST(SharedOptions, UnknownKeysAndBadFramesAreNamedWithTheirSection) {
  expectMentions(errorOf([] {
                   sharedOf({{"frames", {{"bse", std::string("robot")}}}});
                 }),
                 {"frames", "bse", "base"});
  expectMentions(errorOf([] {
                   sharedOf({{"frames", {{"base", std::string("odom")}}}});
                 }),
                 {"frames", "odom", "three different names"});
  expectMentions(errorOf([] {
                   sharedOf({{"frames", {{"map", std::string("")}}}});
                 }),
                 {"frames", "three different names"});
  expectMentions(errorOf([] {
                   sharedOf({{"motion", {{"source", std::string("gps")}}}});
                 }),
                 {"motion", "source", "gps", "imu_and_twist"});
}

TEST(SharedOptions, MovedKeysAreRefusedWithTheNewOne) {
  const auto errorOfKey = [](const std::string& key, const OptionValue& value) {
    return errorOf([&] { readStageOptions<GridSlamStageOptions>({{key, value}}, {}); });
  };
  expectMentions(errorOfKey("base_frame", std::string("robot")),
                 {"base_frame = 'robot'", "frames: {base: ...}"});
  expectMentions(errorOfKey("fixed_frame", std::string("odom")), {"frames: {map: ...}"});
  expectMentions(errorOfKey("odometry", false), {"motion: {source: "});
  expectMentions(errorOfKey("odometry_hold", 2.0), {"motion: {hold: ...}"});
}

TEST(SharedOptions, ScannerIsDeclaredOnce) {
  const SharedOptions shared = sharedOf({{"scanner",
                                          {{"free_range", 12.0},
                                           {"range_sigma", 0.03},
                                           {"end_margin", 2.0},
                                           {"beam_width", 0.01},
                                           {"max_tilt", 0.2}}}});
  const auto slam = readStageOptions<GridSlamStageOptions>({}, shared);
  const auto grid = readStageOptions<LidarGridStageOptions>({}, shared);
  EXPECT_EQ(slam.scan.free_range, 12.0);
  EXPECT_EQ(grid.scan.free_range, 12.0);
  EXPECT_EQ(slam.max_tilt, 0.2);
  EXPECT_EQ(grid.max_tilt, 0.2);
  EXPECT_EQ(grid.grid.beam_width, 0.01);
  EXPECT_EQ(slam.slam.matcher.point_sigma, 0.03);
  const auto loops = readStageOptions<LoopClosingStageOptions>({}, shared);
  for (const BeamEndOptions& beam_end :
       {slam.slam.map.beam_end, grid.grid.beam_end, loops.loops.submaps.map.beam_end}) {
    EXPECT_EQ(beam_end.range_sigma, 0.03);
    EXPECT_EQ(beam_end.end_margin, 2.0);
  }
  EXPECT_EQ(readStageOptions<MovingObjectsStageOptions>({}, shared).detector.range_sigma, 0.03);
}

TEST(SharedOptions, StereoCameraIsDeclaredOnce) {
  const SharedOptions shared = sharedOf({{"stereo_camera",
                                          {{"baseline", 0.4},
                                           {"min_depth", 0.7},
                                           {"effective_range", 20.0},
                                           {"time_of_flight/linear", 0.01},
                                           {"road/estimate", false}}},
                                         {"stereo_image_proc", {{"approximate_sync", true}}}});
  const auto grid = readStageOptions<StereoGridStageOptions>({}, shared);
  const auto objects = readStageOptions<StereoObjectsStageOptions>({}, shared);
  for (const StereoInputOptions& input : {StereoInputOptions(grid), StereoInputOptions(objects)}) {
    EXPECT_EQ(input.camera.baseline, 0.4);
    EXPECT_EQ(input.camera.min_depth, 0.7);
    EXPECT_EQ(input.camera.time_of_flight.linear, 0.01);
  }
  EXPECT_EQ(grid.grid.min_depth, 0.7);
  EXPECT_EQ(objects.detector.surfaces.min_depth, 0.7);
  EXPECT_EQ(grid.grid.effective_range, 20.0);
  EXPECT_EQ(objects.detector.effective_range, 20.0);
  EXPECT_FALSE(grid.grid.road.estimate);
  EXPECT_FALSE(objects.detector.road.estimate);
}

TEST(SharedOptions, VehicleIsDeclaredOnce) {
  const SharedOptions shared =
      sharedOf({{"vehicle", {{"length", 3.0}, {"own_points/front", 2.5}, {"height", 2.0}}}});
  EXPECT_EQ(readStageOptions<RiskStageOptions>({}, shared).risk.vehicle.length, 3.0);
  EXPECT_EQ(readStageOptions<MarkersOptions>({}, shared).vehicle.length, 3.0);
  EXPECT_EQ(readStageOptions<MarkersOptions>({}, shared).vehicle.height, 2.0);
}

TEST(SharedOptions, UnsetValuesAreLeftToTheStages) {
  const auto stages = [](const std::map<std::string, OptionValues>& sections) {
    const SharedOptions shared = sharedOf(sections);
    const auto slam = readStageOptions<GridSlamStageOptions>({}, shared);
    const auto grid = readStageOptions<StereoGridStageOptions>({}, shared);
    return std::vector<double>{slam.slam.matcher.point_sigma, grid.grid.min_depth};
  };
  const auto known = stages({});
  EXPECT_EQ(stages({{"scanner", {{"range_sigma", 0}}}, {"stereo_camera", {{"min_depth", 0.0}}}}),
            known);
  EXPECT_EQ(known, (std::vector<double>{0.2, 0.5})) << "as the sections' descriptions say";
}

/// Returns what a struct of options reports about each key as a line of a table.
template <typename Options>
std::map<std::string, std::string> defaultsOf() {
  std::map<std::string, std::string> defaults;
  std::istringstream table(optionTable<Options>());
  for (std::string line; std::getline(table, line);) {
    std::vector<std::string> cells;
    std::istringstream cell_text(line);
    for (std::string cell; std::getline(cell_text, cell, '|');) {
      cells.push_back(cell);
    }
    if (cells.size() > 3 && cells[1].size() > 4) {
      defaults[cells[1].substr(2, cells[1].size() - 4)] = cells[3];
    }
  }
  return defaults;
}

template <typename Options>
void expectSharedDefaults(
    const std::map<std::string, std::map<std::string, std::string>>& sections) {
  const auto own = defaultsOf<Options>();
  for (const SharedKey& key : sharedKeysOf<Options>()) {
    const std::size_t slash = key.shared.find('/');
    const std::string name = key.shared.substr(slash + 1);
    ASSERT_EQ(own.count(key.own), 1U) << key.own;
    const auto section = sections.find(key.shared.substr(0, slash));
    if (section == sections.end() || name == "range_sigma" || name == "min_depth") {
      continue;  // from another package; unknown unless it is given
    }
    ASSERT_EQ(section->second.count(name), 1U) << key.shared;
    EXPECT_EQ(own.at(key.own), section->second.at(name)) << key.own << ", " << key.shared;
  }
}

TEST(SharedOptions, DefaultsAreThoseOfTheStages) {
  const std::map<std::string, std::map<std::string, std::string>> sections{
      {"scanner", defaultsOf<ScannerOptions>()},
      {"stereo_camera", defaultsOf<StereoSceneOptions>()},
      {"vehicle", defaultsOf<VehicleOptions>()}};
  expectSharedDefaults<LidarGridStageOptions>(sections);
  expectSharedDefaults<GridSlamStageOptions>(sections);
  expectSharedDefaults<LoopClosingStageOptions>(sections);
  expectSharedDefaults<MovingObjectsStageOptions>(sections);
  expectSharedDefaults<RoadBorderStageOptions>(sections);
  expectSharedDefaults<StereoAlignmentStageOptions>(sections);
  expectSharedDefaults<StereoGridStageOptions>(sections);
  expectSharedDefaults<StereoObjectsStageOptions>(sections);
  expectSharedDefaults<RiskStageOptions>(sections);
  expectSharedDefaults<MarkersOptions>(sections);
}

TEST(SharedOptions, KeysOfSensorsInAStagesSectionAreRefusedWithTheNewOne) {
  expectMentions(
      errorOf([] {
        readStageOptions<GridSlamStageOptions>({{"matcher/point_sigma", 0.05}}, {});
      }),
      {"matcher/point_sigma = 0.05", "once for all stages", "scanner: {range_sigma: ...}"});
  expectMentions(errorOf([] {
                   readStageOptions<StereoGridStageOptions>({{"road/estimate", false}}, {});
                 }),
                 {"road/estimate = false", "stereo_camera: {road: {estimate: ...}}"});
  expectMentions(errorOf([] {
                   sharedOf({{"scanner", {{"free_rang", 3.0}}}});
                 }),
                 {"scanner", "free_rang", "free_range"});
}

TEST(Mounts, AreReadByFrame) {
  const Mounts mounts = readMounts({{"laser/x", 1.0},
                                    {"laser/yaw", 0.5},
                                    {"robot1/imu/roll", kPi},
                                    {"/camera/z", 1},
                                    {"/camera/pitch", -0.1}});
  ASSERT_EQ(mounts.size(), 3U);
  EXPECT_EQ(mounts.at("laser").x, 1.0);
  EXPECT_EQ(mounts.at("laser").yaw, 0.5);
  EXPECT_EQ(mounts.at("robot1/imu").roll, kPi) << "a frame with a slash in its name";
  EXPECT_EQ(mounts.at("camera").z, 1.0) << "one with a slash at its front";
}

TEST(Mounts, BadOnesAreNamed) {
  expectMentions(errorOf([] { readMounts({{"laser/hight", 1.0}}); }), {"laser", "hight"});
  expectMentions(errorOf([] { readMounts({{"laser/yaw", 90.0}}); }), {"laser", "yaw", "90", "rad"});
  expectMentions(errorOf([] { readMounts({{"laser/x", std::nan("")}}); }), {"laser", "x", "nan"});
  expectMentions(errorOf([] { readMounts({{"x", 1.0}}); }), {"x", "laser: {x: 1.0"});
}

TEST(Mounts, TurnAsRollPitchYawAboutFixedAxes) {
  MountOptions optical;  // of a forward-looking camera
  optical.roll = -kPi / 2.0;
  optical.yaw = -kPi / 2.0;
  const auto message = toMessage({{"camera", optical}}, "base_link");
  ASSERT_EQ(message.transforms.size(), 1U);
  EXPECT_EQ(message.transforms[0].header.frame_id, "base_link");
  EXPECT_EQ(message.transforms[0].child_frame_id, "camera");
  const auto& q = message.transforms[0].transform.rotation;
  const Eigen::Vector3d ahead = Eigen::Quaterniond(q.w, q.x, q.y, q.z) * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR((ahead - Eigen::Vector3d::UnitX()).norm(), 0.0, 1e-9) << "its z looks ahead";
}

}  // namespace
}  // namespace datmo::shared_options_test
