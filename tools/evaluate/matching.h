// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "evaluate/evaluation_data.h"

#include "datmo_fusion/assignment/assignment.h"
#include "datmo_fusion/common/options.h"

namespace datmo::evaluation {

/// To which part of the true object the distance from a track's center is measured.
enum class MatchDistance { kToBox, kToCenter };

/// When a track may belong to a true object.
struct MatchOptions {
  double gate = 2.0;  ///< m
  MatchDistance distance = MatchDistance::kToBox;

  void visit(OptionVisitor& visitor);
};

/// A track and a true object of one frame, by their indices in it, that are close enough.
struct Candidate {
  std::size_t truth = 0;
  std::size_t track = 0;
  double distance = 0.0;  ///< m, at most the gate
};

/// From the track's center to the true object as the options want it, m: to the nearest point of
/// its box (0 inside), or to its center.
double matchDistance(const TrueState& truth, const TrackState& track, const MatchOptions& options);

/// All pairs of a frame within the gate, ordered by truth, then by track.
std::vector<Candidate> candidatesOf(const Frame& frame, const MatchOptions& options);

/// What a track is at one stamp.
enum class Verdict : std::uint8_t {
  kHit,      ///< matched to a required truth
  kNeutral,  ///< not a hit, but within the gate of an optional truth: excluded from all metrics
  kFalse,    ///< neither
};

/// The assignment of tracks to true objects in one frame.
struct FrameMatching {
  std::vector<Candidate> candidates;  ///< all pairs within the gate
  std::vector<int> track_of_truth;    ///< index in Frame::tracks, kUnassigned: none
  std::vector<Verdict> verdicts;      ///< of each track of the frame

  std::size_t falseTracks() const;
};

/// One for each frame.
using Matching = std::vector<FrameMatching>;

/// Gives each true object at most one track, and each track at most one true object, within the
/// gate (mapping procedure of Bernardin and Stiefelhagen 2008). In each frame, pairs of a truth and
/// a track that were last matched to each other are kept first (also over a gap); of the rest, as
/// many pairs as possible are matched, with the smallest sum of distances. If sums are equal, the
/// earlier track is used. Required truths are matched before optional ones.
Matching matchFrames(const Frames& frames, const MatchOptions& options);

/// Calls `use(truth, track)` for each match of a required truth in a frame.
template <typename Use>
void forEachHit(const Frame& frame, const FrameMatching& matching, const Use& use) {
  for (std::size_t truth = 0; truth < frame.truths.size(); ++truth) {
    const int track = matching.track_of_truth[truth];
    if (frame.truths[truth].duty == Duty::kRequired && track != kUnassigned) {
      use(frame.truths[truth], frame.tracks[static_cast<std::size_t>(track)]);
    }
  }
}

}  // namespace datmo::evaluation
