// SPDX-License-Identifier: BSD-3-Clause
#include "file_seeds.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "device/capture_sample.h"
#include "scratch_folder.h"

#include <rosbag/bag.h>
#include <sensor_msgs/LaserScan.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/ros/checkpoint_file.h"
#include "datmo_fusion/ros/map_files.h"

namespace datmo::fuzz {
namespace {

namespace fs = std::filesystem;

std::string contentOf(const std::string& file) {
  std::ostringstream content;
  content << std::ifstream(file, std::ios::binary).rdbuf();
  return content.str();
}

/// The fields in a checkpoint's header.
std::string checkpointFields(const std::string& file) {
  Checkpoint checkpoint;
  checkpoint.run = "run 1";
  checkpoint.options = {{"map/cell_size", "0.5"}};
  PoseTracker::State& pose = checkpoint.slam.pose;
  pose.stamp = Stamp::fromSeconds(1000.0);
  pose.scan_interval = 0.1;
  pose.estimate.velocity = {5.0, 0.1};
  pose.estimate.covariance.setIdentity();
  pose.odometry = {{Stamp::fromSeconds(999.9), {5.0, 0.1}, Pose2(1.0, 0.0, 0.0), true, true}};
  writeCheckpoint(file, checkpoint);
  std::istringstream content(contentOf(file));
  std::string line;
  std::getline(content, line);
  std::getline(content, line);
  std::string fields(std::stoul(line), '\0');
  content.read(fields.data(), static_cast<std::streamsize>(fields.size()));
  return fields;
}

void writeBag(const std::string& file, rosbag::CompressionType compression) {
  sensor_msgs::LaserScan scan;
  scan.header.frame_id = "scanner";
  scan.angle_min = static_cast<float>(degrees(-80.0));
  scan.angle_max = static_cast<float>(degrees(80.0));
  scan.angle_increment = static_cast<float>(degrees(40.0));
  scan.range_max = 50.0F;
  scan.ranges.assign(5, 10.0F);
  rosbag::Bag bag(file, rosbag::bagmode::Write);
  bag.setCompression(compression);
  for (const double time : {1.0, 1.1}) {
    scan.header.stamp = ros::Time(time);
    bag.write("/scan", scan.header.stamp, scan);
  }
}

/// Those of the package.
std::vector<FileSeed> configurations() {
  std::vector<FileSeed> seeds;
  for (const fs::directory_entry& entry : fs::directory_iterator(DATMO_FUSION_CONFIG)) {
    if (entry.path().extension() == ".yaml") {
      seeds.push_back(
          {"configuration_" + entry.path().stem().string(), 4, contentOf(entry.path().string())});
    }
  }
  return seeds;
}

constexpr char kDatabase[] =
    "VERSION \"\"\n\nBO_ 416 Motion: 8 Gateway\n"
    " SG_ Speed : 8|16@1+ (0.01,0) [0|250] \"km/h\" Vector__XXX\n"
    " SG_ Gear m1 : 0|4@0- (1,-2) [0|0] \"\" Vector__XXX\n"
    "SIG_VALTYPE_ 416 Gear : 1;\n";

/// rosbag takes it for format 2.0, and a header of 2 GiB.
constexpr char kOtherBag[] = "#ROSBAG V2.00\n\xFF\xFF\xFF\x7F";

}  // namespace

std::vector<FileSeed> fileSeeds() {
  const ScratchFolder folder;
  const std::string map = mapText(wallEvidence());
  const std::size_t cells = wallEvidence().cells.size() * kMapBytesPerCell;
  writeMap(folder.file("map"), OccupancyMap::restored(mapOfFiles(), wallEvidence()));
  writeBag(folder.file("drive.bag"), rosbag::compression::Uncompressed);
  writeBag(folder.file("bz2.bag"), rosbag::compression::BZ2);
  writeBag(folder.file("lz4.bag"), rosbag::compression::LZ4);
  samples::writeCapture(folder.file("frames.pcap"), {{1.0, 2368, "data"}});
  std::vector<FileSeed> seeds{
      {"map", 0, map},
      {"cells", 1, map.substr(map.size() - cells)},
      {"map_server", 2, contentOf(folder.file("map.yaml")) + contentOf(folder.file("map.pgm"))},
      {"checkpoint", 3, checkpointFields(folder.file("checkpoint"))},
      {"can_database", 5, kDatabase},
      {"capture", 6, contentOf(folder.file("frames.pcap"))},
      {"frame", 6, samples::ethernetFrame({1.0, 2368, "data"})},
      {"bag", 7, contentOf(folder.file("drive.bag"))},
      {"bag_bz2", 7, contentOf(folder.file("bz2.bag"))},
      {"bag_lz4", 7, contentOf(folder.file("lz4.bag"))},
      {"bag_format", 7, kOtherBag}};
  for (FileSeed& seed : configurations()) {
    seeds.push_back(std::move(seed));
  }
  return seeds;
}

}  // namespace datmo::fuzz
