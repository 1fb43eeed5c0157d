// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "evaluate/matching.h"

namespace datmo::evaluation {

/// An object is matched to a different track than last time.
struct IdSwitch {
  std::size_t frame = 0;
  std::uint32_t truth = 0;  ///< ids
  std::uint32_t from = 0;
  std::uint32_t to = 0;
};

/// The CLEAR-MOT metrics (Bernardin and Stiefelhagen, Evaluating multiple object tracking
/// performance: the CLEAR MOT metrics, EURASIP Journal on Image and Video Processing, 2008).
struct ClearMot {
  std::size_t required = 0;         ///< true objects, summed over the frames
  std::size_t matches = 0;          ///< of them, those with a track
  std::size_t misses = 0;           ///< of them, those without
  std::size_t false_positives = 0;  ///< tracks of no object, summed over the frames
  std::vector<IdSwitch> switches;   ///< in order of frames
  std::size_t fragmentations = 0;   ///< an object is missed, and later matched again
  /// 1 - (misses + false positives + id switches) / required, at most 1; none: nothing required.
  std::optional<double> mota;
  /// Mean distance of the matches as the gate measures it, m; none: no match.
  std::optional<double> motp;
  /// Share of the objects that are matched in at least 80 %, and in less than 20 %, of the frames
  /// in which they are required (Milan et al., MOT16, 2016); none: nothing required.
  std::optional<double> mostly_tracked;
  std::optional<double> mostly_lost;
};

/// `matching` is of these frames and options. Frames in which an object is optional are ignored:
/// they neither end a match nor fragment it.
ClearMot scoreClearMot(const Frames& frames, const Matching& matching, const MatchOptions& options);

}  // namespace datmo::evaluation
