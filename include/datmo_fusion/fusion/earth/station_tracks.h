// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/fusion/track/track_comparison.h"
#include "datmo_fusion/fusion/track/track_prediction.h"
#include "datmo_fusion/tracking/track.h"

namespace datmo {

/// An object tracked by another station, in a local plane (x east, y north).
struct StationTrack {
  std::uint32_t id = 0;                                      ///< assigned by the station
  Point2 position = Point2::Zero();                          ///< m, center of the box
  Point2 velocity = Point2::Zero();                          ///< m/s
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Identity();  ///< of position and velocity
  double heading = 0.0;                                      ///< rad, counterclockwise from east
  double heading_variance = kUnknownHeadingVariance;
  double length = 0.0;  ///< m
  double width = 0.0;   ///< m
  double height = 0.0;  ///< m, 0: not measured
  bool moving = true;
  ClassProbabilities class_probabilities{};
  double existence_probability = 1.0;
};

struct StationTrackList {
  Stamp stamp;
  std::uint32_t station = 0;
  std::uint32_t part = 0;    ///< number of this list if the station splits its tracks into several
  double clock_sigma = 0.0;  ///< s, of the stamp; 0: unknown
  std::vector<StationTrack> tracks;
};

struct StationTrackOptions {
  double max_age = 1.0;             ///< s
  double max_ahead = 0.1;           ///< s
  double max_speed = 50.0;          ///< m/s
  double min_position_sigma = 0.1;  ///< m
  double min_velocity_sigma = 0.1;  ///< m/s
  double clock_sigma = 0.05;        ///< s
  double acceleration_sigma = 2.0;  ///< m/s^2
  double gate = 13.8;               ///< 1
  /// 1 to 100: a track that has jumped is ignored until this many messages in a row are consistent
  int probation = 3;
  /// s, 0.1 to 600: a track that was not reported for longer is a new one
  double forget_after = 5.0;
  int max_tracks = 200;
  /// s, 0 to 5: how long a station's list is predicted while those of others arrive
  double serves_for = 0.5;
  TrackPredictionOptions prediction;
  TrackComparisonOptions comparison;

  void visit(OptionVisitor& visitor);
};

/// State of the own vehicle in the map.
struct OwnVehicle {
  Box2 box;
  Point2 velocity = Point2::Zero();                          ///< m/s
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< m^2, of the position
};

/// Tracks rejected since construction.
struct StationTrackCounts {
  std::uint64_t fast = 0;     ///< faster than max_speed
  std::uint64_t jumped = 0;   ///< outside the gate of the prediction from the last message
  std::uint64_t sudden = 0;   ///< new ids out of nowhere, of a station whose ids seldom repeat
  std::uint64_t invalid = 0;  ///< non-finite values, or an invalid covariance
  std::uint64_t own = 0;      ///< our own vehicle, as perceived by others
  std::uint64_t many = 0;     ///< beyond max_tracks
  std::uint64_t twice = 0;    ///< duplicates of objects that a second station reports
};

/// Converts tracks of other stations to tracks in the map.
///
/// Each covariance is the station's own, rotated, plus the uncertainty of the map's pose on the
/// earth and of the station's clock: an object with speed v and a clock error t is displaced by v
/// t. Acceleration gets the variance of typical objects.
///
/// A track outside the gate of its last message's prediction is rejected until several messages in
/// a row are consistent. A new id is accepted at once, unless most ids of the station have appeared
/// only once: then it must match the prediction of one of the station's last tracks, or appear
/// again. Otherwise a station that renames its tracks in each message could place objects anywhere.
/// Not thread safe.
class StationTracks {
 public:
  /// Throws OptionError.
  explicit StationTracks(const Checked<StationTrackOptions>& options) : options_(*options) {}

  /// Whether a list is newer than the last one of the same station and part. An old list that is
  /// sent again is not.
  bool isNew(const StationTrackList& list) const;

  /// Converts a list. `own`: at the list's stamp; none: unknown, and no track is taken for it.
  TrackList toMap(const StationTrackList& list, const PoseWithCovariance& map_in_plane,
                  const std::optional<OwnVehicle>& own);

  /// Merges the last lists of all stations, predicted to one time, as long as they are valid. If
  /// several stations report an object, the most certain track is kept.
  TrackList merged(Stamp stamp);

  const StationTrackCounts& counts() const { return counts_; }

  /// Forgets stations and tracks; ids and counts continue.
  void reset();

 private:
  using Key = std::pair<std::uint32_t, std::uint32_t>;  ///< station, and its id or its part

  struct Claim {
    std::uint32_t id = 0;  ///< our id
    Stamp stamp;
    std::uint32_t part = 0;  ///< part of its last list
    StationTrack track;
    int to_prove = 0;        ///< consistent messages required before it is used
    bool is_sudden = false;  ///< it must prove itself because it is new
    int messages = 0;
  };

  /// What a station reported before a list.
  struct Before {
    bool renames = false;     ///< most ids that could have reappeared appeared only once
    std::vector<Claim> last;  ///< if so: tracks of its last list of the same part
  };

  bool couldHaveReappeared(const Claim& claim, const StationTrackList& list) const;
  Before before(const StationTrackList& list) const;
  bool isCredible(const StationTrackList& list, const StationTrack& track, const Before& before);
  bool follows(const Claim& last, Stamp stamp, const StationTrack& track) const;
  /// An accepted track with all its uncertainty.
  Track inMap(const StationTrackList& list, const StationTrack& theirs,
              const PoseWithCovariance& map_in_plane) const;
  void forgetOld(Stamp now);

  StationTrackOptions options_;
  StationTrackCounts counts_;
  std::map<Key, TrackList> lists_;  ///< by station and part: accepted tracks of the last list
  std::map<Key, Claim> claims_;     ///< by station and id
  std::uint32_t next_id_ = 1;
};

/// Converts one of our tracks to the form that other stations use.
StationTrack toStation(const Track& track, const PoseWithCovariance& map_in_plane);

}  // namespace datmo
