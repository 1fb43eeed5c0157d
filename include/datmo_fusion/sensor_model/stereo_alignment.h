// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/stamp.h"
#include "datmo_fusion/common/twist2.h"

namespace datmo {

/// Why a stereo camera's points may deviate from the scanner's points on the same surfaces.
enum class AlignmentTerm {
  kDisparity,  ///< px: by how much the camera's disparities are too large
  /// m: how far its surfaces lie behind the scanner's, along their normal: vehicle bodies are not
  /// vertical
  kSurface,
  kForward,  ///< m: its mount is this much farther back than in tf, along its horizontal heading
  kHeading,  ///< rad: by how much it is turned farther to the left than tf says
  kTime,     ///< s: by how much it captured its cloud before the stamp
};
inline constexpr std::size_t kAlignmentTerms = 5;

using AlignmentVector = Eigen::Matrix<double, kAlignmentTerms, 1>;
using AlignmentMatrix = Eigen::Matrix<double, kAlignmentTerms, kAlignmentTerms>;

/// Prior and drift of one term, in its unit, and its fault threshold.
struct AlignmentTermOptions {
  double sigma = 0.0;       ///< standard deviation before any measurement
  double drift = 0.0;       ///< standard deviation of its change in one second
  double max_normal = 0.0;  ///< beyond this, calibration, mount or clock are wrong
};

struct StereoAlignmentOptions {
  AlignmentTermOptions disparity{0.3, 0.01, 1.0};
  AlignmentTermOptions surface{0.15, 0.002, 1.0};
  AlignmentTermOptions forward{0.1, 0.0005, 0.3};
  AlignmentTermOptions heading{0.05, 0.0001, 0.0175};
  AlignmentTermOptions time{0.1, 0.0002, 0.1};
  double body_sigma = 0.15;       ///< m
  double disparity_sigma = 0.35;  ///< px
  double surface_distance = 5.0;  ///< m
  /// s, 0 to 1000: a surface counts once in this time while the vehicle is stationary
  double surface_time = 20.0;
  double gate = 16.0;  ///< 1
  /// s, 0.1 to 100: time over which the share of agreeing surfaces is averaged
  double agreement_time = 5.0;
  /// 0 to 1: if fewer surfaces agree, the clouds do not show what the scanner sees, and nothing is
  /// computed from them
  double min_agreement = 0.25;

  void visit(OptionVisitor& visitor);
  std::array<const AlignmentTermOptions*, kAlignmentTerms> terms() const;
};

/// One planar upright surface that both sensors see: the scanner's inverse depth on it is
/// `intercept + slope * tangent` in the camera's level view (StereoView).
struct SurfacePair {
  double tangent = 0.0;     ///< of its middle, to the right of the camera's heading
  double intercept = 0.0;   ///< 1/m
  double slope = 0.0;       ///< 1/m
  double difference = 0.0;  ///< px, the camera's disparity minus the scanner's
  double variance = 0.0;    ///< px^2, of the part that is independent from surface to surface

  double inverseDepth() const { return intercept + slope * tangent; }
};

/// Returns the derivative of a pair's difference with respect to each term. `disparity_at_meter`:
/// px m, focal length times baseline. `twist`: of the vehicle.
AlignmentVector alignmentRates(const SurfacePair& pair, double disparity_at_meter,
                               const Twist2& twist);

/// The estimated deviation of a stereo camera's points from the scanner's.
struct StereoAlignment {
  Stamp stamp;
  AlignmentVector mean = AlignmentVector::Zero();
  AlignmentMatrix covariance = AlignmentMatrix::Identity();
  std::size_t surfaces = 0;  ///< that agreed, so far
  std::size_t refused = 0;   ///< that did not
  double agreement = 1.0;    ///< share of the most recent ones that agreed; 1 without any
  /// False: the clouds do not show what the scanner sees, or not where it sees it.
  bool usable = true;

  double operator[](AlignmentTerm term) const { return mean[static_cast<int>(term)]; }
  double variance(AlignmentTerm term) const {
    return covariance(static_cast<int>(term), static_cast<int>(term));
  }
  double sigma(AlignmentTerm term) const;
};

/// Estimates the alignment from pairs of surfaces: an information filter over slow random walks.
/// The deviation of one surface is the same in consecutive images: until the vehicle has moved by
/// `surface_distance`, or after `surface_time`, the surface counts as one measurement. Differences
/// that the state does not explain (gate) are rejected, because they are from two surfaces.
///
/// Different errors have different patterns: that of the disparity is the same on all surfaces,
/// that of the mounting position grows with the square of the inverse depth, that of the heading
/// depends on the slant of the surfaces, and that of the time on the vehicle's motion. So a wrong
/// mount is not mistaken for a wrong disparity.
class StereoAlignmentFilter {
 public:
  /// Throws OptionError.
  explicit StereoAlignmentFilter(const Checked<StereoAlignmentOptions>& options);

  /// Returns the current estimate; before the first update that of the options.
  const StereoAlignment& alignment() const { return alignment_; }

  /// Updates with the pairs of one image, at this stamp, each later than the last. `twist`: of the
  /// vehicle.
  void update(Stamp stamp, const std::vector<SurfacePair>& pairs, double disparity_at_meter,
              const Twist2& twist);

  /// The image has not changed while the vehicle moved: it is not used, and marked as not usable.
  void handleFrozen(Stamp stamp);

  /// Returns whether a term is outside its normal range with certainty (two standard deviations).
  bool isFault(AlignmentTerm term) const;

  /// Returns the fault threshold, in the term's unit.
  double maxNormal(AlignmentTerm term) const {
    return options_.terms()[static_cast<std::size_t>(term)]->max_normal;
  }

  /// The clock was set: the estimate is kept, but the time since the last update is unknown.
  void forgetTime() { started_ = false; }

 private:
  void drift(double seconds);
  /// 0 to 1, share of the compared surfaces that is new.
  double newShare(double seconds, const Twist2& twist) const;
  void judge(double seconds, std::size_t agreed, std::size_t compared);
  /// False if it was rejected.
  bool add(const SurfacePair& pair, const AlignmentVector& rates, double weight);

  StereoAlignmentOptions options_;
  StereoAlignment alignment_;
  bool started_ = false;
  double agreed_ = 0.0;    ///< recently
  double compared_ = 0.0;  ///< the same
};

}  // namespace datmo
