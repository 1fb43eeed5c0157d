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

/// One object as another station has it, in a local plane of east and north.
struct StationTrack {
  std::uint32_t id = 0;                                      ///< of the station
  Point2 position = Point2::Zero();                          ///< m, center of the box
  Point2 velocity = Point2::Zero();                          ///< m/s
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Identity();  ///< of both
  double heading = 0.0;                                      ///< rad, from east to the left
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
  std::uint32_t part = 0;    ///< of what it tracks, where that comes in several lists
  double clock_sigma = 0.0;  ///< s, of the stamp; 0: not known
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
  int probation = 3;
  double forget_after = 5.0;  ///< s
  int max_tracks = 200;
  double serves_for = 0.5;  ///< s
  TrackPredictionOptions prediction;
  TrackComparisonOptions comparison;

  void visit(OptionVisitor& visitor);
};

/// Where the own vehicle is, in the map.
struct OwnVehicle {
  Box2 box;
  Point2 velocity = Point2::Zero();                          ///< m/s
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< m^2, of the position
};

/// What was left out since construction.
struct StationTrackCounts {
  std::uint64_t fast = 0;     ///< faster than max_speed
  std::uint64_t jumped = 0;   ///< not where the last message led to
  std::uint64_t sudden = 0;   ///< new ids of a station whose ids seldom come twice, out of nowhere
  std::uint64_t invalid = 0;  ///< numbers that are none, or a covariance that is none
  std::uint64_t own = 0;      ///< our own vehicle, as others see it
  std::uint64_t many = 0;     ///< beyond max_tracks
  std::uint64_t twice = 0;    ///< of an object that a second station has, too
};

/// Tracks of other stations to tracks in the map.
///
/// The covariance of each is its own, turned, with what is not known of the map's pose on the
/// earth, and of the station's clock: an object at v that is t seconds off is v t elsewhere. That
/// of the acceleration is what objects do.
///
/// A track that is not where its last message led to is left out until several in a row fit
/// together. A new id is taken at its word, but of a station most of whose ids have come but once:
/// there it has to be where one of the station's last tracks led to, or to come again. Else a
/// station that renames its tracks in each message could place objects anywhere. Not thread safe.
class StationTracks {
 public:
  /// Throws OptionError.
  explicit StationTracks(const Checked<StationTrackOptions>& options) : options_(*options) {}

  /// Whether a list is a station's next one of its part: it comes after its last one. An old one
  /// that is sent again is not.
  bool isNew(const StationTrackList& list) const;

  /// `own`: at the list's stamp; none: not known, nothing is taken for it.
  TrackList toMap(const StationTrackList& list, const PoseWithCovariance& map_in_plane,
                  const std::optional<OwnVehicle>& own);

  /// What all stations said last, together, at one time: predicted to it, while their lists serve.
  /// Of an object that several have, the surest track counts.
  TrackList merged(Stamp stamp);

  const StationTrackCounts& counts() const { return counts_; }

  /// Forgets stations and tracks; ids and counts go on.
  void reset();

 private:
  using Key = std::pair<std::uint32_t, std::uint32_t>;  ///< station, and its id or its part

  struct Claim {
    std::uint32_t id = 0;  ///< ours
    Stamp stamp;
    std::uint32_t part = 0;  ///< in which it came last
    StationTrack track;
    int to_prove = 0;        ///< messages that have to fit before it is used
    bool is_sudden = false;  ///< while that is so because it is new
    int messages = 0;
  };

  /// What a station said before a list.
  struct Before {
    bool renames = false;     ///< most of its ids that could have come again came but once
    std::vector<Claim> last;  ///< if so: of its last list of the same part
  };

  bool couldComeAgain(const Claim& claim, const StationTrackList& list) const;
  Before before(const StationTrackList& list) const;
  bool isCredible(const StationTrackList& list, const StationTrack& track, const Before& before);
  bool follows(const Claim& last, Stamp stamp, const StationTrack& track) const;
  /// A credible track with all that is not known of it.
  Track inMap(const StationTrackList& list, const StationTrack& theirs,
              const PoseWithCovariance& map_in_plane) const;
  void forgetOld(Stamp now);

  StationTrackOptions options_;
  StationTrackCounts counts_;
  std::map<Key, TrackList> lists_;  ///< by station and part: what passed of its last one
  std::map<Key, Claim> claims_;     ///< by station and id
  std::uint32_t next_id_ = 1;
};

/// A track of ours as others take it.
StationTrack toStation(const Track& track, const PoseWithCovariance& map_in_plane);

}  // namespace datmo
