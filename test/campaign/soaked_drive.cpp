// SPDX-License-Identifier: BSD-3-Clause
#include "soaked_drive.h"

#include <fstream>
#include <utility>

#include "all_levels.h"
#include "processor_time.h"
#include <boost/make_shared.hpp>
#include <malloc.h>
#include <unistd.h>

#include "datmo_fusion/common/quantile.h"
#include "datmo_fusion/ros/convert/messages.h"

namespace datmo::campaign {

namespace {

constexpr std::uint64_t kStepsPerSecond = 16;
constexpr std::uint64_t kStepsPerMinute = 60 * kStepsPerSecond;
constexpr std::uint64_t kStepsPerCloud = 2;
constexpr double kStepsPerHour = 60.0 * kStepsPerMinute;
constexpr double kMilliseconds = 1e3;
constexpr double kMebibyte = 1024.0 * 1024.0;

/// Memory that the program has allocated, large blocks included, MiB.
double heapMebibytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd) / kMebibyte;
}

/// From /proc/self/statm, MiB: pages of the program, and those resident in memory.
double residentMebibytes() {
  std::uint64_t size = 0;
  std::uint64_t resident = 0;
  std::ifstream("/proc/self/statm") >> size >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / kMebibyte;
}

SensorSet sensorsOf(const std::string& config, int max_tiles) {
  SensorSet sensors(config);
  if (max_tiles > 0) {
    sensors.set("grid_slam", "map/max_tiles", max_tiles);
  }
  return sensors;
}

tf2_msgs::TFMessage listOf(std::vector<geometry_msgs::TransformStamped> transforms) {
  tf2_msgs::TFMessage message;
  message.transforms = std::move(transforms);
  return message;
}

}  // namespace

SoakedDrive::SoakedDrive(const std::string& config, int max_tiles)
    : runner_(sensorsOf(config, max_tiles), allLevels()) {
  runner_.handleStaticTransforms(listOf({world_.scannerInBase(), world_.cameraInBase()}));
}

SoakSample SoakedDrive::nextMinute() {
  sample_ = {};
  milliseconds_.clear();
  for (std::uint64_t i = 0; i < kStepsPerMinute; ++i) {
    step(i % kStepsPerCloud == 0);
  }
  runner_.takeTimes();  // otherwise they are kept for the whole drive
  minutes_without_tracks_ += sample_.tracks == 0 ? 1 : 0;
  sample_.hours = static_cast<double>(steps_) / kStepsPerHour;
  sample_.heap_mib = heapMebibytes();
  sample_.resident_mib = residentMebibytes();
  sample_.median_ms = quantile(milliseconds_, 0.5);
  sample_.percentile_99_ms = quantile(milliseconds_, 0.99);
  for (const StageMonitor* monitor : runner_.monitors()) {
    sample_.dropped += monitor->droppedCount();
  }
  return sample_;
}

void SoakedDrive::step(bool with_cloud) {
  const double seconds = static_cast<double>(steps_) / kStepsPerSecond;
  const Stamp now = Stamp::fromSeconds(World::kStart + seconds);
  take(runner_.handleTransforms(listOf({world_.baseInOdom(seconds)}), now));
  send("odometry", world_.odometry(seconds));
  if (with_cloud) {
    send("stereo/right/camera_info", World::rightCameraInfo());
    send("stereo/points2", world_.cloud(seconds));
  }
  const sensor_msgs::LaserScan scan = world_.scan(seconds);
  const double begin = processorSeconds();
  send("scan", scan);
  milliseconds_.push_back(kMilliseconds * (processorSeconds() - begin));
  ++steps_;
}

template <typename Message>
void SoakedDrive::send(const std::string& topic, const Message& message) {
  const double seconds = static_cast<double>(steps_) / kStepsPerSecond;
  take(runner_.handle(topic, boost::shared_ptr<const Message>(boost::make_shared<Message>(message)),
                      Stamp::fromSeconds(World::kStart + seconds)));
}

void SoakedDrive::take(const Publications& published) {
  for (const Publication& publication : published) {
    const auto tracks = publication.as<TrackArray>();
    if (tracks && publication.topic == "tracks") {
      ++sample_.track_lists;
      sample_.tracks += tracks->tracks.size();
    }
  }
}

std::vector<std::string> SoakedDrive::faults() const {
  std::vector<std::string> faults;
  if (minutes_without_tracks_ > 0) {
    faults.push_back(std::to_string(minutes_without_tracks_) + " minutes without a track");
  }
  for (const StageMonitor* monitor : runner_.monitors()) {
    for (const auto& [reason, count] : monitor->drops()) {
      faults.push_back(monitor->stage() + ": " + reason + " " + std::to_string(count) +
                       " times, last " + monitor->lastDrop());
    }
  }
  return faults;
}

}  // namespace datmo::campaign
