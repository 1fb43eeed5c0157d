// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <map>

#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// The recently published poses of the tracks.
class TrackPaths {
 public:
  /// Adds the current poses, drops those older than `seconds` and tracks that are no longer
  /// published, and sets each track's history.
  void extend(TrackList& list, double seconds);

  void clear() { paths_.clear(); }

 private:
  std::map<std::uint32_t, std::deque<PathPoint>> paths_;  ///< by id
};

}  // namespace datmo
