// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/vertical_extent.h"

namespace datmo::kitti {

namespace {

/// Scalar Kalman filter.
void correct(double measured, double sigma, double& mean, double& variance) {
  const double gain = variance / (variance + sigma * sigma);
  mean += gain * (measured - mean);
  variance *= 1.0 - gain;
}

}  // namespace

void VerticalExtentOptions::visit(OptionVisitor& visitor) {
  constexpr Bounds kSigma{0.001, 5.0};
  visitor.number({"bottom_sigma", "m", "standard deviation of the lower face of a detection"},
                 bottom_sigma, kSigma);
  visitor.number({"bottom_drift", "m/sqrt(s)",
                  "random walk of the lower face, due to the road and the camera's pitch"},
                 bottom_drift, {0.0, 10.0});
  visitor.number({"height_sigma", "m", "standard deviation of the height of a detection"},
                 height_sigma, kSigma);
}

VerticalExtent::VerticalExtent(double bottom, double height, const VerticalExtentOptions& options)
    : bottom_(bottom),
      height_(height),
      bottom_variance_(options.bottom_sigma * options.bottom_sigma),
      height_variance_(options.height_sigma * options.height_sigma) {}

void VerticalExtent::predict(double seconds, const VerticalExtentOptions& options) {
  bottom_variance_ += options.bottom_drift * options.bottom_drift * seconds;
}

void VerticalExtent::update(double bottom, double height, const VerticalExtentOptions& options) {
  correct(bottom, options.bottom_sigma, bottom_, bottom_variance_);
  correct(height, options.height_sigma, height_, height_variance_);
}

}  // namespace datmo::kitti
