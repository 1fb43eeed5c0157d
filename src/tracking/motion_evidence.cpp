// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/motion_evidence.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "datmo_fusion/common/box_extent.h"

namespace datmo {

namespace {

double clamp(double value, double limit) { return std::max(-limit, std::min(limit, value)); }

/// Evidence of the map at the object's position, as a log-likelihood ratio of moving against
/// standing.
double mapEvidence(const Object& object, double weight) {
  return object.dynamic_state == DynamicState::kStatic ? -weight : weight * object.moving_fraction;
}

/// Number of recent objects that are averaged over, approximately.
constexpr int kStaticMemory = 10;

double staticShare(const Object& object) {
  return object.dynamic_state == DynamicState::kStatic ? 1.0 : 0.0;
}

}  // namespace

void MotionEvidenceOptions::visit(OptionVisitor& visitor) {
  visitor.number({"false_density", "1/m^2",
                  "objects in one scan that belong to nothing that moves, where there are many"},
                 false_density, {1e-6, 10.0});
  visitor.number({"echo_density", "1/m^2", "the same of objects with a single point"}, echo_density,
                 {1e-6, 10.0});
  constexpr Bounds kEvidence{0.0, 100.0};
  visitor.number({"required_against_chance", "1",
                  "sum of log-likelihood ratios from which the objects of a target belong together "
                  "(Wald 1947: the logarithm of the inverse rate of false alarms)"},
                 required_against_chance, kEvidence);
  visitor.number(
      {"max_evidence", "1",
       "to which both sums are limited, so that a track that lost its object ends, and one that "
       "stops stands"},
      max_evidence, kEvidence);
  visitor.number({"min_evidence", "1",
                  "below which the sum against chance does not fall: 0 forgets that its first "
                  "objects did not belong together"},
                 min_evidence, {-100.0, 0.0});
  visitor.number({"standing_drift", "m^2/s",
                  "random walk of the visible center of an object that stands: its root is how far "
                  "it slides in one second"},
                 standing_drift, {1e-6, 100.0});
  visitor.number({"required_against_standing", "1",
                  "sum of log-likelihood ratios from which a target does not stand"},
                 required_against_standing, kEvidence);
  visitor.number({"scan_limit", "1", "most that one scan may add to a sum, or take from it"},
                 scan_limit, {0.1, 100.0});
  visitor.number({"free_space_evidence", "1",
                  "log-likelihood ratio that a scan adds when all points of the object lie where "
                  "the map is free (thesis 3.3.1)"},
                 free_space_evidence, kEvidence);
  visitor.number({"max_static_share", "1",
                  "movers are seen less often than this at positions that are known to be static: "
                  "parked cars in a row are, however much they are taken for each other"},
                 max_static_share, {0.0, 1.0});
  visitor.number({"min_overrun", "m",
                  "how much farther than its own length an object reaches from where it stood"},
                 min_overrun, {0.0, 100.0});
  visitor.number({"unseen_share", "1",
                  "an object that stands may be longer than it was ever seen by this share"},
                 unseen_share, {0.0, 10.0});
  visitor.number({"overrun_significance", "1", "the same in standard deviations"},
                 overrun_significance, {0.0, 100.0});
  visitor.number({"min_speed", "m/s", "slower than this nothing counts as moving"}, min_speed,
                 {0.0, 100.0});
  visitor.number({"speed_significance", "1",
                  "least Mahalanobis distance squared of the velocity from zero: 5.99 is the 95 % "
                  "quantile of chi-square with two degrees of freedom"},
                 speed_significance, {0.0, 1000.0});
}

bool velocityIsSignificant(const StateEstimate& estimate, double significance, double min_speed) {
  const Eigen::Vector2d velocity = estimate.mean.segment<2>(2);
  const Eigen::Matrix2d covariance = estimate.covariance.block<2, 2>(2, 2);
  return velocity.norm() >= min_speed &&
         velocity.dot(covariance.inverse() * velocity) >= significance;
}

bool mayBeAsFastAs(const StateEstimate& estimate, double significance, double speed) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeDirect(estimate.covariance.block<2, 2>(2, 2), Eigen::EigenvaluesOnly);
  const double max_variance = std::max(0.0, solver.eigenvalues().maxCoeff());
  return estimate.mean.segment<2>(2).norm() + std::sqrt(significance * max_variance) >= speed;
}

MotionEvidence::MotionEvidence(const Object& object, const MotionEvidenceOptions& options)
    : against_chance_(std::max(options.min_evidence, object.log_odds)),
      anchor_(observedBox(object)),
      present_(anchor_),
      longest_(object.box),
      free_share_(object.moving_fraction),
      static_share_(staticShare(object)),
      standing_{object.box.center.position(), object.position_covariance} {}

