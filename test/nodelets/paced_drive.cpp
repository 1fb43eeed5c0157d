// SPDX-License-Identifier: BSD-3-Clause
#include "paced_drive.h"

#include <algorithm>
#include <fstream>

#include "ros/seen_object.h"
#include <unistd.h>

#include <ros/callback_queue.h>

#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo {

namespace {

constexpr std::uint32_t kPacedQueue = 1000;
constexpr double kMemoryPeriod = 1.0;  // s
constexpr double kCatchUp = 0.5;  // s: what is due for longer was not sent, as of a real sensor
constexpr char kManager[] = "/perception";

/// Returns the resident memory of a process, MiB; 0 if it has ended.
double residentOf(pid_t process) {
  std::uint64_t size = 0;
  std::uint64_t resident = 0;
  std::ifstream("/proc/" + std::to_string(process) + "/statm") >> size >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) /
         (1024.0 * 1024.0);
}

/// Cars in rows, as fast as the vehicle, so that they keep their positions relative to it.
ObjectArray rowsOfObjects(int count, Stamp stamp) {
  constexpr int kRow = 25;
  constexpr double kSpacing = 6.0;  // m
  ObjectList list{stamp, {}, {}};
  for (int i = 0; i < count; ++i) {
    const Pose2 center(kSpacing * (1 + i / kRow), kSpacing * (i % kRow - kRow / 2), 0.0);
    list.objects.push_back(samples::seenObject("stereo", {center, 4.0, 1.8}));
  }
  return toMessage(list, "base_link");
}

}  // namespace

bool PacedDrive::start(const std::vector<std::string>& names) {
  objects_ = node_.advertise<ObjectArray>("objects/stereo", kPacedQueue);
  tracks_ =
      node_.subscribe<TrackArray>("tracks", kPacedQueue, [this](const TrackArrayConstPtr& list) {
        const double stamp = list->header.stamp.toSec() - world().start();
        received_.push_back({now(), now() - stamp, list->tracks.size(), carIn(*list)});
      });
  if (!waitForNodelets(names)) {
    return false;
  }
  sendCameraInfo();
  mountSensors();
  begin();
  if (!prepareMotion(0.0)) {
    return false;
  }
  begin();  // some time later
  return true;
}

void PacedDrive::begin() {
  if (!ros::Time::isSimTime()) {
    enter(World(World::Length::kEndless, ros::Time::now().toSec()));
  }
  start_ = ros::SteadyTime::now();
}

bool PacedDrive::run(double seconds, const PacedRates& rates, const std::function<bool()>& until) {
  for (const double end = now() + seconds; now() < end && ros::ok();) {
    sendDue(rates);
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.001));
    if (until()) {
      return true;
    }
  }
  return false;
}

std::size_t PacedDrive::sent(const std::string& topic) const {
  const auto found = sent_.find(topic);
  return found == sent_.end() ? 0 : found->second;
}

bool PacedDrive::isDue(const std::string& topic, double rate) {
  double& next = next_.try_emplace(topic, now()).first->second;
  if (rate <= 0.0 || now() < next) {
    return false;
  }
  next = std::max(next, now() - kCatchUp) + 1.0 / rate;
  ++sent_[topic];
  return true;
}

void PacedDrive::sendDue(const PacedRates& rates) {
  if (isDue("odometry", rates.motion)) {
    sendMotion(now());
  }
  if (isDue("scan", rates.scans)) {
    sendScan(world().scan(now()));
  }
  if (isDue("stereo/points2", rates.clouds)) {
    sendCloud(world().cloud(now() - rates.cloud_delay, rates.pixel_step));
  }
  if (isDue("objects/stereo", rates.object_lists)) {
    objects_.publish(rowsOfObjects(rates.objects, Stamp::fromSeconds(world().start() + now())));
  }
  if (memory_.empty() || now() - memory_.back().at > kMemoryPeriod) {
    sampleMemory();
    forget();
  }
}

void PacedDrive::sampleMemory() {
  if (process_ == 0) {
    process_ = processOf(kManager);  // looked up once: it may be stopped later
  }
  memory_.push_back({now(), residentOf(process_)});
}

/// Looks for the car from the pose in the current map: the map of a restarted process begins where
/// the vehicle is.
std::uint32_t PacedDrive::carIn(const TrackArray& list) const {
  constexpr double kNear = 1.5;  // m
  const double seconds = list.header.stamp.toSec() - world().start();
  const auto pose = std::find_if(poses.rbegin(), poses.rend(), [&](const auto& each) {
    return each->header.stamp == list.header.stamp;
  });
  if (pose == poses.rend()) {
    return 0;
  }
  const Point2 in_base =
      world().baseInMap(seconds).inverse() * world().otherCar(seconds).center.position();
  const Point2 truth = fromMessage((*pose)->pose.pose) * in_base;
  for (const TrackMessage& track : list.tracks) {
    if ((truth - Point2(track.pose.position.x, track.pose.position.y)).norm() < kNear) {
      return track.id;
    }
  }
  return 0;
}

/// Clears what a Listener keeps, which is too much for hours.
void PacedDrive::forget() {
  poses.clear();
  maps.clear();
  labeled_scans.clear();
  objects.clear();
  tracks.clear();
}

}  // namespace datmo
