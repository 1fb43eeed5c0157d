// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/kalman_filter.h"

namespace datmo {

struct MotionEvidenceOptions {
  double false_density = 0.02;             ///< 1/m^2
  double echo_density = 0.2;               ///< 1/m^2
  double required_against_chance = 9.0;    ///< 1
  double max_evidence = 20.0;              ///< 1
  double min_evidence = 0.0;               ///< 1
  double standing_drift = 1.0;             ///< m^2/s
  double required_against_standing = 3.0;  ///< 1
  double scan_limit = 2.0;                 ///< 1
  double free_space_evidence = 0.7;        ///< 1
  double max_static_share = 0.3;           ///< 1
  double min_overrun = 1.0;                ///< m
  double unseen_share = 0.5;               ///< 1
  double overrun_significance = 2.0;       ///< 1
  double min_speed = 0.8;                  ///< m/s
  double speed_significance = 5.99;        ///< 1

  void visit(OptionVisitor& visitor);
};

/// Whether v' P^-1 v of a velocity exceeds a chi-square quantile, and its norm a least speed (m/s).
bool velocityIsSignificant(const StateEstimate& estimate, double significance, double min_speed);

/// Whether a velocity is compatible with this speed (m/s) or a higher one, at this chi-square
/// quantile.
bool mayBeAsFastAs(const StateEstimate& estimate, double significance, double speed);

/// Decides whether a followed object moves over ground. There are two other explanations: it
/// stands, and only its visible part slides while the vehicle passes; or its objects do not belong
/// together, and chance put them in a row. Motion is accepted when five tests agree:
/// 1. Moving against standing: the log-likelihood ratio of the measurements by the motion filter
///    and by a standing object whose visible center drifts as a random walk, summed up but never
///    below 0 (CUSUM: Page, Continuous inspection schemes, 1954), so that one that starts to move
///    after a rest is found as quickly.
/// 2. One object against chance: the track score (Sittler 1964; Blackman 2004), from the likelihood
///    of each object in the motion filter, the density of false objects, the detector's evidence of
///    it, and the misses where it could have been seen. Objects of a single point are mostly false,
///    so their density is higher.
/// 3. It left its position: from where the first sum began to where it is now it reaches farther
/// than
///    something of its length that stands. A side that comes into view little by little, and goes
///    out of view again, is not motion. The more of its points lie where the map was free, the
///    less it can have stood there half hidden: then the displacement alone counts. Along an axis
///    neither end of which is seen there is no displacement at all: what is seen of a row of parked
///    cars goes along with the vehicle.
/// 4. Its estimated velocity is significant.
/// 5. Recently it was hardly seen at positions that are known to be static.
///
/// In both sums one scan counts for a limited amount, so that no outlier decides; points where the
/// map is free count for motion, and a position that the map knows as static counts against it.
class MotionEvidence {
 public:
  /// Of an object in the fixed frame, at its first detection.
  MotionEvidence(const Object& object, const MotionEvidenceOptions& options);

  void predict(double seconds, const MotionEvidenceOptions& options);

  /// Updates with an object in the fixed frame, its position, and how likely that was by the motion
  /// filter before its update: logarithm of a density of 1/m^2. `detection_probability`: that it
  /// would be seen at that position.
  void update(const Object& object, const PositionMeasurement& measured,
              double moving_log_likelihood, double detection_probability,
              const MotionEvidenceOptions& options);

  /// A sensor measured its velocity, with this log-likelihood ratio of moving against standing.
  void addVelocity(double ratio, const MotionEvidenceOptions& options);

  /// The present scan shows no object of this target, and would have with this probability.
  void miss(double detection_probability, const MotionEvidenceOptions& options);

  /// The target's center turned out to lie elsewhere in it (m, fixed frame): no motion.
  void shift(const Point2& offset) { standing_.position += offset; }

  /// All five tests agree; `estimate` is that of the motion filter.
  bool suffices(const StateEstimate& estimate, const MotionEvidenceOptions& options) const;

  /// What it did of late is no likelier for a moving object than for a standing one.
  bool seemsToStand() const { return against_standing_ == 0.0; }

  /// The track score: logarithm of how much likelier than chance it is that its objects belong
  /// together.
  double score() const { return against_chance_; }

 private:
  /// Where the object was seen at one time.
  struct ObservedBox {
    Box2 box;
    Eigen::Matrix2d covariance;
    double free_share;         ///< 0 to 1, of its points: those that lie where the map is free
    double static_share;       ///< 1: known to be static, else 0
    Eigen::Matrix2d measured;  ///< projector on the axes of which one end at least was seen
  };
  static ObservedBox observedBox(const Object& object);
  void startHere();

  void addAgainstStanding(double ratio, const MotionEvidenceOptions& options);
  void addAgainstChance(double ratio, const MotionEvidenceOptions& options);
  bool leftItsAnchor(const MotionEvidenceOptions& options) const;

  double against_standing_ = 0.0;
  double against_chance_ = 0.0;
  ObservedBox anchor_;
  ObservedBox present_;
  Box2 longest_;
  int objects_ = 1;      ///< since the anchor
  double free_share_;    ///< mean over them
  double static_share_;  ///< of the last ones, those at a position that is known to be static
  PositionMeasurement standing_;
};

}  // namespace datmo
