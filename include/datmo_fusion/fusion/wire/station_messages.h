// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/fusion/earth/local_plane.h"
#include "datmo_fusion/fusion/earth/station_tracks.h"
#include "datmo_fusion/fusion/wire/cpm.h"

namespace datmo {

struct StationMessageOptions {
  int leap_seconds = 5;
  ItsDictionary dictionary = ItsDictionary::k221;
  double position_sigma = 4.0;         ///< m
  double object_position_sigma = 1.0;  ///< m
  double speed_sigma = 1.0;            ///< m/s
  double heading_sigma = 0.17;         ///< rad
  double unknown_speed_sigma = 10.0;   ///< m/s
  double existence = 0.9;              ///< 1

  void visit(OptionVisitor& visitor);
};

/// What a message said, in a plane that touches the earth where its station is.
struct StationMessage {
  LocalPlane plane;
  StationTrackList list;
  std::uint64_t left_out = 0;  ///< objects without number or position
};

/// CAM: the station itself, with id 0, as part 0 of what it tracks; CPM: what it perceives, with
/// its numbers plus one, as the part of its segment's number. Confidences are of 95 %; standard
/// deviations come of them by the normal distribution, and where they are not available of the
/// options. Correlations of a CPM are not used. `now`: a CAM's time is sent modulo 65.536 s.
///
/// Throws WireError: also for a station that does not know where it is (`no_position`), and for one
/// that is no vehicle nor person and says nothing else (`no_track`).
StationMessage decodeStation(std::string_view bytes, Stamp now,
                             const StationMessageOptions& options);

/// A CAM of the track with id 0, which is ourselves, and CPMs of the others, which are few enough
/// for a datagram each. A CPM has each track's whole covariance, which has what we do not know of
/// our own position, and so counts that twice. Tracks farther than 1.3 km are left out.
///
/// `plane`: of the list. `low_frequency`: whether the CAM has that container. Throws WireError
/// (`no_own_position`) where the list does not have ourselves.
std::vector<std::string> encodeStation(const StationTrackList& list, const LocalPlane& plane,
                                       const StationMessageOptions& options, bool low_frequency);

}  // namespace datmo
