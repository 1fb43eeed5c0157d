// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/stereo_alignment.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// s; time that the first image counts for: the period of a typical camera.
constexpr double kUsualPeriod = 0.1;

/// Surfaces that count as having agreed before any has been seen.
constexpr double kUsualAgreement = 5.0;

/// Standard deviations from which a term certainly exceeds a limit.
constexpr double kSure = 2.0;

void visitTerm(OptionVisitor& visitor, const char* name, const char* unit, const char* what,
               AlignmentTermOptions& term) {
  constexpr Bounds kAny{0.0, 100.0};
  visitor.group(name, [&] {
    visitor.number({"sigma", unit, what}, term.sigma, {1e-6, 100.0});
    visitor.number({"drift", unit, "standard deviation of its change in one second"}, term.drift,
                   kAny);
    visitor.number({"max_normal", unit, "diagnostics warn if it is certainly larger"},
                   term.max_normal, {1e-6, 100.0});
  });
}

}  // namespace

void StereoAlignmentOptions::visit(OptionVisitor& visitor) {
  visitTerm(visitor, "disparity", "px",
            "standard deviation of the bias of disparities, before it is measured; OpenCV's "
            "semi-global matcher has -0.4 px on vehicles of KITTI's drive 0005",
            disparity);
  visitTerm(visitor, "surface", "m",
            "the same for how far the camera's surfaces lie behind the scanner's along their "
            "normal: 0.1 to 0.2 m on that drive, whose scan has the nearest of a band of heights",
            surface);
  visitTerm(visitor, "forward", "m", "the same for the mount's error along the camera's heading",
            forward);
  visitTerm(visitor, "heading", "rad", "the same for the mount's heading", heading);
  visitTerm(visitor, "time", "s", "the same for the stamps", time);
  visitor.number({"body_sigma", "m",
                  "standard deviation, between surfaces, of how far a surface lies behind where "
                  "the scanner sees it"},
                 body_sigma, {0.001, 2.0});
  visitor.number(
      {"disparity_sigma", "px",
       "standard deviation of the disparity error that all points of a surface have in common"},
      disparity_sigma, {0.01, 10.0});
  visitor.number({"surface_distance", "m",
                  "a surface counts once while the vehicle moves this far, since its errors are "
                  "the same from image to image: the length of a parked car; 0: each time"},
                 surface_distance, {0.0, 1000.0});
  visitor.number({"gate", "1",
                  "squared differences beyond this, over their variance, belong to two surfaces; "
                  "16: four standard deviations"},
                 gate, {1.0, 100.0});
}

std::array<const AlignmentTermOptions*, kAlignmentTerms> StereoAlignmentOptions::terms() const {
  return {&disparity, &surface, &forward, &heading, &time};
}

/// First-order derivatives for a plane: 1/depth = intercept + slope tangent.
AlignmentVector alignmentRates(const SurfacePair& pair, double disparity_at_meter,
                               const Twist2& twist) {
  const double inverse = pair.inverseDepth();
  const double forward = -inverse * pair.intercept;
  const double heading = pair.intercept * pair.tangent - pair.slope;
  AlignmentVector rates;
  rates << 1.0, disparity_at_meter * -inverse * std::hypot(pair.intercept, pair.slope),
      disparity_at_meter * forward, disparity_at_meter * heading,
      disparity_at_meter * (twist.forward_speed * forward - twist.yaw_rate * heading);
  return rates;
}

double StereoAlignment::sigma(AlignmentTerm term) const { return std::sqrt(variance(term)); }

StereoAlignmentFilter::StereoAlignmentFilter(const Checked<StereoAlignmentOptions>& options)
    : options_(*options) {
  alignment_.covariance.setZero();
  const auto terms = options_.terms();
  for (std::size_t i = 0; i < kAlignmentTerms; ++i) {
    alignment_.covariance(static_cast<int>(i), static_cast<int>(i)) = square(terms[i]->sigma);
  }
}

void StereoAlignmentFilter::update(Stamp stamp, const std::vector<SurfacePair>& pairs,
                                   double disparity_at_meter, const Twist2& twist) {
  const double seconds = started_ ? secondsBetween(alignment_.stamp, stamp) : kUsualPeriod;
  started_ = true;
  alignment_.stamp = stamp;
  drift(seconds);
  const double weight = newShare(seconds, twist);
  std::size_t agreed = 0;
  for (const SurfacePair& pair : pairs) {
    agreed += add(pair, alignmentRates(pair, disparity_at_meter, twist), weight) ? 1 : 0;
  }
  alignment_.surfaces += agreed;
  alignment_.refused += pairs.size() - agreed;
  judge(seconds, agreed, pairs.size());
}

double StereoAlignmentFilter::newShare(double seconds, const Twist2& twist) const {
  if (options_.surface_distance <= 0.0 || options_.surface_time <= 0.0) {
    return 1.0;
  }
  const double moved = std::abs(twist.forward_speed) * std::max(0.0, seconds);
  return std::min(
      1.0, moved / options_.surface_distance + std::max(0.0, seconds) / options_.surface_time);
}

void StereoAlignmentFilter::handleFrozen(Stamp stamp) {
  alignment_.stamp = stamp;
  alignment_.usable = false;
}

void StereoAlignmentFilter::judge(double seconds, std::size_t agreed, std::size_t compared) {
  const double kept = std::exp(-std::max(0.0, seconds) / options_.agreement_time);
  agreed_ = kept * agreed_ + static_cast<double>(agreed);
  compared_ = kept * compared_ + static_cast<double>(compared);
  alignment_.agreement = (kUsualAgreement + agreed_) / (kUsualAgreement + compared_);
  alignment_.usable = alignment_.agreement >= options_.min_agreement &&
                      !isFault(AlignmentTerm::kForward) && !isFault(AlignmentTerm::kHeading) &&
                      !isFault(AlignmentTerm::kTime);
}

void StereoAlignmentFilter::drift(double seconds) {
  const auto terms = options_.terms();
  for (std::size_t i = 0; i < kAlignmentTerms; ++i) {
    double& variance = alignment_.covariance(static_cast<int>(i), static_cast<int>(i));
    // Never more uncertain than the prior.
    variance = std::min(square(terms[i]->sigma), variance + square(terms[i]->drift) * seconds);
  }
}

bool StereoAlignmentFilter::add(const SurfacePair& pair, const AlignmentVector& rates,
                                double weight) {
  const double body = rates[static_cast<int>(AlignmentTerm::kSurface)] * options_.body_sigma;
  const double noise = square(body) + square(options_.disparity_sigma) + pair.variance;
  const AlignmentVector cross = alignment_.covariance * rates;
  const double explained = rates.dot(cross);
  const double innovation = pair.difference - rates.dot(alignment_.mean);
  if (weight <= 0.0 || square(innovation) > options_.gate * (explained + noise)) {
    return false;
  }
  const double innovation_variance = explained + noise / weight;
  alignment_.mean += cross * (innovation / innovation_variance);
  const AlignmentMatrix reduced =
      alignment_.covariance - cross * cross.transpose() / innovation_variance;
  alignment_.covariance = 0.5 * (reduced + reduced.transpose());
  return true;
}

bool StereoAlignmentFilter::isFault(AlignmentTerm term) const {
  return std::abs(alignment_[term]) - kSure * alignment_.sigma(term) > maxNormal(term);
}

}  // namespace datmo