MotionEvidence::ObservedBox MotionEvidence::observedBox(const Object& object) {
  const auto isSeen = [&](BoxSide side) {
    return std::isfinite(object.side_variance[static_cast<std::size_t>(side)]);
  };
  // What is seen of a person is where it is: there is not much more of it.
  const bool is_small = object.object_class == ObjectClass::kPedestrian;
  const auto known = [&](BoxSide one, BoxSide other) {
    return is_small || isSeen(one) || isSeen(other) ? 1.0 : 0.0;
  };
  const Eigen::Vector2d seen(known(BoxSide::kFront, BoxSide::kRear),
                             known(BoxSide::kLeft, BoxSide::kRight));
  const Eigen::Matrix2d axes = object.box.center.rotation();
  return {object.box, object.position_covariance, object.moving_fraction, staticShare(object),
          axes * seen.asDiagonal() * axes.transpose()};
}

void MotionEvidence::startHere() {
  anchor_ = present_;
  objects_ = 1;
  free_share_ = present_.free_share;
}

void MotionEvidence::predict(double seconds, const MotionEvidenceOptions& options) {
  standing_.covariance += Eigen::Matrix2d::Identity() * (options.standing_drift * seconds);
}

void MotionEvidence::update(const Object& object, const PositionMeasurement& measured,
                            double moving_log_likelihood, double detection_probability,
                            const MotionEvidenceOptions& options) {
  const Innovation innovation{measured.position - standing_.position,
                              standing_.covariance + measured.covariance};
  const double ratio = moving_log_likelihood - innovation.logLikelihood();
  present_ = observedBox(object);
  ++objects_;
  free_share_ += (object.moving_fraction - free_share_) / objects_;
  static_share_ += (staticShare(object) - static_share_) / std::min(objects_, kStaticMemory);
  if (std::lround(anchor_.measured.trace()) < std::lround(present_.measured.trace())) {
    startHere();  // only now is more known of where it is
  }
  const double map = mapEvidence(object, options.free_space_evidence);
  addAgainstStanding(clamp(ratio, options.scan_limit) + map, options);
  const double false_density =
      object.points.size() == 1 ? options.echo_density : options.false_density;
  const double chance = moving_log_likelihood + std::log(detection_probability / false_density);
  addAgainstChance(clamp(chance, options.scan_limit) + object.log_odds + map, options);

  const Eigen::Matrix2d gain = standing_.covariance * innovation.covariance.inverse();
  standing_.position += gain * innovation.residual;
  standing_.covariance = gain * measured.covariance;
  if (object.box.length > longest_.length) {
    longest_ = object.box;
  }
}

void MotionEvidence::miss(double detection_probability, const MotionEvidenceOptions& options) {
  addAgainstChance(std::log(1.0 - detection_probability), options);
}

void MotionEvidence::addVelocity(double ratio, const MotionEvidenceOptions& options) {
  addAgainstStanding(clamp(ratio, options.scan_limit), options);
}

void MotionEvidence::addAgainstStanding(double ratio, const MotionEvidenceOptions& options) {
  const bool came_to_rest = against_standing_ > 0.0 && against_standing_ + ratio <= 0.0;
  if (came_to_rest) {
    startHere();
    static_share_ = present_.static_share;
  }
  against_standing_ = std::min(options.max_evidence, std::max(0.0, against_standing_ + ratio));
}

void MotionEvidence::addAgainstChance(double ratio, const MotionEvidenceOptions& options) {
  against_chance_ =
      std::min(options.max_evidence, std::max(options.min_evidence, against_chance_ + ratio));
}

bool MotionEvidence::suffices(const StateEstimate& estimate,
                              const MotionEvidenceOptions& options) const {
  return against_chance_ >= options.required_against_chance &&
         against_standing_ >= options.required_against_standing &&
         static_share_ <= options.max_static_share && leftItsAnchor(options) &&
         velocityIsSignificant(estimate, options.speed_significance, options.min_speed);
}

bool MotionEvidence::leftItsAnchor(const MotionEvidenceOptions& options) const {
  const Eigen::Vector2d displacement =
      anchor_.measured * present_.measured *
      (present_.box.center.position() - anchor_.box.center.position());
  const double distance = displacement.norm();
  if (distance == 0.0) {
    return false;
  }
  const Eigen::Vector2d direction = displacement / distance;
  const double seen =
      0.5 * (extentAlong(present_.box, direction) + extentAlong(anchor_.box, direction));
  const double standing_length = (1.0 + options.unseen_share) * extentAlong(longest_, direction);
  const double overrun = distance - (1.0 - free_share_) * (standing_length - seen);
  const double deviation =
      std::sqrt(direction.dot((present_.covariance + anchor_.covariance) * direction));
  return overrun >= options.min_overrun && overrun >= options.overrun_significance * deviation;
}

}  // namespace datmo
