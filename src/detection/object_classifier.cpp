// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/detection/object_classifier.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// Share of road users that are seen from straight ahead or behind, because they follow lanes; the
/// others are seen from any direction.
constexpr double kAheadShare = 0.6;

/// m; mean sizes of all other objects: buildings, hedges, bushes.
constexpr double kMeanHeight = 5.0;
constexpr double kMeanExtent = 10.0;

/// Number of directions from which a kind is evaluated, over a quarter turn from straight ahead.
constexpr int kAspects = 8;

/// m; a side whose visible width is less carries no information on its depth.
constexpr double kMinFace = 0.1;

/// rad; road users in a parallel lane are seen from ahead or behind, up to this angle.
constexpr double kAhead = degrees(20.0);

/// Share of the extents of which only a part is visible.
constexpr double kPartShare = 0.2;

/// Limit of certainty: probabilities near 0 and 1 depend on the tails of the kinds' distributions.
constexpr double kSure = 1e-6;

/// Probability density of a measured size, or, with `more`, of being at least that large.
double likelihood(double seen, double mean, double variance, bool more) {
  const double ratio = (seen - mean) / std::sqrt(variance);
  return more ? 0.5 * std::erfc(ratio / std::sqrt(2.0))
              : std::exp(-0.5 * square(ratio)) / std::sqrt(2.0 * kPi * variance);
}

/// The same for an extent that may be only partly visible: sides without texture, or at a grazing
/// angle.
double likelihoodOfExtent(double seen, double mean, double variance, bool more) {
  const double whole = likelihood(seen, mean, variance, more);
  const double sigma = std::sqrt(variance);
  const double reaches = 0.5 * std::erfc((seen - mean) / (sigma * std::sqrt(2.0)));
  const double part = more ? reaches : reaches / std::max(mean, sigma);
  return (1.0 - kPartShare) * whole + kPartShare * part;
}

/// Likelihood for a box of a kind, turned by `aspect` (rad, 0 to a quarter turn) from where its
/// front or rear faces the sensor: of its visible extent across the line of sight, and of the depth
/// of its visible sides.
double likelihoodAt(double aspect, const SeenSize& seen, const KindSize& kind) {
  const double s = std::sin(aspect);
  const double c = std::cos(aspect);
  const double across_variance =
      square(kind.length_sigma * s) + square(kind.width_sigma * c) + square(seen.across_sigma);
  const double min = std::max(kMinFace, 2.0 * seen.across_sigma);
  const bool side_seen = kind.length * s > min;
  const bool end_seen = kind.width * c > min;
  const double along = std::max(side_seen ? kind.length * c : 0.0, end_seen ? kind.width * s : 0.0);
  const double along_variance = square(side_seen ? kind.length_sigma * c : kind.width_sigma) +
                                square(kind.relief_sigma) + square(seen.along_sigma);
  return likelihoodOfExtent(seen.across, kind.length * s + kind.width * c, across_variance,
                            seen.wider) *
         likelihoodOfExtent(seen.along, along, along_variance, seen.wider);
}

double likelihood(const SeenSize& seen, const KindSize& kind, double ahead_share) {
  const double by_height = likelihood(
      seen.height, kind.height, square(kind.height_sigma) + square(seen.height_sigma), seen.higher);
  double by_extent = 0.0;
  for (int i = 0; i < kAspects; ++i) {
    const double part = static_cast<double>(i) / (kAspects - 1);
    by_extent += ahead_share / kAspects * likelihoodAt(part * kAhead, seen, kind) +
                 (1.0 - ahead_share) / kAspects * likelihoodAt(part * kQuarterTurn, seen, kind);
  }
  return by_height * by_extent;
}

/// For a size of which only the mean is known: the maximum-entropy distribution (exponential).
double likelihoodOfAny(double seen, double mean, bool more) {
  const double tail = std::exp(-seen / mean);
  return more ? tail : tail / mean;
}

}  // namespace

void KindSize::visit(OptionVisitor& visitor) {
  visitor.number({"share", "1", "prior share of this kind, relative to the other kinds"}, share,
                 {0.0, 1000.0});
  visitor.number({"height", "m", "mean"}, height, {0.1, 20.0});
  visitor.number({"height_sigma", "m", "standard deviation"}, height_sigma, {0.01, 10.0});
  visitor.number({"length", "m", "mean"}, length, {0.01, 30.0});
  visitor.number({"length_sigma", "m", "standard deviation"}, length_sigma, {0.01, 10.0});
  visitor.number({"width", "m", "mean"}, width, {0.01, 10.0});
  visitor.number({"width_sigma", "m", "standard deviation"}, width_sigma, {0.01, 10.0});
}

void ObjectClassifierOptions::visit(OptionVisitor& visitor) {
  visitor.group("pedestrian", [&] { pedestrian.visit(visitor); });
  visitor.group("cyclist", [&] { cyclist.visit(visitor); });
  visitor.group("car", [&] { car.visit(visitor); });
  visitor.group("van", [&] { van.visit(visitor); });
  visitor.group("truck", [&] { truck.visit(visitor); });
  visitor.group("pole", [&] { pole.visit(visitor); });
}

ObjectClassifier::ObjectClassifier(const Checked<ObjectClassifierOptions>& options)
    : options_(*options) {}

ClassProbabilities ObjectClassifier::probabilities(const SeenSize& seen) const {
  ClassProbabilities result{};
  const auto add = [&](ObjectClass object_class, const KindSize& kind) {
    result[static_cast<std::size_t>(object_class)] +=
        kind.share * likelihood(seen, kind, kAheadShare);
  };
  add(ObjectClass::kPedestrian, options_.pedestrian);
  add(ObjectClass::kCyclist, options_.cyclist);
  add(ObjectClass::kVehicle, options_.car);
  add(ObjectClass::kVehicle, options_.van);
  add(ObjectClass::kVehicle, options_.truck);
  add(ObjectClass::kPole, options_.pole);
  result[static_cast<std::size_t>(ObjectClass::kUnknown)] =
      options_.other_share * likelihoodOfAny(seen.height, kMeanHeight, seen.higher) *
      likelihoodOfAny(seen.across, kMeanExtent, seen.wider) *
      likelihoodOfAny(seen.along, kMeanExtent, seen.wider);
  const double sum = std::accumulate(result.begin(), result.end(), 0.0);
  if (!(sum > 0.0)) {
    result.fill(0.0);
    result[static_cast<std::size_t>(ObjectClass::kUnknown)] = 1.0;
    return result;
  }
  for (double& value : result) {
    value /= sum;
  }
  return result;
}

double ObjectClassifier::logOddsOfKnown(const ClassProbabilities& probabilities) const {
  const ObjectClassifierOptions& o = options_;
  const double known = o.pedestrian.share + o.cyclist.share + o.car.share + o.van.share +
                       o.truck.share + o.pole.share;
  const double other = std::clamp(probabilities[static_cast<std::size_t>(ObjectClass::kUnknown)],
                                  kSure, 1.0 - kSure);
  return std::log((1.0 - other) / other) - std::log(std::max(kSure, known) / o.other_share);
}

void ObjectClassifier::classify(const SeenSize& seen, double max_doubt, Object& object) const {
  object.class_probabilities = probabilities(seen);
  object.log_odds = std::clamp(logOddsOfKnown(object.class_probabilities), -max_doubt, 0.0);
}

}  // namespace datmo
