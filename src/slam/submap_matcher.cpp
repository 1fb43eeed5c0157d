// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/submap_matcher.h"

#include <memory>

#include "datmo_fusion/common/random.h"
#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// Boxes of poses per call of the search, which is repeated until it has an answer.
constexpr int kBoxes = 10000;

/// Standard deviations by which a match may differ from the search result.
constexpr double kMaxCorrection = 3.0;

constexpr std::uint64_t kSeed = 1;

}  // namespace

SubmapMatcherOptions::SubmapMatcherOptions() : search(MapSearchOptions::inCompleteMap()) {
  search.max_boxes = 1000000;
  match.information_share = 0.1;  // beam ends on one surface, at successive poses
}

void SubmapMatcherOptions::visit(OptionVisitor& visitor) {
  visitor.group(
      "map", [&] { map.visit(visitor); }, Tier::kExpert);
  visitor.group(
      "search", [&] { search.visit(visitor); }, Tier::kExpert);
  visitor.group(
      "matcher", [&] { match.visit(visitor); }, Tier::kExpert);
  visitor.number({"max_step", "m", "neighboring end points this close lie on one surface"},
                 max_step, {0.01, 100.0});
  visitor.number(
      {"position_sigma", "m",
       "minimum standard deviation of a loop: by how much both submaps are distorted themselves"},
      position_sigma, {0.001, 10.0});
  visitor.number({"heading_sigma", "rad", "the same for the heading"}, heading_sigma,
                 {0.0001, 1.0});
}

SubmapMatcher::SubmapMatcher(const Checked<SubmapMatcherOptions>& options)
    : options_(*options), matcher_(options->match) {}

SubmapMatcher::Result SubmapMatcher::match(const Submap& older, const Submap& newer,
                                           const PoseWithCovariance& prior) const {
  const double reach = options_.search.reach;
  const OccupancyMap older_map = older.map(options_.map, reach);
  const OccupancyMap newer_map = newer.map(options_.map, reach);
  MapSearch search(options_.search, std::make_shared<const SearchedMap>(older_map), newer_map,
                   {prior, false}, Pose2());
  MapSearch::Outcome outcome = MapSearch::Outcome::kUnfinished;
  while (outcome == MapSearch::Outcome::kUnfinished) {
    outcome = search.advance(kBoxes);
  }
  if (outcome != MapSearch::Outcome::kFound) {
    return {outcome == MapSearch::Outcome::kNone ? Outcome::kNone : Outcome::kAmbiguous, {}};
  }
  return refined(older_map, newer, search.found());
}

SubmapMatcher::Result SubmapMatcher::refined(const OccupancyMap& older, const Submap& newer,
                                             const PoseWithCovariance& found) const {
  Random random(kSeed);
  const MatchResult match =
      matcher_.match(older, newer.ends(options_.max_step), {found, true}, random);
  const Pose2 correction = found.pose.inverse() * match.pose.pose;
  const bool stays =
      correction.position().squaredNorm() <=
          square(kMaxCorrection) * found.covariance.topLeftCorner<2, 2>().trace() &&
      square(correction.heading()) <= square(kMaxCorrection) * found.covariance(2, 2);
  if (!match.quality.accepted || match.quality.degenerate || !stays) {
    return {Outcome::kNoMatch, {}};
  }
  Result result{Outcome::kFound, match.pose};
  result.newer_in_older.covariance +=
      Eigen::Vector3d(square(options_.position_sigma), square(options_.position_sigma),
                      square(options_.heading_sigma))
          .asDiagonal();
  return result;
}

}  // namespace datmo
