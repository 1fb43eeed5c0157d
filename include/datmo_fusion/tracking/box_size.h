// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include <Eigen/Core>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"

namespace datmo {

/// Prior of the size of objects of one kind.
struct SizePrior {
  double share;       ///< 1, of the objects of unknown class, relative to the others
  double length;      ///< m, mean
  double length_std;  ///< m
  double width;       ///< m, mean
  double width_std;   ///< m

  /// Visits the options under the name of the kind; `source` tells where the numbers come from.
  void visit(OptionVisitor& visitor, const std::string& kind, const std::string& source);
};

struct BoxSizeOptions {
  SizePrior vehicle{0.3, 4.2, 0.6, 1.75, 0.2};
  SizePrior lorry{0.05, 9.0, 3.0, 2.5, 0.2};
  SizePrior two_wheeler{0.3, 1.8, 0.25, 0.6, 0.15};
  SizePrior person{0.3, 0.7, 0.25, 0.6, 0.2};
  SizePrior other{0.05, 3.0, 3.0, 1.5, 1.5};
  double extent_std = 0.1;         ///< m
  double correlation_time = 0.25;  ///< s
  double wrong_size = 0.05;        ///< 1
  double drift = 1e-3;             ///< m^2/s

  void visit(OptionVisitor& visitor);
};

/// The visible extent of an object along one axis.
struct VisibleExtent {
  double length = 0.0;      ///< m, at least 0
  double variance = 0.0;    ///< m^2, at least 0; of the visible ends
  bool whole = false;       ///< both ends were visible; otherwise the object may be longer
  double hidden_std = 0.0;  ///< m, at least 0; of the visible limit toward a hidden end
};

/// The size of one tracked object along the two axes of its box: one estimate (mean and variance,
/// by a Kalman filter) for each kind of object and each axis along which its length may lie,
/// weighted by how well the kind predicted the measurements (a static multiple model: Bar-Shalom,
/// Li, Kirubarajan 2001, 11.6.2). So a car's rear, 1.8 m wide, is taken as part of something 4 m
/// long, and a leg as part of something small, before their class is known (thesis 4.2.4 needs the
/// class for that).
///
/// Measurement errors of an extent are correlated in time: the same mirror, the same neighbor that
/// is taken as a part. So scans within `correlation_time` count together as one: the variance of
/// each is increased in proportion.
///
/// If an end is hidden, the visible extent minus its possible noise is a lower bound: it increases
/// a smaller estimate, and never decreases one. No heap memory: cheap to copy.
class BoxSize {
 public:
  explicit BoxSize(const BoxSizeOptions& options);

  /// Updates with a class and its probability, 0 to 1; kUnknown has no effect.
  void classify(ObjectClass object_class, double probability);

  /// Updates with the visible extents along the first and the second axis, `seconds` >= 0 after the
  /// last update; with 0 seconds they carry no new information.
  void update(const std::array<VisibleExtent, 2>& seen, double seconds,
              const BoxSizeOptions& options);

  /// Adds log odds, from another source, that the length lies along the first axis.
  void addOddsAlongFirst(double log_odds);

  /// Renames the axes: the first becomes the second.
  void swapAxes();

  /// Returns the likelihood of the measured sizes for each kind of road user, without classify().
  RoadUserLikelihoods likelihoods(const BoxSizeOptions& options) const;

  /// Returns the mean along both axes, m.
  const Eigen::Vector2d& mean() const { return mean_; }
  /// Returns the variance along both axes, m^2.
  const Eigen::Vector2d& variance() const { return variance_; }
  /// Returns the probability that the length lies along the first axis.
  double probabilityAlongFirst() const { return along_first_; }

 private:
  static constexpr std::size_t kKinds = 5;  ///< as in BoxSizeOptions
  static constexpr std::size_t kAxes = 2;

  struct Hypothesis {
    double log_weight;
    double log_size;                     ///< the part of it that comes from sizes and their axes
    std::array<double, kAxes> mean;      ///< m, by axis
    std::array<double, kAxes> variance;  ///< m^2

    void add(double log_likelihood) {
      log_weight += log_likelihood;
      log_size += log_likelihood;
    }
  };

  void summarize();

  /// By kind; within one, length along the first axis, along the second.
  std::array<Hypothesis, kKinds * kAxes> hypotheses_;
  Eigen::Vector2d mean_;
  Eigen::Vector2d variance_;
  double along_first_ = 0.5;
  bool was_seen_ = false;
};

}  // namespace datmo
