// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/earth/station_tracks.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string>

#include <Eigen/LU>

#include "datmo_fusion/common/covariance_check.h"
#include "datmo_fusion/common/physical_bounds.h"
#include "datmo_fusion/common/square.h"
#include "datmo_fusion/tracking/track_check.h"

namespace datmo {

namespace {

double squaredDistance(const Point2& difference, const Eigen::Matrix2d& covariance) {
  return difference.dot(covariance.inverse() * difference);
}

/// An object that is certainly not a vehicle cannot be ours.
bool mayBeVehicle(const ClassProbabilities& classes) {
  const ObjectClass object_class = mostLikelyClass(classes);
  return object_class == ObjectClass::kVehicle || object_class == ObjectClass::kUnknown;
}

/// Whether a track is the own vehicle: its center is within the vehicle's outline and both
/// uncertainties, and its speed agrees.
bool isOwn(const Track& track, const OwnVehicle& own, double gate) {
  if (!mayBeVehicle(track.class_probabilities)) {
    return false;
  }
  const Pose2& pose = own.box.center;
  Eigen::Vector2d half(0.5 * own.box.length, 0.5 * own.box.width);
  const Eigen::Matrix2d outline =  // of a point anywhere in the vehicle
      pose.rotation() * (half.array().square() / 3.0).matrix().asDiagonal() *
      pose.rotation().transpose();
  const Eigen::Matrix2d position =
      track.covariance.topLeftCorner<2, 2>() + own.covariance + outline;
  const Eigen::Matrix2d velocity =
      track.covariance.block<2, 2>(2, 2) + Eigen::Matrix2d::Identity();  // (1 m/s)^2 for ours
  return squaredDistance(track.box.center.position() - pose.position(), position) <= gate &&
         squaredDistance(track.state.segment<2>(2) - own.velocity, velocity) <= gate;
}

}  // namespace

void StationTrackOptions::visit(OptionVisitor& visitor) {
  visitor.number({"max_age", "s", "a list that is older on arrival is dropped"}, max_age,
                 {0.05, 60.0});
  visitor.number({"max_ahead", "s",
                  "a list with a stamp farther in the future is dropped: its clock is wrong"},
                 max_ahead, {0.0, 60.0});
  visitor.number({"max_speed", "m/s", "a faster track is dropped"}, max_speed, {1.0, 200.0});
  visitor.number({"min_position_sigma", "m", "minimum standard deviation of a track's position"},
                 min_position_sigma, {0.001, 10.0});
  visitor.number({"min_velocity_sigma", "m/s", "minimum standard deviation of a track's velocity"},
                 min_velocity_sigma, {0.001, 10.0});
  visitor.number(
      {"clock_sigma", "s", "standard deviation of the clock of a station that does not report it"},
      clock_sigma, {0.0, 10.0});
  visitor.number({"acceleration_sigma", "m/s^2",
                  "standard deviation of objects' acceleration, along each axis"},
                 acceleration_sigma, {0.1, 50.0});
  visitor.number({"gate", "1",
                  "squared Mahalanobis distance from the prediction from its last message above "
                  "which a track has jumped, and within which a track is our own vehicle; "
                  "chi-square with two degrees of freedom, 99.9 %"},
                 gate, {1.0, 1000.0});
  visitor.integer(
      {"max_tracks", "", "maximum number of tracks of one list; the others are dropped"},
      max_tracks, {1.0, 10000.0});
  visitor.group("prediction", [&] { prediction.visit(visitor); });
  visitor.group("comparison", [&] { comparison.visit(visitor); });
}

void StationTracks::reset() {
  lists_.clear();
  claims_.clear();
}

bool StationTracks::isNew(const StationTrackList& list) const {
  const auto known = lists_.find({list.station, list.part});
  return known == lists_.end() || known->second.stamp < list.stamp;
}

/// False if its part has not been received since: other parts of a message do not show that it is
/// gone. A part that has expired is assumed to have been received without it, otherwise a station
/// could declare each of its lists another part.
bool StationTracks::couldHaveReappeared(const Claim& claim, const StationTrackList& list) const {
  const auto last_list = lists_.find({list.station, claim.part});
  return claim.part == list.part ||
         (last_list != lists_.end() && claim.stamp < last_list->second.stamp) ||
         secondsBetween(claim.stamp, list.stamp) > options_.serves_for;
}

StationTracks::Before StationTracks::before(const StationTrackList& list) const {
  const auto begin = claims_.lower_bound({list.station, 0});
  const auto end = std::find_if(begin, claims_.end(), [&list](const auto& claim) {
    return claim.first.first != list.station;
  });
  std::set<std::uint32_t> listed;
  for (const StationTrack& track : list.tracks) {
    listed.insert(track.id);
  }
  int once = 0;
  int again = 0;
  for (auto claim = begin; claim != end; ++claim) {
    if (claim->second.messages > 1 || listed.count(claim->first.second) > 0) {
      ++again;
    } else if (couldHaveReappeared(claim->second, list)) {
      ++once;
    }
  }
  Before before;
  before.renames = once >= options_.probation && once > again;
  const auto last_list = lists_.find({list.station, list.part});
  if (before.renames && last_list != lists_.end()) {
    for (auto claim = begin; claim != end; ++claim) {
      if (claim->second.stamp == last_list->second.stamp) {
        before.last.push_back(claim->second);
      }
    }
  }
  return before;
}

bool StationTracks::isCredible(const StationTrackList& list, const StationTrack& track,
                               const Before& before) {
  const bool is_valid = isWithin(track.position, kMaxCoordinate) && track.velocity.allFinite() &&
                        isWithin(track.covariance, kMaxCoordinate * kMaxCoordinate) &&
                        isCovariance(track.covariance);
  counts_.invalid += is_valid ? 0 : 1;
  if (!is_valid) {
    return false;
  }
  const auto [entry, is_first] = claims_.try_emplace({list.station, track.id});
  Claim& claim = entry->second;
  if (is_first) {
    claim.id = next_id_++;
    claim.is_sudden = before.renames &&
                      std::none_of(before.last.begin(), before.last.end(), [&](const Claim& last) {
                        return last.to_prove == 0 && follows(last, list.stamp, track);
                      });
    claim.to_prove = claim.is_sudden ? 1 : 0;
  } else if (!follows(claim, list.stamp, track)) {
    claim.to_prove = options_.probation;
    claim.is_sudden = false;
  } else {
    claim.to_prove = std::max(0, claim.to_prove - 1);
  }
  ++claim.messages;
  claim.stamp = list.stamp;
  claim.part = list.part;
  claim.track = track;
  if (claim.to_prove > 0) {
    ++(claim.is_sudden ? counts_.sudden : counts_.jumped);
  }
  const bool is_fast = track.velocity.norm() > options_.max_speed;
  counts_.fast += is_fast ? 1 : 0;
  return claim.to_prove == 0 && !is_fast;
}

bool StationTracks::follows(const Claim& last, Stamp stamp, const StationTrack& track) const {
  const double seconds = secondsBetween(last.stamp, stamp);
  const double sway = 0.5 * options_.acceleration_sigma * seconds * seconds;
  const double late = options_.clock_sigma * last.track.velocity.norm();
  const Eigen::Matrix2d covariance =
      last.track.covariance.topLeftCorner<2, 2>() + track.covariance.topLeftCorner<2, 2>() +
      square(seconds) * last.track.covariance.bottomRightCorner<2, 2>() +
      (square(sway) + square(late) + square(options_.min_position_sigma)) *
          Eigen::Matrix2d::Identity();
  const Point2 expected = last.track.position + seconds * last.track.velocity;
  return squaredDistance(track.position - expected, covariance) <= options_.gate;
}

void StationTracks::forgetOld(Stamp now) {
  for (auto claim = claims_.begin(); claim != claims_.end();) {
    const bool is_old = secondsBetween(claim->second.stamp, now) > options_.forget_after;
    claim = is_old ? claims_.erase(claim) : std::next(claim);
  }
  for (auto list = lists_.begin(); list != lists_.end();) {
    const bool is_old = secondsBetween(list->second.stamp, now) > options_.forget_after;
    list = is_old ? lists_.erase(list) : std::next(list);
  }
}

TrackList StationTracks::toMap(const StationTrackList& list, const PoseWithCovariance& map_in_plane,
                               const std::optional<OwnVehicle>& own) {
  forgetOld(list.stamp);
  TrackList result;
  result.stamp = list.stamp;
  const Before before = this->before(list);
  for (std::size_t i = 0; i < list.tracks.size(); ++i) {
    if (i >= static_cast<std::size_t>(options_.max_tracks)) {
      counts_.many += list.tracks.size() - i;
      break;
    }
    const StationTrack& theirs = list.tracks[i];
    if (!isCredible(list, theirs, before)) {
      continue;
    }
    const Track track = inMap(list, theirs, map_in_plane);
    if (!isValid(track)) {
      ++counts_.invalid;
    } else if (own && isOwn(track, *own, options_.gate)) {
      ++counts_.own;
    } else {
      result.tracks.push_back(track);
    }
  }
  std::sort(result.tracks.begin(), result.tracks.end(),
            [](const Track& a, const Track& b) { return a.id < b.id; });
  result.tracks.erase(std::unique(result.tracks.begin(), result.tracks.end(),
                                  [](const Track& a, const Track& b) { return a.id == b.id; }),
                      result.tracks.end());
  lists_[{list.station, list.part}] = result;
  return result;
}

TrackList StationTracks::merged(Stamp stamp) {
  struct Candidate {
    std::uint32_t station = 0;
    Track track;
  };
  std::vector<Candidate> candidates;
  for (const auto& [key, list] : lists_) {
    const double seconds = secondsBetween(list.stamp, stamp);
    if (std::abs(seconds) <= options_.serves_for) {
      for (const Track& track : list.tracks) {
        candidates.push_back({key.first, predicted(track, seconds, options_.prediction)});
      }
    }
  }
  const auto uncertainty = [](const Candidate& one) {
    return one.track.covariance.topLeftCorner<2, 2>().trace();
  };
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](const auto& a, const auto& b) { return uncertainty(a) < uncertainty(b); });
  std::vector<Candidate> kept;
  for (const Candidate& one : candidates) {
    const bool is_known = std::any_of(kept.begin(), kept.end(), [&](const Candidate& other) {
      // A track that moved to another part of its station's list is in both for a while.
      return other.station == one.station
                 ? other.track.id == one.track.id
                 : compare(other.track, one.track, options_.comparison).log_likelihood_ratio > 0.0;
    });
    counts_.twice += is_known ? 1 : 0;
    if (!is_known) {
      kept.push_back(one);
    }
  }
  TrackList result;
  result.stamp = stamp;
  std::transform(kept.begin(), kept.end(), std::back_inserter(result.tracks),
                 [](const Candidate& one) { return one.track; });
  std::sort(result.tracks.begin(), result.tracks.end(),
            [](const Track& a, const Track& b) { return a.id < b.id; });
  return result;
}

}  // namespace datmo
