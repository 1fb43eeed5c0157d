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

/// From a track's center to what of the true object.
enum class MatchDistance { kToBox, kToCenter };

/// When a track may be of a true object.
struct MatchOptions {
  double gate = 2.0;  ///< m
  MatchDistance distance = MatchDistance::kToBox;

  void visit(OptionVisitor& visitor);
};

/// A track and a true object of one frame, by their indices in it, that are near enough.
struct Candidate {
  std::size_t truth = 0;
  std::size_t track = 0;
  double distance = 0.0;  ///< m, at most the gate
};

/// From the track's center to the true object as the options want it, m: to the nearest point of
/// its box (0 inside), or to its center.
double matchDistance(const TrueState& truth, const TrackState& track, const MatchOptions& options);

/// All pairs of a frame within the gate, by rising truth, then rising track.
std::vector<Candidate> candidatesOf(const Frame& frame, const MatchOptions& options);

/// What a track is at one stamp.
enum class Verdict : std::uint8_t {
  kHit,      ///< matched to a required truth
  kNeutral,  ///< within the gate of an optional truth, and no hit: left out of every metric
  kFalse,    ///< neither
};

/// Who is whom in one frame.
struct FrameMatching {
  std::vector<Candidate> candidates;  ///< all pairs within the gate
  std::vector<int> track_of_truth;    ///< index in Frame::tracks, kUnassigned: none
  std::vector<Verdict> verdicts;      ///< of each track of the frame

  std::size_t falseTracks() const;
};

/// One for each frame.
using Matching = std::vector<FrameMatching>;

/// Gives each true object at most one track, and each track at most one true object, within the
/// gate (mapping procedure of Bernardin and Stiefelhagen 2008). In each frame first come the pairs
/// of a truth and a track that were last matched to each other (over a gap as well); of what is
/// left, as many pairs as possible, and of these the least sum of distances. Equal sums: the
/// earlier track. Required truths take their tracks before optional ones do.
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
