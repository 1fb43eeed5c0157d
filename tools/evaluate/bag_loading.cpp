// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/bag_loading.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "evaluate/topic_reader.h"
#include "input_bag.h"

#include <rosbag/bag.h>

#include "datmo_fusion/ros/stage/input_error.h"

namespace datmo::evaluation {

namespace {

void checkSameFrame(const std::string& file, const TopicReader& a, const TopicReader& b) {
  if (a.frame() != b.frame()) {
    throw std::runtime_error(file + ": " + a.topic() + " is in frame '" + a.frame() + "', but " +
                             b.topic() + " in '" + b.frame() + "': expected one frame");
  }
}

void checkFinite(const StageTiming& message) {
  if (!std::isfinite(message.processing_time) || !std::isfinite(message.latency)) {
    throw InputError("not_finite", "stage " + message.stage + " took " +
                                       std::to_string(message.processing_time) +
                                       " s, with a latency of " + std::to_string(message.latency) +
                                       " s: expected finite numbers");
  }
}

std::map<std::string, StageDurations> readDurations(TopicReader timing) {
  std::map<std::string, StageDurations> durations;
  if (timing.isThere()) {
    timing.forEach<StageTiming>([&durations](const StageTiming& message) {
      checkFinite(message);
      StageDurations& stage = durations[message.stage];
      stage.processing.push_back(message.processing_time);
      if (message.latency >= 0.0) {
        stage.latency.push_back(message.latency);
      }
    });
  }
  return durations;
}

void readPoses(const rosbag::Bag& bag, const ScoreOptions& options, const TopicReader& tracks,
               RecordedRun& run) {
  TopicReader poses(bag, options.topics.pose);
  const bool needed = options.align != TrackAlignment::kNone;
  if (!needed && !poses.isThere()) {
    return;
  }
  run.poses = poses.readAll<geometry_msgs::PoseWithCovarianceStamped>();
  if (needed) {
    checkSameFrame(bag.getFileName(), tracks, poses);
  }
}

std::string objectsTopic(const rosbag::Bag& bag, const TopicOptions& topics) {
  if (!topics.objects.empty()) {
    return topics.objects;
  }
  constexpr char kFused[] = "/objects/fused";
  return holdsTopic(bag, kFused) ? kFused : "/objects";
}

bool isEmpty(const RecordedObjects& objects) { return objects.objects.empty(); }

}  // namespace

RecordedRun loadRun(const std::string& file, const ScoreOptions& options) {
  const TopicOptions& topics = options.topics;
  rosbag::Bag bag;
  openInput(file, bag);
  RecordedRun run;
  TopicReader tracks(bag, topics.tracks);
  run.tracks = tracks.readAll<TrackArray>();
  readPoses(bag, options, tracks, run);
  run.detections = TopicReader(bag, objectsTopic(bag, topics)).readIfThere<ObjectArray>();
  run.intersections =
      TopicReader(bag, topics.road_borders).readIfThere<datmo_fusion::RoadBorders>();
  run.durations = readDurations(TopicReader(bag, topics.timing));
  return run;
}

RecordedTruth loadTruth(const std::string& file, const ScoreOptions& options) {
  const TopicOptions& topics = options.topics;
  rosbag::Bag bag;
  openInput(file, bag);
  RecordedTruth truth;
  TopicReader objects(bag, topics.true_objects);
  TopicReader poses(bag, topics.true_pose);
  truth.objects = objects.readAll<TrueObjectArray>();
  truth.poses = poses.readAll<nav_msgs::Odometry>();
  checkSameFrame(file, objects, poses);
  truth.intersections = TopicReader(bag, topics.true_road_borders).readIfThere<TrueRoadBorders>();
  if (std::all_of(truth.objects.begin(), truth.objects.end(), isEmpty)) {
    throw std::runtime_error(file + ": " + topics.true_objects + " holds no object in " +
                             std::to_string(truth.objects.size()) +
                             " messages: expected some, or there is nothing to score");
  }
  return truth;
}

}  // namespace datmo::evaluation
