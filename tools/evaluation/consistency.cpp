#include "evaluation/consistency.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <boost/math/distributions/chi_squared.hpp>

namespace datmo::evaluation {

namespace {

constexpr double kConfidence = 0.95;

}  // namespace

double chiSquareQuantile(double probability, double degrees_of_freedom) {
  return boost::math::quantile(boost::math::chi_squared(degrees_of_freedom), probability);
}

void NeesSum::add(const Eigen::Vector2d& error, const Eigen::Matrix2d& covariance) {
  static const double limit = chiSquareQuantile(kConfidence, Consistency().degrees_of_freedom);
  const Eigen::LLT<Eigen::Matrix2d> factors(covariance);
  const double nees = error.dot(factors.solve(error));
  if (factors.info() != Eigen::Success || !std::isfinite(nees)) {
    ++unusable_;
    return;
  }
  sum_ += nees;
  inside_ += nees <= limit ? 1 : 0;
  ++samples_;
}

Consistency NeesSum::result() const {
  Consistency consistency;
  consistency.samples = samples_;
  consistency.unusable = unusable_;
  if (samples_ == 0) {
    return consistency;
  }
  // The sum of independent samples is chi-square distributed with all their degrees of freedom.
  const double samples = static_cast<double>(samples_);
  const double degrees_of_freedom = samples * consistency.degrees_of_freedom;
  const double tail = 0.5 * (1.0 - kConfidence);
  consistency.mean_nees = sum_ / samples;
  consistency.lower = chiSquareQuantile(tail, degrees_of_freedom) / samples;
  consistency.upper = chiSquareQuantile(1.0 - tail, degrees_of_freedom) / samples;
  consistency.inside_share = static_cast<double>(inside_) / samples;
  return consistency;
}

TrackConsistency scoreConsistency(const Frames& frames, const Matching& matching) {
  NeesSum position;
  NeesSum velocity;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    forEachHit(frames[i], matching[i], [&](const TrueState& truth, const TrackState& track) {
      position.add(track.box.centre.position() - truth.box.centre.position(),
                   track.covariance.topLeftCorner<2, 2>());
      velocity.add(track.velocity - truth.velocity, track.covariance.bottomRightCorner<2, 2>());
    });
  }
  return {position.result(), velocity.result()};
}

}  // namespace datmo::evaluation
