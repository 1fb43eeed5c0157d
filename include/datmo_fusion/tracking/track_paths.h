// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <map>

#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// Where the tracks were published of late.
class TrackPaths {
 public:
  /// Adds where the tracks are now, forgets what is older than `seconds` and tracks that are not
  /// published any more, and gives each track its history.
  void extend(TrackList& list, double seconds);

  void clear() { paths_.clear(); }

 private:
  std::map<std::uint32_t, std::deque<PathPoint>> paths_;  ///< by id
};

}  // namespace datmo
