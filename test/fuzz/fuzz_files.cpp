// SPDX-License-Identifier: BSD-3-Clause
// Files of strangers: maps of ours and of map_server, checkpoints, configurations, DBC files,
// recordings of the network and bags.
#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "file_seeds.h"
#include "fuzz_check.h"
#include "input_bag.h"
#include "run_bag/sensor_set.h"
#include "scratch_folder.h"
#include "slam/yard.h"

#include <rosbag/view.h>
#include <sensor_msgs/LaserScan.h>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/device/can_database.h"
#include "datmo_fusion/device/capture_file.h"
#include "datmo_fusion/device/device_error.h"
#include "datmo_fusion/ros/checkpoint_file.h"
#include "datmo_fusion/ros/map_files.h"
#include "datmo_fusion/ros/stage/input_error.h"
#include "datmo_fusion/slam/grid_slam.h"

namespace datmo::fuzz {
namespace {

constexpr std::size_t kMaxCells = 100'000;  ///< of a checkpoint
constexpr double kScanInterval = 0.1;       // s, between a checkpoint and the first scan after it

const ScratchFolder& scratch() {
  static const ScratchFolder folder;
  return folder;
}

/// A map that was read can be written, and read again.
void checkMap(const std::string& file) {
  const OccupancyMap map = readMap(file, mapOfFiles());
  const MapEvidence evidence = map.evidence();
  require(!evidence.cells.empty(), "a map without cells");
  std::istringstream again(mapText(evidence));
  require(readMapText(again, file).cells.size() == evidence.cells.size(), "a map read again");
}

/// Cells with the header that belongs to them: random bytes would hardly ever have the checksum.
void checkCells(std::string_view bytes) {
  const std::string cells(bytes.substr(0, bytes.size() / kMapBytesPerCell * kMapBytesPerCell));
  std::ostringstream text;
  text << "datmo_fusion map 1\ncell_size 0.5\ncells " << cells.size() / kMapBytesPerCell
       << "\ncrc32 " << checksumOf(cells) << '\n'
       << cells;
  checkMap(scratch().write("map", text.str()));
}

/// A yaml file, up to the first "P5", and the image `map.pgm` from there.
void checkMapServer(std::string_view bytes) {
  const std::size_t image = std::min(bytes.find("P5"), bytes.size());
  scratch().write("map.pgm", bytes.substr(image));
  checkMap(scratch().write("map.yaml", bytes.substr(0, image)));
}

/// The fields of a checkpoint's header: the SLAM continues from it, if it is accepted.
void checkCheckpoint(std::string_view bytes) {
  std::ostringstream text;
  text << "datmo_fusion checkpoint 1\n"
       << bytes.size() << ' ' << checksumOf(std::string(bytes)) << '\n'
       << bytes << mapText(wallEvidence());
  const Checkpoint checkpoint =
      readCheckpoint(scratch().write("checkpoint", text.str()), kMaxCells);
  GridSlamOptions options;
  options.map = mapOfFiles();
  GridSlam slam(options);
  slam.continueFrom(checkpoint.slam, checkpoint.window.cells);
  Scan scan = Yard().scan(Pose2(), 0.0);
  scan.stamp = checkpoint.slam.pose.stamp + kScanInterval;
  const SlamResult result = slam.process(scan);
  const PoseWithCovariance& pose = result.labeled_scan.base_in_map;
  require(pose.pose.position().allFinite(), "position after a checkpoint");
  requireFinite(pose.pose.heading(), "heading after a checkpoint");
  require(pose.covariance.allFinite(), "covariance after a checkpoint");
}

void checkConfiguration(std::string_view bytes) {
  SensorSet(scratch().write("sensors.yaml", bytes));
}

void checkDatabase(std::string_view bytes) {
  const CanSignal signal = canSignalOf("can/speed", scratch().write("vehicle.dbc", bytes), "Speed");
  CanFrame frame;
  frame.size = CanFrame::kLongest;
  requireFinite(signal.value(frame).value_or(0.0), "value of a signal");
}

/// A frame of each kind of network, and a file whose first frame is read.
void checkCapture(std::string_view bytes) {
  constexpr int kPort = 2368;
  for (const int link : {1, 101, 113, 276}) {  // Ethernet, raw IP, both of `tcpdump -i any`
    const std::string_view data = datagramOf(bytes, link, kPort).value_or(std::string_view());
    require(data.size() <= bytes.size(), "size of a datagram");
  }
  const std::atomic<bool> stop = true;
  try {
    CaptureFile(scratch().write("frames.pcap", bytes), kPort, stop).next();
  } catch (const DeviceStopped&) {
  }
}

void readScans(const rosbag::Bag& bag) {
  rosbag::View view(bag);
  for (const rosbag::MessageInstance& message : view) {
    try {
      bytesOf(message);
      read<sensor_msgs::LaserScan>(message);
    } catch (const InputError&) {
    }
  }
}

/// A bag that is refused.
struct BagError {};

/// As run_bag, which refuses a file, or the rest of it, for any error of rosbag.
void checkBag(std::string_view bytes) {
  try {
    rosbag::Bag bag;
    openInput(scratch().write("drive.bag", bytes), bag);
    readScans(bag);
  } catch (const std::runtime_error&) {
    throw BagError();
  }
}

std::array<InputKind, 8> kinds{
    {{"map", [](std::string_view bytes) { checkMap(scratch().write("map", bytes)); }},
     {"cells", checkCells},
     {"map_server", checkMapServer},
     {"checkpoint", checkCheckpoint},
     {"configuration", checkConfiguration},
     {"can_database", checkDatabase},
     {"capture", checkCapture},
     {"bag", checkBag}}};

}  // namespace
}  // namespace datmo::fuzz

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  return std::atexit([] { datmo::fuzz::printCounts(datmo::fuzz::kinds); });
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return datmo::fuzz::decodeSelected<datmo::MapFileError, datmo::OptionError, datmo::DeviceError,
                                     datmo::fuzz::BagError>(datmo::fuzz::kinds, data, size);
}
