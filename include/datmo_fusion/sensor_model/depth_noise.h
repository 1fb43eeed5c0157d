// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/common/options.h"

namespace datmo {

/// Noise of a camera's depth as a function of depth: the standard deviation is
///
///   constant + linear * depth + depth^2 * disparity_sigma / disparity_at_meter,
///
/// which covers cameras that triangulate (the last term: a point at `depth` m has a disparity of
/// disparity_at_meter / depth) as well as those that measure a time of flight (the first two).
/// Stages use only this model, not its terms.
struct DepthNoise {
  double constant = 0.0;            ///< m
  double linear = 0.0;              ///< m / m; sigma() must be more than 0 at all depths
  double disparity_sigma = 0.0;     ///< px, 0 or more
  double disparity_at_meter = 1.0;  ///< px m, more than 0: focal length times baseline

  /// Noise of cameras that match disparities: a pair, or a camera and a projector.
  static DepthNoise ofDisparity(double focal_length, double baseline, double disparity_sigma) {
    return {0.0, 0.0, disparity_sigma, focal_length * baseline};
  }

  /// constant + linear * depth + quadratic * depth^2; m, 1, 1/m.
  static DepthNoise ofPolynomial(double constant, double linear, double quadratic) {
    return {constant, linear, quadratic, 1.0};
  }

  /// 1/m
  double quadratic() const { return disparity_sigma / disparity_at_meter; }

  /// Returns the standard deviation of a depth, m. `depth`: m, 0 or more.
  double sigma(double depth) const {
    return constant + linear * depth + depth * depth * disparity_sigma / disparity_at_meter;
  }

  /// Returns the standard deviation of an inverse depth, 1/m, to first order in the noise; for
  /// cameras that match disparities it is the same at all depths. `inverse`: 1/m, 0 or more.
  double inverseSigma(double inverse) const {
    return quadratic() + inverse * (linear + inverse * constant);
  }
};

/// A DepthNoise in single precision, times a factor: for loops over points.
class InverseDepthMargin {
 public:
  InverseDepthMargin() = default;
  InverseDepthMargin(const DepthNoise& noise, double sigmas)
      : quadratic_(static_cast<float>(sigmas * noise.quadratic())),
        linear_(static_cast<float>(sigmas * noise.linear)),
        constant_(static_cast<float>(sigmas * noise.constant)) {}

  /// Returns this many standard deviations of an inverse depth, 1/m. `inverse`: 1/m.
  float at(float inverse) const { return quadratic_ + inverse * (linear_ + inverse * constant_); }

 private:
  float quadratic_ = 0.0F;
  float linear_ = 0.0F;
  float constant_ = 0.0F;
};

/// The measuring principle of a depth camera.
enum class DepthPrinciple {
  kStereo,           ///< a pair of cameras; the right one's camera info has the baseline
  kActiveStereo,     ///< a pair inside a depth camera, whose camera info has no baseline
  kStructuredLight,  ///< a camera and a projector of a known pattern
  kTimeOfFlight,     ///< travel time of light
};

/// The noise of structured light: constant + quadratic * (depth - nearest)^2. The defaults are
/// the axial noise of a Kinect (Nguyen, Izadi, Lovell, Modeling Kinect sensor noise for improved 3D
/// reconstruction and tracking, 2012, eq. 2); Khoshelham and Elberink, Accuracy and resolution of
/// Kinect depth data for indoor mapping applications, 2012, have 0, 0.001425 1/m and 0.
struct StructuredLightNoiseOptions {
  double constant = 0.0012;   ///< m
  double quadratic = 0.0019;  ///< 1/m
  double nearest = 0.4;       ///< m

  void visit(OptionVisitor& visitor);
};

/// The noise of a time of flight: constant + linear * depth. The defaults are the bounds of the
/// Azure Kinect's data sheet (Microsoft 2019; confirmed by Tölgyessy et al., Evaluation of the
/// Azure Kinect, Sensors 2021): 17 mm of random error and 11 mm + 0.1 % of systematic error.
struct TimeOfFlightNoiseOptions {
  double constant = 0.02;  ///< m: 17 mm and 11 mm, independent of each other
  double linear = 0.001;   ///< m / m

  void visit(OptionVisitor& visitor);
};

/// The measuring principle of a depth camera, and its noise.
struct DepthNoiseOptions {
  DepthPrinciple principle = DepthPrinciple::kStereo;  ///< key `depth_noise`
  double disparity_sigma = 0.25;                       ///< px, for both stereo principles
  StructuredLightNoiseOptions structured_light;
  TimeOfFlightNoiseOptions time_of_flight;

  void visit(OptionVisitor& visitor);
};

/// Throws OptionError for an unknown name; the message lists the known ones.
DepthPrinciple depthPrinciple(const std::string& name);

/// Returns the noise of a camera of this focal length (px) and baseline (m), which must be more
/// than 0 for both stereo principles and are unused otherwise. Throws OptionError as depthPrinciple
/// does.
DepthNoise depthNoise(const DepthNoiseOptions& options, double focal_length, double baseline);

}  // namespace datmo
