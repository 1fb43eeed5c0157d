// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "kitti_tracking/class_tracking.h"

namespace datmo::kitti {

/// The order of all arrays of classes.
inline constexpr std::array<ObjectType, 3> kTrackedTypes = {
    ObjectType::kCar, ObjectType::kPedestrian, ObjectType::kCyclist};
inline constexpr std::size_t kTrackedClasses = kTrackedTypes.size();
/// Names in options and files.
inline constexpr std::array<const char*, kTrackedClasses> kClassNames = {"car", "pedestrian",
                                                                         "cyclist"};

struct RunOptions {
  std::array<ClassTrackingOptions, kTrackedClasses> classes;
  EgoMotionOptions ego_motion;
  bool estimate_ego_motion = true;
  double frame_period = 0.1;  ///< s
  ImageSize image;

  void visit(OptionVisitor& visitor);
};

/// The detections of one sequence.
struct DetectedSequence {
  std::string name;  ///< "0000"
  Calibration calibration;
  std::array<std::vector<Detection>, kTrackedClasses> detections;
};

/// The result of a sequence.
struct SequenceRun {
  std::vector<TrackedObject> rows;  ///< in order of frame; one for each frame and id
  std::size_t frames = 0;
  double tracking_seconds = 0.0;  ///< processor time of the trackers alone, all classes
  double ego_motion_seconds = 0.0;
};

/// Tracks the objects of all classes through a sequence. Ids are distinct among the classes.
SequenceRun runSequence(const DetectedSequence& sequence, const RunOptions& options);

}  // namespace datmo::kitti
