// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/map_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>

namespace datmo {

namespace {

/// Standard deviations of the prior within which poses are searched.
constexpr double kGate = 3.5;

/// A box no larger than this (m, rad) is not split further.
constexpr double kLeafPosition = 0.15;
constexpr double kLeafHeading = degrees(0.6);

/// If missing surfaces distinguish hypotheses, a box's center must represent the whole box, so
/// boxes are split down to this fraction.
constexpr double kFineLeaf = 0.5;

/// Hypotheses this close to the best one (m, rad) are the same one: a match converges from there,
/// also one with a map that has just started and holds little.
constexpr double kSameHypothesisPosition = 1.5;
constexpr double kSameHypothesisHeading = degrees(5.0);
constexpr double kSameHypothesisHeadingAtStart = degrees(12.0);

/// Error not covered by the prior: that of the older map itself (m, rad).
constexpr double kMapSigma = 0.3;
constexpr double kMapHeadingSigma = degrees(1.0);

/// Maximum number of surfaces compared, and the same if a whole map is searched.
constexpr std::size_t kMaxSurfaces = 250;
constexpr std::size_t kMaxSurfacesOfAll = 4000;

constexpr double kAllOfIt = std::numeric_limits<double>::infinity();

/// Two maps agree on a surface in cells that are at most neighbors; in a complete map, not finer
/// than a box that is not split further.
constexpr double kToleranceCells = 1.5;
constexpr double kMinTolerance = 0.2;  // m

}  // namespace

MapSearch::Surfaces MapSearch::thinnedOut(const std::vector<Point2>& positions,
                                          const Circle& within, std::size_t max) {
  std::vector<Surface> near;
  for (const Point2& position : positions) {
    const double distance = (position - within.center).norm();
    if (distance <= within.radius) {
      near.push_back({position, distance});
    }
  }
  Surfaces surfaces;
  const std::size_t kept = std::min(near.size(), max);
  for (std::size_t i = 0; i < kept; ++i) {
    surfaces.all.push_back(near[i * near.size() / kept]);
  }
  surfaces.weight = kept == 0 ? 0.0 : static_cast<double>(near.size()) / static_cast<double>(kept);
  return surfaces;
}

MapSearch::MapSearch(const Checked<MapSearchOptions>& options,
                     std::shared_ptr<const SearchedMap> older, const OccupancyMap& newer,
                     const SearchRegion& region, const Pose2& in_newer)
    : options_(*options),
      older_map_(std::move(older)),
      newer_free_(freeSpaceOf(newer)),
      prior_(priorOf(region, older_map_->window())),
      anywhere_(region.anywhere),
      in_newer_(in_newer),
      leaf_half_size_((options->missing_share > 0.0 ? kFineLeaf : 1.0) *
                      Eigen::Vector3d(kLeafPosition, kLeafPosition, kLeafHeading)),
      tolerance_(std::max(options->missing_share > 0.0 ? kMinTolerance : 0.0,
                          kToleranceCells * older_map_->window().cell_size)),
      older_(anywhere_ ? thinnedOut(older_map_->surfaces(), {prior_.pose.position(), kAllOfIt},
                                    kMaxSurfacesOfAll)
                       : thinnedOut(older_map_->surfaces(),
                                    {prior_.pose.position(), options->reach}, kMaxSurfaces)) {
  const Surfaces seen =
      thinnedOut(newer.staticSurfaces(), {in_newer.position(), options->reach}, kMaxSurfaces);
  newer_weight_ = seen.weight;
  const Pose2 from_newer = in_newer.inverse();
  for (const Surface& surface : seen.all) {
    const double cell_size = older_map_->window().cell_size;
    newer_.push_back({((from_newer * surface.position) / cell_size).cast<float>(),
                      static_cast<float>(surface.distance / cell_size)});
  }
  if (newer_weight_ * static_cast<double>(newer_.size()) < options->min_surfaces) {
    outcome_ = Outcome::kAmbiguous;
    return;
  }
  open(anywhere_ ? wholeWindow(older_map_->window()) : withinPrior());
}

MapSearch::Box MapSearch::withinPrior() {
  prior_.covariance += Eigen::Vector3d(kMapSigma * kMapSigma, kMapSigma * kMapSigma,
                                       kMapHeadingSigma * kMapHeadingSigma)
                           .asDiagonal();
  whitening_ = prior_.covariance.llt().matrixL().solve(Eigen::Matrix3d::Identity());
  Box all;
  all.half = kGate * prior_.covariance.diagonal().cwiseSqrt();
  all.half[2] = std::min(all.half[2], kPi);
  return all;
}

MapSearch::Box MapSearch::wholeWindow(const GridWindow& window) {
  Box all;
  all.half = {0.5 * window.cell_size * window.columns, 0.5 * window.cell_size * window.rows, kPi};
  return all;
}

Pose2 MapSearch::poseOf(const Box& box) const {
  return {prior_.pose.x() + box.offset[0], prior_.pose.y() + box.offset[1],
          prior_.pose.heading() + box.offset[2]};
}

void MapSearch::open(Box box) {
  ++evaluated_boxes_;
  evaluate(box);
  if (leaves_.empty() || box.cost <= leaves_.front().cost + options_.max_log_ratio) {
    open_.push(box);
  }
}

void MapSearch::split(const Box& box) {
  int axis = 0;
  box.half.cwiseQuotient(leaf_half_size_).maxCoeff(&axis);
  for (const double side : {-0.5, 0.5}) {
    Box part = box;
    part.half[axis] *= 0.5;
    part.offset[axis] += side * box.half[axis];
    open(part);
  }
}

bool MapSearch::isLeaf(const Box& box) const {
  return (box.half.array() <= leaf_half_size_.array()).all();
}

Eigen::Vector3d MapSearch::between(const Box& from, const Box& to) {
  Eigen::Vector3d apart = to.offset - from.offset;
  apart[2] = angleBetween(from.offset[2], to.offset[2]);
  return apart;
}

bool MapSearch::isSameHypothesis(const Box& leaf) const {
  const Eigen::Vector3d apart = between(leaves_.front(), leaf);
  const double max_turn =
      options_.missing_share > 0.0 ? kSameHypothesisHeadingAtStart : kSameHypothesisHeading;
  return apart.head<2>().norm() <= kSameHypothesisPosition && std::abs(apart[2]) <= max_turn;
}

bool MapSearch::areAllSameHypothesis() const {
  return std::all_of(leaves_.begin(), leaves_.end(),
                     [this](const Box& leaf) { return isSameHypothesis(leaf); });
}

MapSearch::Outcome MapSearch::evaluateLeaf(const Box& leaf) {
  if (leaves_.empty() && leaf.contradicted > options_.max_changed_share) {
    return Outcome::kNone;
  }
  leaves_.push_back(leaf);
  const bool decides = isSameHypothesis(leaf) || isInAlignedRegion(leaf);
  return decides ? Outcome::kUnfinished : Outcome::kAmbiguous;
}

MapSearch::Outcome MapSearch::conclude() {
  if (leaves_.empty()) {
    return Outcome::kNone;
  }
  if (areAllSameHypothesis() && maxShared() >= options_.min_shared) {
    return Outcome::kFound;
  }
  if (options_.max_aligned_sigma > 0.0) {
    const PoseWithCovariance central = centralPose();
    if (isNarrow(central.covariance)) {
      aligned_ = central;
      return Outcome::kAligned;
    }
  }
  return Outcome::kAmbiguous;
}

double MapSearch::maxShared() const {
  double shared = 0.0;
  for (const Box& leaf : leaves_) {
    shared = std::max(shared, sharedAt(poseOf(leaf)));
  }
  return shared;
}

MapSearch::Outcome MapSearch::advance(int boxes) {
  const int until = evaluated_boxes_ + boxes;
  while (outcome_ == Outcome::kUnfinished && evaluated_boxes_ < until) {
    if (open_.empty() ||
        (!leaves_.empty() && open_.top().cost > leaves_.front().cost + options_.max_log_ratio)) {
      outcome_ = conclude();
      break;
    }
    Box box = open_.top();
    open_.pop();
    if (box.half.isZero()) {
      outcome_ = evaluateLeaf(box);
    } else if (isLeaf(box)) {
      // Its center represents the whole box: the tolerance of surfaces is larger than the box.
      box.half.setZero();
      open(box);
    } else {
      split(box);
    }
    if (outcome_ == Outcome::kUnfinished && evaluated_boxes_ >= options_.max_boxes) {
      outcome_ = Outcome::kAmbiguous;
    }
  }
  return outcome_;
}

}  // namespace datmo
