// SPDX-License-Identifier: BSD-3-Clause
#include "stage_seeds.h"

#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "campaign_sensors.h"
#include "fuzzed_graph.h"
#include "message_kinds.h"
#include <boost/make_shared.hpp>

#include <sensor_msgs/MultiEchoLaserScan.h>

#include "datmo_fusion/ros/transform_topics.h"

namespace datmo::fuzz {

namespace {

using campaign::CampaignSensors;

constexpr int kSteps = 8;                // then there are tracks
constexpr std::size_t kBeamStep = 4;     // every fourth beam is kept
constexpr std::size_t kMaxPoints = 120;  // of a cloud
constexpr std::uint32_t kColumns = 64;   // px, of an image
constexpr std::uint32_t kRows = 32;      // px
constexpr int kSlowSteps = 4;            // from message to message of all but motion and scans

template <typename Element>
void keepEvery(std::vector<Element>& elements, std::size_t step) {
  std::vector<Element> kept;
  for (std::size_t i = 0; i < elements.size(); i += step) {
    kept.push_back(elements[i]);
  }
  elements = std::move(kept);
}

// shrink(): a small message in place of a large one.

template <typename Scan>
void shrinkScan(Scan& scan) {
  keepEvery(scan.ranges, kBeamStep);
  scan.angle_increment *= static_cast<float>(kBeamStep);
}
void shrink(sensor_msgs::LaserScan& scan) { shrinkScan(scan); }
void shrink(sensor_msgs::MultiEchoLaserScan& scan) { shrinkScan(scan); }

void shrink(sensor_msgs::PointCloud2& cloud) {
  const std::size_t points = cloud.data.size() / cloud.point_step;
  std::vector<std::uint8_t> kept;
  for (std::size_t i = 0; i < points; i += 1 + points / kMaxPoints) {
    const auto point = cloud.data.begin() + static_cast<std::ptrdiff_t>(i * cloud.point_step);
    kept.insert(kept.end(), point, point + cloud.point_step);
  }
  cloud.width = static_cast<std::uint32_t>(kept.size() / cloud.point_step);
  cloud.height = 1;
  cloud.row_step = static_cast<std::uint32_t>(kept.size());
  cloud.data = std::move(kept);
}

/// Its middle, as the camera's calibration demands.
void shrink(sensor_msgs::Image& image) {
  std::vector<std::uint8_t> kept;
  for (std::uint32_t row = 0; row < kRows; ++row) {
    const std::size_t first =
        static_cast<std::size_t>(row + (image.height - kRows) / 2) * image.step +
        (image.width - kColumns) / 2;
    const auto at = image.data.begin() + static_cast<std::ptrdiff_t>(first);
    kept.insert(kept.end(), at, at + kColumns);
  }
  image.width = image.step = kColumns;
  image.height = kRows;
  image.data = std::move(kept);
}

/// That of an image; the clouds have none.
void shrink(sensor_msgs::CameraInfo& info) {
  if (info.K[0] > 0.0) {
    const double left = 0.5 * (info.width - kColumns);
    const double top = 0.5 * (info.height - kRows);
    info.width = kColumns;
    info.height = kRows;
    info.K[2] -= left;
    info.K[5] -= top;
    info.P[2] -= left;
    info.P[6] -= top;
  }
}

template <typename... Messages>
void shrinkOneOf(Publication& publication) {
  const auto shrink_it = [&publication](const auto& message) {
    if (message) {
      auto copy = boost::make_shared<std::decay_t<decltype(*message)>>(*message);
      shrink(*copy);
      publication.message = copy;
    }
  };
  (shrink_it(publication.as<Messages>()), ...);
}

void shrinkAny(Publication& publication) {
  shrinkOneOf<sensor_msgs::LaserScan, sensor_msgs::MultiEchoLaserScan, sensor_msgs::PointCloud2,
              sensor_msgs::Image, sensor_msgs::CameraInfo>(publication);
}

/// One drive through a graph.
class SeedDrive {
 public:
  explicit SeedDrive(std::size_t index)
      : graph_(fuzzedGraphs()[index]),
        runner_(graph_.sensors, graph_.campaign.switches),
        sensors_(graph_.campaign) {
    seed_.name = "graph_" + std::to_string(index);
    seed_.drive.graph = static_cast<std::uint8_t>(index);
  }

  /// `copied`: topics between stages that an earlier seed has; extended.
  StageSeed run(std::set<std::string>& copied) {
    for (int step = 0; step < kSteps; ++step) {
      next_wait_ = std::lround(1000.0 * CampaignSensors::kStep);
      std::vector<Publication> sent = sensors_.at(step);
      for (Publication& message : sent) {
        shrinkAny(message);
        if (isSent(message, step)) {
          record(message);
          take(campaign::handleAny(message, timeOf(step), runner_));
        }
      }
    }
    recordCopies(copied);
    return std::move(seed_);
  }

 private:
  bool isSent(const Publication& message, int step) const {
    static const std::set<std::string> fast{
        kTransformTopic, "scan",        "echoes", "scans/front",
        "scans/rear",    "odometry",    "twist",  "twist_with_covariance",
        "imu",           "joint_states"};
    return graph_.topics.count(message.topic) > 0 &&
           (fast.count(message.topic) > 0 || step % kSlowSteps == 0);
  }

  static Stamp timeOf(int step) {
    return Stamp::fromSeconds(World::kStart + CampaignSensors::kStep * step);
  }

  /// Keeps the last message of each topic between stages.
  void take(const Publications& published) {
    for (const Publication& publication : published) {
      if (graph_.topics.count(publication.topic) > 0) {
        between_[publication.topic] = publication;
      }
    }
  }

  void record(const Publication& message) {
    seed_.drive.messages.push_back(
        {topicIndexIn(seed_.drive, {message.topic, message.data_type}),
         static_cast<std::uint16_t>(std::exchange(next_wait_, 0)),
         campaign::messageKinds().at(message.data_type).encoded(message.message)});
  }

  void recordCopies(std::set<std::string>& copied) {
    const ros::Duration shift(0.5 * CampaignSensors::kStep);
    for (auto& [topic, publication] : between_) {
      if (!copied.insert(topic).second) {
        continue;
      }
      shrinkAny(publication);
      publication.message =
          campaign::messageKinds().at(publication.data_type).shifted(publication.message, shift);
      record(publication);
    }
  }

  const FuzzedGraph& graph_;
  GraphRunner runner_;
  CampaignSensors sensors_;
  std::map<std::string, Publication> between_;
  long next_wait_ = 0;  ///< ms
  StageSeed seed_;
};

}  // namespace

std::vector<StageSeed> stageSeeds() {
  std::vector<StageSeed> seeds;
  std::set<std::string> copied;
  for (std::size_t i = 0; i < fuzzedGraphs().size(); ++i) {
    seeds.push_back(SeedDrive(i).run(copied));
  }
  return seeds;
}

}  // namespace datmo::fuzz
