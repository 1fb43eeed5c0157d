// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/track_paths.h"

#include <utility>

namespace datmo {

void TrackPaths::extend(TrackList& list, double seconds) {
  std::map<std::uint32_t, std::deque<PathPoint>> next;
  for (Track& track : list.tracks) {
    next.insert(paths_.extract(track.id));
    std::deque<PathPoint>& path = next[track.id];
    path.push_back({list.stamp, track.box.center});
    while (secondsBetween(path.front().stamp, list.stamp) > seconds) {
      path.pop_front();
    }
    track.history.assign(path.begin(), path.end());
  }
  paths_ = std::move(next);
}

}  // namespace datmo
