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

/// Follows the objects of one class through one sequence with the package's tracker, whether they
/// move or not.
class ClassTracking {
 public:
  /// Throws OptionError.
  ClassTracking(ObjectType type, const ClassTrackingOptions& options, const CameraMount& mount);

  /// Results for the detections of one frame, vehicle's frame, in their order.
  ObjectList objects(const std::vector<Detection>& detections, Stamp stamp) const;

  /// Takes what objects() has made of the next frame's detections, the vehicle's pose, and the
  /// boxes of all that stands in the view (vehicle's frame), of whatever class.
  void track(const ObjectList& objects, const Pose2& base_in_fixed, const std::vector<Box2>& seen);

  /// Where the tracks are that surely exist and are seen now, fixed frame.
  std::vector<Landmark> landmarks() const;

  /// The present tracks as rows of a result file. `objects` as given to track(), and the detections
  /// that they were made of.
  std::vector<TrackedObject> rows(const ObjectList& objects,
                                  const std::vector<Detection>& detections, int frame);

 private:
  /// What the tracker does not know of a track.
  struct Memory {
    VerticalExtent vertical;
    Stamp stamp;      ///< of its last detection
    double log_odds;  ///< of its detections, summed up
    int detections;
  };

  /// How sure it is that a track is no false alarm. The evaluation takes the mean over a track's
  /// rows, which shall rank true tracks above false ones. A detector's errors go on from frame to
  /// frame, so that the sum of what it says would be too sure, and the mean forgets how often it
  /// said so: the mean is drawn to what false tracks have, the less the longer a track is.
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
