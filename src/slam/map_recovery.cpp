// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/map_recovery.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "datmo_fusion/common/square.h"
#include "datmo_fusion/slam/pose_covariance.h"

namespace datmo {

namespace {

/// Two searches agree if their poses are this close to each other (m, rad).
constexpr double kSamePosition = 0.8;
constexpr double kSameHeading = degrees(4.0);

/// Standard deviations for a vehicle that was carried elsewhere (m, rad): farther than a map's
/// window reaches, and uniform in heading.
constexpr double kKidnappedSigma = 100.0;
constexpr double kKidnappedHeadingSigma = kPi / 1.7320508075688772;

/// s; maximum time for which boxes are due: no scan waits for more, and none are due for a gap.
constexpr double kMaxInterval = 0.5;

}  // namespace

void MapRecoveryOptions::visit(OptionVisitor& visitor) {
  visitor.number({"first_search_after", "s",
                  "how long the new map needs to learn what is stationary (map/static_after) and "
                  "what is free"},
                 first_search_after, {0.0, 60.0});
  visitor.number({"search_period", "s", "time between two searches"}, search_period, {0.0, 60.0});
  visitor.number({"give_up_after", "s", "after this time the new map becomes the map"},
                 give_up_after, {0.0, 3600.0});
  visitor.number(
      {"lost_from_sigma", "m", "standard deviation of the position above which no search is made"},
      lost_from_sigma, {0.01, 1000.0});
  visitor.number({"min_kidnapped_log_ratio", "1",
                  "log-likelihood ratio of a scan having been taken elsewhere, above which the "
                  "vehicle may have been kidnapped (5: 'very strong' evidence, Kass & Raftery "
                  "1995); 1000: never"},
                 min_kidnapped_log_ratio, {1.0, 1000.0});
  visitor.number({"kidnapped_after", "s",
                  "the vehicle has been kidnapped if for this long no scan fits its former place "
                  "better; pitching at a bump, or when braking, is over sooner"},
                 kidnapped_after, {0.0, 60.0});
  visitor.integer({"boxes_per_second", "1/s",
                   "boxes of poses that a search examines for each second since the last scan, of "
                   "which at most 0.5 s count; a box takes about 1.5 us"},
                  boxes_per_second, {1, 100000000});
  visitor.group("search", [&] { search.visit(visitor); });
  visitor.integer(
      {"prior_boxes_per_second", "1/s", "recovery/boxes_per_second of a search in a prior map"},
      prior_boxes_per_second, {1, 100000000});
  visitor.number({"confirmed_after", "m",
                  "a pose found in a prior map is accepted when it is found again after this "
                  "distance, or after a turn"},
                 confirmed_after, {0.0, 1000.0});
  visitor.group("prior_search", [&] { prior_search.visit(visitor); });
}

PoseWithCovariance anywhereAbout(PoseWithCovariance pose) {
  pose.covariance += Eigen::Vector3d(square(kKidnappedSigma), square(kKidnappedSigma),
                                     square(kKidnappedHeadingSigma))
                         .asDiagonal();
  return pose;
}

bool grewWider(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to,
               const MapRecoveryOptions& limits) {
  return maxPositionVariance(to) - maxPositionVariance(from) >
             std::pow(limits.from_position_sigma, 2) ||
         to(2, 2) - from(2, 2) > std::pow(limits.from_heading_sigma, 2);
}

MapRecovery::MapRecovery(const Checked<MapRecoveryOptions>& options, OccupancyMap older,
                         const PoseWithCovariance& start, Stamp stamp)
    : options_(*options),
      older_(std::move(older)),
      start_(start),
      begun_(stamp),
      next_search_(stamp + options->first_search_after),
      advanced_(stamp) {
  is_searchable_ = std::sqrt(maxPositionVariance(start.covariance)) <= options_.lost_from_sigma;
  state_ = is_searchable_ ? Localization::kUncertain : Localization::kLost;
}

MapRecovery::MapRecovery(const Checked<MapRecoveryOptions>& options, OccupancyMap prior_map,
                         const SearchRegion& region, Stamp stamp)
    : options_(*options),
      older_(std::move(prior_map)),
      start_(priorOf(region, older_.window())),
      begun_(stamp),
      next_search_(stamp + options->first_search_after),
      advanced_(stamp),
      state_(region.anywhere ? Localization::kLost : Localization::kUncertain),
      region_(region) {}

MapRecovery MapRecovery::afterKidnapping(const Checked<MapRecoveryOptions>& options,
                                         OccupancyMap older, const PoseWithCovariance& pose,
                                         Stamp stamp) {
  MapRecovery recovery(options, std::move(older), anywhereAbout(pose), stamp);
  recovery.is_kidnapped_ = true;
  recovery.is_searchable_ = true;  // all of the map is searched
  return recovery;
}

PoseWithCovariance MapRecovery::inOlder(const PoseWithCovariance& in_newer) const {
  const Point2 arm = in_newer.pose.position() - start_.pose.position();
  return {in_newer.pose, in_newer.covariance + withLeverArm(start_.covariance, arm)};
}

void MapRecovery::beginSearch(const OccupancyMap& newer, const PoseWithCovariance& in_newer,
                              Stamp stamp) {
  searched_from_ = in_newer.pose;
  if (!searched_) {
    searched_ = std::make_shared<const SearchedMap>(older_);
  }
  search_.emplace(searchesCompleteMap() ? options_.prior_search : options_.search, searched_, newer,
                  regionOf(in_newer), in_newer.pose);
  next_search_ = stamp + options_.search_period;
}

SearchRegion MapRecovery::regionOf(const PoseWithCovariance& in_newer) const {
  return {inOlder(in_newer), searchesAnywhere()};
}

bool MapRecovery::agreesWithCandidate(const Pose2& in_older) const {
  const Pose2 since = candidate_->in_newer.inverse() * searched_from_;
  const Pose2 expected = candidate_->in_older * since;
  return (expected.position() - in_older.position()).norm() <= kSamePosition &&
         std::abs(angleBetween(expected.heading(), in_older.heading())) <= kSameHeading;
}

bool MapRecovery::confirms(const Pose2& found) {
  if (!searchesCompleteMap()) {
    return true;
  }
  if (candidate_ && agreesWithCandidate(found)) {
    const Pose2 since = candidate_->in_newer.inverse() * searched_from_;
    return since.position().norm() >= options_.confirmed_after ||
           std::abs(since.heading()) >= options_.confirmed_after_turn;
  }
  candidate_ = Candidate{found, searched_from_};
  return false;
}

int MapRecovery::boxesUntil(Stamp stamp) {
  const double seconds = std::clamp(secondsBetween(advanced_, stamp), 0.0, kMaxInterval);
  advanced_ = stamp;
  return 1 + static_cast<int>(seconds * (searchesCompleteMap() ? options_.prior_boxes_per_second
                                                               : options_.boxes_per_second));
}

std::optional<Relocalization> MapRecovery::advance(const OccupancyMap& newer,
                                                   const PoseWithCovariance& in_newer,
                                                   Stamp stamp) {
  const int boxes = boxesUntil(stamp);
  if (!search_ && is_searchable_ && next_search_ <= stamp) {
    beginSearch(newer, in_newer, stamp);
  }
  if (!search_) {
    return std::nullopt;
  }
  const MapSearch::Outcome outcome = search_->advance(boxes);
  if (outcome == MapSearch::Outcome::kUnfinished) {
    return std::nullopt;
  }
  std::optional<Relocalization> found = conclude(outcome, in_newer.pose);
  const bool is_lost = outcome == MapSearch::Outcome::kNone || searchesAnywhere();
  state_ = is_lost ? Localization::kLost : Localization::kUncertain;
  search_.reset();
  return found;
}

std::optional<Relocalization> MapRecovery::conclude(MapSearch::Outcome outcome,
                                                    const Pose2& in_newer) {
  const bool is_unique = outcome == MapSearch::Outcome::kFound;
  if (!is_unique && outcome != MapSearch::Outcome::kAligned) {
    doubtCandidate(outcome);
    return std::nullopt;
  }
  const PoseWithCovariance then = is_unique ? search_->found() : search_->aligned();
  if (is_unique && !confirms(then.pose)) {
    return std::nullopt;
  }
  // The vehicle has moved since the search began.
  const Pose2 now = then.pose * (searched_from_.inverse() * in_newer);
  const Point2 arm = now.position() - then.pose.position();
  return Relocalization{{now, withLeverArm(then.covariance, arm)}, is_unique};
}

void MapRecovery::doubtCandidate(MapSearch::Outcome outcome) {
  if (!candidate_) {
    return;
  }
  // Other poses that fit nearly as well do not refute it; one that fits better does.
  const std::optional<Pose2> likeliest = search_->likeliest();
  if (outcome == MapSearch::Outcome::kNone || (likeliest && !agreesWithCandidate(*likeliest))) {
    candidate_.reset();
  }
}

}  // namespace datmo
