// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "kitti_tracking/box3_overlap.h"

namespace datmo::kitti {

/// Labels of KITTI tracking (Geiger et al., Are we ready for autonomous driving? The KITTI
/// vision benchmark suite, CVPR 2012).
enum class ObjectType {
  kCar,
  kVan,
  kTruck,
  kPedestrian,
  kPersonSitting,
  kPerson,  ///< also sitting ones, in some of the label files; ignored by KITTI's evaluation
  kCyclist,
  kTram,
  kMisc,
  kDontCare,
};

/// The name in the files: "Car", "Person_sitting".
std::string nameOf(ObjectType type);

/// A rectangle in the left color image, px.
struct ImageBox {
  double left = 0.0;
  double top = 0.0;
  double right = 0.0;
  double bottom = 0.0;
};

/// One object in one frame, labeled or tracked: one line of a label or result file,
/// `frame id type truncated occluded alpha left top right bottom h w l x y z ry [score]`.
struct TrackedObject {
  int frame = 0;
  int id = 0;  ///< at least 0; -1 for DontCare
  ObjectType type = ObjectType::kCar;
  int truncated = 0;   ///< 0 to 2
  int occluded = 0;    ///< 0 to 2, 3: not known
  double alpha = 0.0;  ///< rad, heading as seen from the camera
  ImageBox image_box;
  Box3 box;            ///< meaningless for DontCare
  double score = 0.0;  ///< of a result only
};

/// One box of a 3D detector: `frame,type,left,top,right,bottom,score,h,w,l,x,y,z,ry[,alpha]` with
/// type 1 (pedestrian), 2 (car) or 3 (cyclist).
struct Detection {
  int frame = 0;
  ObjectType type = ObjectType::kCar;
  ImageBox image_box;
  double score = 0.0;  ///< unbounded; greater means more certain
  Box3 box;
  double alpha = 0.0;  ///< rad; if missing in the file: from ry and the position
};

/// Reads labels, in the order of the file. Empty lines are ignored, here and below. Throws
/// std::runtime_error that names the file, and for a bad line its number, the value and what was
/// expected.
std::vector<TrackedObject> readLabels(const std::string& file);

/// Reads results of a tracker, in the order of the file; each has a score. Throws as readLabels
/// does, and for a second row of the same frame and id.
std::vector<TrackedObject> readResults(const std::string& file);

/// Reads detections, in the order of the file. Throws as readLabels does.
std::vector<Detection> readDetections(const std::string& file);

/// The line of a result, without its end. Six decimals, as in the labels.
std::string resultLine(const TrackedObject& object);

}  // namespace datmo::kitti
