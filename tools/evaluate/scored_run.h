// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "evaluate/matching.h"

namespace datmo::evaluation {

/// An object and a track that were within the gate of each other at least once, by their numbers in
/// the run.
struct Encounter {
  std::size_t object = 0;
  std::size_t track = 0;
};

/// An encounter in one frame.
struct ScoredPair {
  std::size_t encounter = 0;  ///< index in ScoredRun::encounters
  Candidate candidate;        ///< the two, by their indices in the frame
};

/// The data of a run that the metrics of whole trajectories need: its required truths (the objects)
/// and its tracks that are not neutral, numbered from 0 on by first appearance.
struct ScoredRun {
  std::vector<std::vector<ScoredPair>> frames;  ///< all pairs within the gate, of each frame
  std::vector<Encounter> encounters;            ///< each object and track once
  std::vector<std::size_t> object_frames;       ///< in how many frames each object is
  std::vector<std::size_t> track_frames;        ///< in how many frames each track is

  /// Objects, and tracks, summed over the frames.
  double required() const;
  double published() const;
};

/// `matching` is of these frames.
ScoredRun scoredRun(const Frames& frames, const Matching& matching);

}  // namespace datmo::evaluation
