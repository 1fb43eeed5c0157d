// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "evaluate/evaluation_data.h"

#include "datmo_fusion/common/pose2.h"

namespace datmo::evaluation {

// The contents of bags for the evaluation, without ROS. All lists are in order of stamp, without
// duplicates, and all numbers are finite: whatever fills them has checked this.

/// Pose of the vehicle (base_link) at one stamp, in the map of the run or of the truth.
struct StampedPose {
  Stamp stamp;
  PoseWithCovariance pose;  ///< covariance zero: not known
};

/// A published track, in the map of the run.
struct RecordedTrack {
  TrackState state;
  bool moving = true;  ///< false: stationary now
};

struct RecordedTracks {
  Stamp stamp;
  std::vector<RecordedTrack> tracks;  ///< no id twice
};

/// Positions of the moving objects detected in one measurement.
struct RecordedDetections {
  Stamp stamp;
  std::vector<Point2> moving;  ///< m, centers, frame of the vehicle
};

struct RecordedIntersection {
  Stamp stamp;
  bool at_intersection = false;
};

/// Processing times of one stage.
struct StageDurations {
  std::vector<double> processing;  ///< s
  std::vector<double> latency;     ///< s from the measurement to the result, where it is known
};

/// The results of a run of the stack; parts that are missing in its bag are empty (std::nullopt).
struct RecordedRun {
  std::vector<RecordedTracks> tracks;
  std::vector<StampedPose> poses;
  std::optional<std::vector<RecordedDetections>> detections;
  std::optional<std::vector<RecordedIntersection>> intersections;
  std::map<std::string, StageDurations> durations;  ///< by stage
};

/// The true state of an object at one stamp, in the map of the truth.
struct RecordedObject {
  TrueState state;
  std::string label;                    ///< the source's own name of the class
  bool moving = false;                  ///< over ground, at this stamp
  std::vector<std::string> visible_to;  ///< sensors that it is visible to
  int lidar_beams = 0;                  ///< that end on it
};

struct RecordedObjects {
  Stamp stamp;
  std::vector<RecordedObject> objects;  ///< no id twice
};

struct RecordedTruth {
  std::vector<RecordedObjects> objects;
  std::vector<StampedPose> poses;
  std::optional<std::vector<RecordedIntersection>> intersections;
};

}  // namespace datmo::evaluation
