// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "kitti_tracking/camera_mount.h"
#include "kitti_tracking/detection_model.h"
#include "kitti_tracking/ego_motion.h"
#include "kitti_tracking/kitti_tracking_files.h"
#include "kitti_tracking/vertical_extent.h"

#include "datmo_fusion/tracking/tracker.h"

namespace datmo::kitti {

/// Options of one class of objects: one file in config/kitti_tracking/.
struct ClassTrackingOptions {
  DetectionModelOptions detections;
  TrackerOptions tracker;
  VerticalExtentOptions vertical;
  double prior_log_odds = -4.0;  ///< 1
  double prior_weight = 8.0;     ///< 1

  void visit(OptionVisitor& visitor);
};

/// Tracks the objects of one class through one sequence with the package's tracker, whether they
/// move or not.
class ClassTracking {
 public:
  /// Throws OptionError.
  ClassTracking(ObjectType type, const ClassTrackingOptions& options, const CameraMount& mount);

  /// The objects of the detections of one frame, vehicle's frame, in their order.
  ObjectList objects(const std::vector<Detection>& detections, Stamp stamp) const;

  /// Processes the next frame: its detections as converted by objects(), the vehicle's pose, and
  /// the boxes of all objects in view (vehicle's frame), of any class.
  void track(const ObjectList& objects, const Pose2& base_in_fixed, const std::vector<Box2>& seen);

  /// Positions of the tracks that certainly exist and are detected now, fixed frame.
  std::vector<Landmark> landmarks() const;

  /// The present tracks as rows of a result file. `objects` as given to track(), with the
  /// detections from which they were made.
  std::vector<TrackedObject> rows(const ObjectList& objects,
                                  const std::vector<Detection>& detections, int frame);

 private:
  /// Data of a track that the tracker does not have.
  struct Memory {
    VerticalExtent vertical;
    Stamp stamp;      ///< of its last detection
    double log_odds;  ///< of its detections, summed up
    int detections;
  };

  /// Confidence that a track is not a false alarm. The evaluation uses the mean over a track's
  /// rows, which should rank true tracks above false ones. A detector's errors are correlated from
  /// frame to frame, so the sum of its log odds would be overconfident, while the mean ignores
  /// their number: the mean is therefore drawn toward the value of false tracks, less so for longer
  /// tracks.
  double scoreOf(const Memory& memory) const;

  /// Updates with the track's detection, if it has one now. Null for a track that never had one.
  const Memory* remember(const Track& track, const ObjectList& objects,
                         const std::vector<Detection>& detections);
  TrackedObject rowOf(const Track& track, const Memory& memory, int frame) const;

  ObjectType type_;
  ClassTrackingOptions options_;
  CameraMount mount_;
  DetectionModel model_;
  Tracker tracker_;
  Pose2 base_in_fixed_;
  TrackList tracks_;
  std::map<std::uint32_t, Memory> memories_;  ///< by track id
};

}  // namespace datmo::kitti
