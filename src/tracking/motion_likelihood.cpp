// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/motion_likelihood.h"

#include <algorithm>
#include <cmath>

#include "grazing.h"
#include <Eigen/LU>

#include "datmo_fusion/common/log_beta.h"
#include "datmo_fusion/common/square.h"
#include "datmo_fusion/tracking/beam_positions.h"

namespace datmo {

namespace {

/// Probability that a normal variable of this standard deviation, centered on `offset`, lies within
/// +-`half`: by the nearer end only, because the farther one hardly matters.
double insideProbability(double offset, double half, double sigma) {
  return 0.5 * std::erfc((std::abs(offset) - half) / (std::sqrt(2.0) * sigma));
}

/// The positions of the moving body at other times.
class Coverage {
 public:
  Coverage(const MovingBody& body, double range_sigma)
      : body_(body), fixed_in_box_(body.box.center.inverse()), range_sigma_(range_sigma) {}

  /// Probability that the body, `since` s ago, lay within the tolerance of a beam's crossing point.
  double at(const BeamCrossing& crossing, double since) const {
    const Point2 in_box = fixed_in_box_ * (crossing.position + since * body_.velocity);
    const Point2 reach = crossing.tolerance * fixed_in_box_.rotate(crossing.along_beam).cwiseAbs();
    const double drift = square(range_sigma_) + square(since) * body_.speed_variance;
    const auto along = [&](double offset, double half, double size_variance) {
      // A side is off by half of the size error.
      return insideProbability(offset, half, std::sqrt(drift + 0.25 * size_variance));
    };
    return along(in_box.x(), 0.5 * body_.box.length + reach.x(), body_.size_variance.x()) *
           along(in_box.y(), 0.5 * body_.box.width + reach.y(), body_.size_variance.y());
  }

 private:
  const MovingBody& body_;
  Pose2 fixed_in_box_;
  double range_sigma_;
};

/// Beams that crossed positions of a target; partial counts for weighted beams.
struct CrossingBeams {
  double hits = 0.0;
  double misses = 0.0;
  double expected_hits = 0.0;  ///< if something stands there, by the options' detection
  double log_moving = 0.0;     ///< log-likelihood if it moves
  std::size_t observed = 0;

  void add(BeamOutcome outcome, double covered, double detection, double background) {
    const double hit = covered * detection + (1.0 - covered) * background;
    const bool ends = outcome == BeamOutcome::kHit;
    (ends ? hits : misses) += 1.0;
    expected_hits += detection;
    log_moving += std::log(ends ? hit : 1.0 - hit);
    ++observed;
  }

  void add(const CrossingBeams& other, double weight) {
    hits += weight * other.hits;
    misses += weight * other.misses;
    expected_hits += weight * other.expected_hits;
    log_moving += weight * other.log_moving;
    observed += other.observed;
  }

  /// Log-likelihood if it stands: its reflectivity is a beta variable.
  double logStanding(double detection_strength) const {
    const double expected = expected_hits / (hits + misses);
    const double prior_hits = detection_strength * expected;
    const double prior_misses = detection_strength * (1.0 - expected);
    return logBeta(prior_hits + hits, prior_misses + misses) - logBeta(prior_hits, prior_misses);
  }

  BeamEvidence evidence(double detection_strength) const {
    return observed == 0 ? BeamEvidence{}
                         : BeamEvidence{log_moving - logStanding(detection_strength), 0.0, 0.0,
                                        observed, false};
  }
};

/// Evaluates the beams of one scan at the positions of `seen`, at `time` on its clock.
class ScanBeams {
 public:
  ScanBeams(const ScanHistory& history, const MovingBody& body, double clock,
            const MotionLikelihoodOptions& options)
      : history_(history),
        coverage_(body, 0.5 * history.tolerance()),
        clock_(clock),
        options_(options) {}

  /// `echo_direction`: of the surface at single echoes; zero: it faces the beam.
  CrossingBeams of(std::size_t back, double time, const SeenPoints& seen,
                   const Point2& echo_direction) const {
    CrossingBeams beams;
    const double detection = seen.is_echo ? options_.echo_detection : options_.detection;
    for (const ReflectionPoint& point : seen.points) {
      const Point2& direction = point.direction.isZero() ? echo_direction : point.direction;
      const BeamCrossing crossing = history_.look(back, {point.position, direction});
      if (crossing.outcome != BeamOutcome::kNothing) {
        const double covered = coverage_.at(crossing, clock_ - time);
        beams.add(crossing.outcome, covered, detection, options_.background);
      }
    }
    return beams;
  }

