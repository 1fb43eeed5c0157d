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

/// The content of a message, in a plane tangent to the earth at its station.
struct StationMessage {
  LocalPlane plane;
  StationTrackList list;
  std::uint64_t left_out = 0;  ///< objects without id or position
};

/// Decodes a CAM (the station itself, with id 0, as part 0 of its tracks) or a CPM (what it
/// perceives, with its ids plus one, as the part with its segment's number). Confidences are 95 %;
/// standard deviations follow from them by the normal distribution, or from the options if not
/// available. Correlations of a CPM are ignored. `now` resolves a CAM's time, which is sent modulo
/// 65.536 s.
///
/// Throws WireError, also for a station that does not know its position (`no_position`), and for
/// one that is neither vehicle nor person and reports nothing else (`no_track`).
StationMessage decodeStation(std::string_view bytes, Stamp now,
                             const StationMessageOptions& options);

/// Encodes the track with id 0, which is ourselves, as a CAM and the others as CPMs, each small
/// enough for a datagram. A CPM has each track's whole covariance, which includes the uncertainty
/// of our own position and so counts it twice. Tracks farther than 1.3 km are left out.
///
/// `plane`: of the list. `low_frequency`: whether the CAM has that container. Throws WireError
/// (`no_own_position`) if the list does not contain ourselves.
std::vector<std::string> encodeStation(const StationTrackList& list, const LocalPlane& plane,
                                       const StationMessageOptions& options, bool low_frequency);

}  // namespace datmo
