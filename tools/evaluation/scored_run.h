#pragma once

#include <cstddef>
#include <vector>

#include "evaluation/matching.h"

namespace datmo::evaluation {

/// What counts in one frame: required truths and tracks that are not neutral, as numbers of the
/// run's objects and tracks, and the pairs of them within the gate.
struct ScoredFrame {
  std::vector<std::size_t> objects;  ///< each at most once
  std::vector<std::size_t> tracks;   ///< each at most once
  std::vector<Candidate> pairs;      ///< indices in the two lists above
};

/// A run as the metrics of whole trajectories need it: ids are numbered from 0 on, by first
/// appearance.
struct ScoredRun {
  std::vector<ScoredFrame> frames;
  std::vector<std::size_t> object_frames;  ///< in how many frames each object is
  std::vector<std::size_t> track_frames;   ///< in how many frames each track is
};

/// `matching` is of these frames and options.
ScoredRun scoredRun(const Frames& frames, const Matching& matching, const MatchOptions& options);

}  // namespace datmo::evaluation
