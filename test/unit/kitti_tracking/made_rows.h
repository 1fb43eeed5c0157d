// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kitti_tracking/kitti_tracking_files.h"

namespace datmo::kitti {

/// A cube of 1 m that is placed at y = 0, with an image high enough to count.
inline TrackedObject rowAt(int frame, int id, double x, ObjectType type = ObjectType::kCar) {
  TrackedObject row;
  row.frame = frame;
  row.id = id;
  row.type = type;
  row.image_box = {100.0, 100.0, 200.0, 200.0};
  row.box.x = x;
  row.box.length = row.box.width = row.box.height = 1.0;
  return row;
}

/// The same as a result.
inline TrackedObject resultAt(int frame, int id, double x, double score = 1.0) {
  TrackedObject row = rowAt(frame, id, x);
  row.score = score;
  return row;
}

inline TrackedObject dontCare(int frame, const ImageBox& region) {
  TrackedObject row;
  row.frame = frame;
  row.id = -1;
  row.type = ObjectType::kDontCare;
  row.image_box = region;
  return row;
}

}  // namespace datmo::kitti