 private:
  const ScanHistory& history_;
  Coverage coverage_;
  double clock_;
  const MotionLikelihoodOptions& options_;
};

}  // namespace

void MotionLikelihoodOptions::visit(OptionVisitor& visitor) {
  constexpr Bounds kProbability{0.01, 0.99};
  constexpr Bounds kError{1e-6, 0.5};
  visitor.number({"window", "s",
                  "how far back the beams are examined that crossed positions where a target was "
                  "seen; slow targets need longer to leave their position"},
                 window, {0.1, 60.0});
  visitor.number(
      {"detection", "1", "probability that a beam ends on a surface that it meets, on average"},
      detection, kProbability);
  visitor.number(
      {"detection_strength", "1",
       "how similarly surfaces reflect: the beta distribution of their detection has the weight of "
       "this many beams; few: a missed beam may be due to an edge or a hedge that reflects badly"},
      detection_strength, {0.1, 1e6});
  visitor.number({"echo_detection", "1", "the same near a single echo, whose extent is unknown"},
                 echo_detection, kProbability);
  visitor.number({"background", "1", "probability that a beam ends where nothing was seen before"},
                 background, kProbability);
  visitor.number(
      {"grazing_share", "1",
       "share of single stationary echoes that keep their bearing: ends of a beam along a wall"},
      grazing_share, kProbability);
  visitor.number({"free_path", "m",
                  "distance to each side of the vehicle's path without such a wall: half of a lane "
                  "of 3.5 m; indoors half of what the robot needs"},
                 free_path, {0.0, 10.0});
  visitor.number({"apparent_motion", "1",
                  "probability that a stationary object seems to move: its visible part slides, or "
                  "echoes of different objects were joined"},
                 apparent_motion, kError);
  visitor.number({"apparent_box_motion", "1",
                  "the same for objects on which no beam ended: boxes of a camera or of another "
                  "detector, which slide less than the few echoes of a scanner"},
                 apparent_box_motion, kError);
  visitor.number({"wrong_velocity", "1",
                  "the same for objects whose velocity a sensor measures: the velocity was that of "
                  "something else"},
                 wrong_velocity, kError);
  visitor.number({"moving_prior", "1",
                  "prior probability that a new target moves, before any beam is considered: "
                  "objects that the map knows to be static start none"},
                 moving_prior, kProbability);
  visitor.number({"required_probability", "1",
                  "probability from which a target is considered moving: sweeping it draws the "
                  "operating curve of missed frames against false tracks",
                  Tier::kLive},
                 required_probability, {0.5, 0.9999});
}

BeamEvidence beamEvidence(const ScanHistory& history, const SeenPointHistory& seen,
                          const MovingBody& body, Stamp now, double clock,
                          const MotionLikelihoodOptions& options) {
  const ScanBeams scan_beams(history, body, clock, options);
  const BeamPositions positions(history, seen, now, clock);
  const auto sumWith = [&](const Point2& echo_direction) {
    CrossingBeams sum;
    for (std::size_t back = 0; back < history.size(); ++back) {
      const double time = clock + secondsBetween(now, history.stamp(back));
      if (time < clock - options.window) {
        break;
      }
      CrossingBeams of_scan;
      int asked = 0;
      for (const BeamPositions::OfScan& seen_in_scan : positions.scans()) {
        if (seen_in_scan.back != back) {  // its own beams carry no new information
          of_scan.add(scan_beams.of(back, time, seen_in_scan.points, echo_direction), 1.0);
          ++asked;
        }
      }
      sum.add(of_scan, 1.0 / std::max(1, asked));
    }
    return sum.evidence(options.detection_strength);
  };
  BeamEvidence evidence = sumWith(Point2::Zero());
  evidence.by_others = positions.areOfOthers();
  evidence.grazing_share = grazingShare(history, positions, body, options);
  if (evidence.grazing_share > 0.0) {
    evidence.log_ratio_to_grazing = sumWith(body.velocity.normalized()).log_ratio;
  }
  return evidence;
}

double velocityLogRatio(const Eigen::Vector2d& velocity, const Eigen::Matrix2d& covariance,
                        std::initializer_list<double> speed_stds, double apparent_motion) {
  const auto density = [&](double speed_std) {
    const Eigen::Matrix2d total = covariance + square(speed_std) * Eigen::Matrix2d::Identity();
    return std::exp(-0.5 * velocity.dot(total.inverse() * velocity)) /
           std::sqrt(total.determinant());
  };
  double moving = 0.0;
  for (const double speed_std : speed_stds) {
    moving += density(speed_std) / static_cast<double>(speed_stds.size());
  }
  const double standing = (1.0 - apparent_motion) * density(0.0) + apparent_motion * moving;
  return std::log(moving / standing);
}

double motionLogRatio(const BeamEvidence& beams, double velocity_log_ratio) {
  const double facing = beams.log_ratio + velocity_log_ratio;
  const double grazing = beams.log_ratio_to_grazing;
  return -std::log((1.0 - beams.grazing_share) * std::exp(-facing) +
                   beams.grazing_share * std::exp(-grazing));
}

double motionProbability(double log_ratio, double existence_log_odds,
                         const MotionLikelihoodOptions& options) {
  const double stands = (1.0 - options.moving_prior) / options.moving_prior;
  return 1.0 / (1.0 + stands * std::exp(-log_ratio) + std::exp(-existence_log_odds));
}

}  // namespace datmo
