// SPDX-License-Identifier: BSD-3-Clause
// Each nodelet is unloaded from the running process during a drive, and then the process is killed:
// all nodelets return, and tracks with them, and the pose is still in the frame of the first map.
// How long that takes is measured, not checked.
//
// Parameter: ~out: a JSON file for the measurements.
#include <algorithm>
#include <csignal>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "manager_requests.h"
#include "paced_drive.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "datmo_fusion/ros/checkpoint_file.h"
#include "datmo_fusion/ros/convert/message_conversion.h"

namespace datmo::outage_test {
namespace {

const PacedRates kRates{50.0, 12.5, 5.0, World::kPixelStep, 0.0, 0};
constexpr double kPatience = 120.0;  // s, for the recovery on a heavily loaded machine
constexpr double kSettle = 3.0;      // s, until the next one

/// s; an outage that is surely shorter than grid_slam's checkpoint/max_age.
constexpr double kContinued = 9.0;

/// m; far more than the pose may be off after this time, and far less than the drive is long: a new
/// map would begin where the vehicle is.
constexpr double kSameFrame = 10.0;

const std::vector<std::string> kNodelets{
    "grid_slam",      "moving_objects", "tracker",      "road_border",
    "stereo_objects", "stereo_tracker", "track_fusion", "stereo_alignment",
    "risk",           "markers",        "stack",        "motion"};

class OutageTest : public testing::Test {
 protected:
  /// Leaves no checkpoint behind. grid_slam writes one more when it ends; without scans, as after
  /// this, it writes none.
  ~OutageTest() override {
    std::string file;
    unloadNodelet("grid_slam");
    if (ros::param::get("/grid_slam/checkpoint/file", file)) {
      removeCheckpoint(file);
    }
  }

  /// Returns whether there are tracks of a scan that was measured after a time (s).
  bool hasTracksOf(double time) const {
    const auto& lists = drive_.received();
    return std::any_of(lists.rbegin(), lists.rend(), [&](const PacedDrive::Received& list) {
      return list.at - list.latency > time;
    });
  }

  std::uint32_t carId() const {
    const auto& lists = drive_.received();
    const auto found =
        std::find_if(lists.rbegin(), lists.rend(), [](const auto& list) { return list.car != 0; });
    return found == lists.rend() ? 0 : found->car;
  }

  /// Returns how long after `time` (s) the nodelets are loaded and tracks arrive, and whether the
  /// other car has kept its id.
  nlohmann::json measured(const std::string& what, const std::vector<std::string>& nodelets,
                          double time, std::uint32_t id) {
    std::optional<double> loaded;
    std::optional<double> tracks;
    const auto isBack = [&] {
      if (!loaded && areLoaded(nodelets)) {
        loaded = drive_.now() - time;
      }
      if (!tracks && hasTracksOf(time)) {
        tracks = drive_.now() - time;
      }
      return loaded && tracks;
    };
    EXPECT_TRUE(drive_.run(kPatience, kRates, isBack)) << what;
    drive_.run(kSettle, kRates);
    nlohmann::json one = {{"what", what},
                          {"loaded_s", loaded.value_or(kPatience)},
                          {"tracks_s", tracks.value_or(kPatience)},
                          {"id_kept", carId() == id}};
    std::cout << one.dump() << std::endl;
    return one;
  }

  /// Returns the latest pose.
  geometry_msgs::PoseWithCovarianceStampedConstPtr latestPose() {
    EXPECT_TRUE(drive_.run(kPatience, kRates, [this] { return !drive_.poses.empty(); }));
    return drive_.poses.empty() ? nullptr : drive_.poses.back();
  }

  /// The true pose of the vehicle at the stamp of a pose.
  static Pose2 truthAt(const geometry_msgs::PoseWithCovarianceStamped& pose) {
    return World(World::Length::kEndless).baseInMap(pose.header.stamp.toSec() - World::kStart);
  }

  /// s; the longest time between two poses since `before`.
  double outageSince(const geometry_msgs::PoseWithCovarianceStamped& before) const {
    double longest = 0.0;
    ros::Time last = before.header.stamp;
    for (const auto& pose : drive_.poses) {
      longest = std::max(longest, (pose->header.stamp - last).toSec());
      last = std::max(last, pose->header.stamp);
    }
    return longest;
  }

  /// Kills the process, and expects the pose to continue in the same frame.
  nlohmann::json killed() {
    const auto before = latestPose();
    const pid_t process = processOf("/perception");
    const double time = drive_.now();
    if (before == nullptr || process <= 0 || kill(process, SIGKILL) != 0) {
      ADD_FAILURE() << "no pose or no process";
      return {};
    }
    drive_.poses.clear();
    const nlohmann::json one = measured("the process killed", kNodelets, time, carId());
    const auto after = latestPose();
    const double outage = outageSince(*before);
    if (after == nullptr || outage >= kContinued) {
      std::cout << "no poses for " << outage << " s: whether the map goes on is not checked"
                << std::endl;
      return one;
    }
    const Pose2 driven = truthAt(*before).inverse() * truthAt(*after);
    const Pose2 expected = fromMessage(before->pose.pose) * driven;
    const double off = (fromMessage(after->pose.pose).position() - expected.position()).norm();
    EXPECT_LT(off, kSameFrame) << "grid_slam has not continued in its map";
    std::cout << "pose off by " << off << " m after " << outage << " s" << std::endl;
    return one;
  }

  PacedDrive drive_;
};

TEST_F(OutageTest, UnloadedOrKilledNodeletsRecover) {
  std::string out;
  ros::param::get("~out", out);
  ASSERT_TRUE(drive_.start({"tracker", "stereo_tracker", "track_fusion"}));
  ASSERT_TRUE(
      drive_.run(kPatience, kRates, [this] { return carId() != 0 && areLoaded(kNodelets); }));
  drive_.run(kSettle, kRates);
  nlohmann::json outages = nlohmann::json::array();
  outages.push_back(measured("nothing", {}, drive_.now(), carId()));
  for (const std::string& nodelet : kNodelets) {
    const std::uint32_t id = carId();
    const double time = drive_.now();
    EXPECT_TRUE(unloadNodelet(nodelet)) << nodelet;
    outages.push_back(measured(nodelet + " unloaded", {nodelet}, time, id));
  }
  outages.push_back(killed());
  outages.back()["id_kept"] = nullptr;  // ids start over
  if (!out.empty()) {
    std::ofstream(out) << outages.dump(1) << "\n";
  }
}

}  // namespace
}  // namespace datmo::outage_test
