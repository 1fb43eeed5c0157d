// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/consistency.h"

#include <boost/math/distributions/chi_squared.hpp>

namespace datmo::evaluation {

namespace {

constexpr double kConfidence = 0.95;

}  // namespace

double chiSquareQuantile(double probability, double degrees_of_freedom) {
  return boost::math::quantile(boost::math::chi_squared(degrees_of_freedom), probability);
}

NeesSum::NeesSum(int degrees_of_freedom)
    : degrees_of_freedom_(degrees_of_freedom),
      limit_(chiSquareQuantile(kConfidence, degrees_of_freedom)) {}

void NeesSum::add(const std::optional<double>& nees) {
  if (!nees) {
    ++unusable_;
    return;
  }
  sum_ += *nees;
  inside_ += *nees <= limit_ ? 1 : 0;
  ++samples_;
}

Consistency NeesSum::result() const {
  Consistency consistency;
  consistency.samples = samples_;
  consistency.unusable = unusable_;
  consistency.degrees_of_freedom = degrees_of_freedom_;
  if (samples_ == 0) {
    return consistency;
  }
  // The sum of independent samples is chi-square distributed with all their degrees of freedom.
  const double samples = static_cast<double>(samples_);
  const double degrees_of_freedom = samples * degrees_of_freedom_;
  const double tail = 0.5 * (1.0 - kConfidence);
  consistency.mean_nees = sum_ / samples;
  consistency.lower = chiSquareQuantile(tail, degrees_of_freedom) / samples;
  consistency.upper = chiSquareQuantile(1.0 - tail, degrees_of_freedom) / samples;
  consistency.inside_share = static_cast<double>(inside_) / samples;
  return consistency;
}

TrackConsistency scoreConsistency(const Frames& frames, const Matching& matching) {
  NeesSum position(2);
  NeesSum velocity(2);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    forEachHit(frames[i], matching[i], [&](const TrueState& truth, const TrackState& track) {
      position.add(
          normalizedErrorSquared<2>(track.box.center.position() - truth.box.center.position(),
                                    track.covariance.topLeftCorner<2, 2>()));
      velocity.add(normalizedErrorSquared<2>(track.velocity - truth.velocity,
                                             track.covariance.bottomRightCorner<2, 2>()));
    });
  }
  return {position.result(), velocity.result()};
}

}  // namespace datmo::evaluation
