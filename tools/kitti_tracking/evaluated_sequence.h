// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "kitti_tracking/kitti_tracking_files.h"

namespace datmo::kitti {

/// What is evaluated: objects of one class, which are found if the overlap is sufficient.
struct EvaluatedKind {
  ObjectType type = ObjectType::kCar;  ///< car, pedestrian or cyclist
  double min_overlap = 0.25;           ///< 3D, above 0 to 1
};

/// A label of the class, or of a neighbor of it (Van for Car, Person_sitting for Pedestrian).
struct Truth {
  std::size_t trajectory = 0;
  /// Whether it must be found. Neighbors, truncated objects and hardly visible ones are optional.
  bool required = true;
};

/// A result of the class or of a neighbor of it.
struct Track {
  std::size_t trajectory = 0;
  /// Whether it is not a false positive if it matches nothing: a neighbor, one whose image is too
  /// small, one in a DontCare region.
  bool optional = false;
};

/// A truth and a track of one frame, by their indices in it, that overlap sufficiently.
struct Candidate {
  std::size_t truth = 0;
  std::size_t track = 0;
  double overlap = 0.0;  ///< 3D
};

struct EvaluatedFrame {
  std::vector<Truth> truths;
  std::vector<Track> tracks;
  std::vector<Candidate> candidates;
};

/// One sequence as the evaluation of one class and overlap needs it.
struct EvaluatedSequence {
  std::map<int, EvaluatedFrame> frames;  ///< by number; those without objects may be missing
  std::size_t truths = 0;                ///< trajectories
  std::vector<std::size_t> rows;         ///< of each trajectory of the tracker, how many it has
  std::vector<double> scores;            ///< of each trajectory of the tracker: mean of its rows
};

/// The labels and results of one sequence.
struct Sequence {
  std::string name;  ///< "0000"
  std::vector<TrackedObject> labels;
  std::vector<TrackedObject> results;
};

EvaluatedSequence evaluatedSequence(const Sequence& sequence, const EvaluatedKind& kind);

}  // namespace datmo::kitti
