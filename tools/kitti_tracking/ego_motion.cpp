// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/ego_motion.h"

#include <cmath>
#include <optional>

#include <Eigen/LU>

namespace datmo::kitti {

namespace {

using State = Eigen::Vector2d;

/// It converges long before, unless matches come and go.
constexpr int kMaxIterations = 10;
/// Smaller steps are below the accuracy of a pose.
constexpr double kSettledSpeed = 1e-3;    // m/s
constexpr double kSettledYawRate = 1e-5;  // rad/s

/// Spacing of the motions that are tried when little is known about them, m per step: the matches
/// within this distance are found from either of two.
constexpr double kSearchStep = 0.5;
/// Distance at which a turn corresponds to this step, m.
constexpr double kSearchRange = 40.0;
/// Number of standard deviations that are searched.
constexpr double kSearchSigmas = 2.0;

/// A measured position, and the expected position nearest to it.
struct Match {
  Point2 difference;  ///< m, from the expected position to the observed one, vehicle's frame
  Point2 expected;    ///< m, vehicle's frame
  Eigen::Matrix2d information;  ///< 1/m^2, of the difference
  double distance2() const { return difference.dot(information * difference); }
};

/// One step of the vehicle: expected positions in its frame before the step, observed ones in its
/// frame after it.
struct Step {
  double seconds;
  std::vector<Landmark> expected;
  const std::vector<Landmark>& seen;
  double gate;              ///< m
  double outlier_distance;  ///< 1

  std::optional<Match> match(const Landmark& observation, const Pose2& before_in_after) const;
  std::vector<Match> matches(const State& state) const;

  /// Weight of a match: small if it is off by more than outlier_distance.
  double weightOf(const Match& match) const {
    const double far = match.distance2() / (outlier_distance * outlier_distance);
    return 1.0 / ((1.0 + far) * (1.0 + far));
  }

  /// Negative log-likelihood that has these weights, up to a constant; without a match, its value
  /// at the gate.
  double cost(const State& state) const;
};

std::optional<Match> Step::match(const Landmark& observation, const Pose2& before_in_after) const {
  const Landmark* nearest = nullptr;
  Match match;
  double min = gate * gate;
  for (const Landmark& landmark : expected) {
    const Point2 point = before_in_after * landmark.position;
    const Point2 difference = observation.position - point;
    if (difference.squaredNorm() < min) {
      min = difference.squaredNorm();
      nearest = &landmark;
      match.difference = difference;
      match.expected = point;
    }
  }
  if (nearest == nullptr) {
    return std::nullopt;
  }
  const Eigen::Matrix2d turn = before_in_after.rotation();
  match.information =
      (turn * nearest->covariance * turn.transpose() + observation.covariance).inverse();
  return match;
}

Pose2 motionOf(const State& state, double seconds) { return arc({state[0], state[1]}, seconds); }

std::vector<Match> Step::matches(const State& state) const {
  const Pose2 before_in_after = motionOf(state, seconds).inverse();
  std::vector<Match> result;
  result.reserve(seen.size());
  for (const Landmark& observation : seen) {
    if (const auto found = match(observation, before_in_after)) {
      result.push_back(*found);
    }
  }
  return result;
}

double Step::cost(const State& state) const {
  const double scale = outlier_distance * outlier_distance;
  const std::vector<Match> found = matches(state);
  double sum = static_cast<double>(seen.size() - found.size());
  for (const Match& match : found) {
    sum += match.distance2() / (scale + match.distance2());
  }
  return 0.5 * scale * sum;
}

/// Jacobian of a landmark's position in the vehicle's frame with respect to speed and yaw rate.
Eigen::Matrix2d jacobian(const Point2& point, const State& state, double seconds) {
  const double half_turn = 0.5 * state[1] * seconds;
  const double c = std::cos(half_turn);
  const double s = std::sin(half_turn);
  const double sideways = 0.5 * state[0] * seconds * seconds;
  Eigen::Matrix2d result;
  result.col(0) = -seconds * Point2(c, -s);
  result.col(1) = -seconds * Point2(-point.y(), point.x()) - sideways * Point2(s, c);
  return result;
}

/// Estimate of speed and yaw rate.
struct Gaussian {
  State mean;
  Eigen::Matrix2d information;
};

/// Number of values to try on either side of the most likely one.
int searchSteps(double sigma, double step) {
  return static_cast<int>(kSearchSigmas * sigma / step);
}

/// The most likely of several speeds and yaw rates: the correction finds the nearest optimum only.
State searched(const Step& step, const Gaussian& prior) {
  const State sigma = prior.information.inverse().diagonal().cwiseSqrt();
  const State grid = State(kSearchStep, kSearchStep / kSearchRange) / step.seconds;
  const int speeds = searchSteps(sigma[0], grid[0]);
  const int yaw_rates = searchSteps(sigma[1], grid[1]);
  State best = prior.mean;
  double min = step.cost(best);
  for (int i = -speeds; i <= speeds; ++i) {
    for (int j = -yaw_rates; j <= yaw_rates; ++j) {
      const State off(i * grid[0], j * grid[1]);
      const double cost = step.cost(prior.mean + off) + 0.5 * off.dot(prior.information * off);
      if (cost < min) {
        min = cost;
        best = prior.mean + off;
      }
    }
  }
  return best;
}

/// Gauss-Newton steps from `start` to the most likely state; the prior if too little is seen.
Gaussian correct(const Step& step, const Gaussian& prior, State start, std::size_t min_matches) {
  Gaussian result{start, prior.information};
  for (int i = 0; i < kMaxIterations; ++i) {
    const std::vector<Match> matches = step.matches(result.mean);
    if (matches.size() < min_matches) {
      return prior;
    }
    Eigen::Matrix2d information = prior.information;
    State pull = prior.information * (prior.mean - result.mean);
    for (const Match& match : matches) {
      const Eigen::Matrix2d slope = jacobian(match.expected, result.mean, step.seconds);
      const Eigen::Matrix2d weighted = step.weightOf(match) * slope.transpose() * match.information;
      information += weighted * slope;
      pull += weighted * match.difference;
    }
    const State change = information.inverse() * pull;
    result = {result.mean + change, information};
    if (std::abs(change[0]) < kSettledSpeed && std::abs(change[1]) < kSettledYawRate) {
      break;
    }
  }
  return result;
}

}  // namespace

void EgoMotionOptions::visit(OptionVisitor& visitor) {
  visitor.number({"acceleration_std", "m/s^2", "standard deviation of the vehicle's acceleration"},
                 acceleration_std, {0.01, 20.0});
  visitor.number({"yaw_acceleration_std", "rad/s^2",
                  "standard deviation of the change of the vehicle's yaw rate"},
                 yaw_acceleration_std, {0.001, 10.0});
  visitor.number({"first_speed_std", "m/s", "standard deviation of the speed at the beginning"},
                 first_speed_std, {0.1, 50.0});
  visitor.number(
      {"first_yaw_rate_std", "rad/s", "standard deviation of the yaw rate at the beginning"},
      first_yaw_rate_std, {0.001, 2.0});
  visitor.number({"gate", "m", "an object farther than this from every prediction is new, or lost"},
                 gate, {0.1, 20.0});
  visitor.number({"outlier_distance", "1",
                  "a match with an error of this many standard deviations counts half"},
                 outlier_distance, {0.5, 10.0});
  visitor.integer({"min_matches", "1", "with fewer, speed and yaw rate are kept"}, min_matches,
                  {1, 100});
}

EgoMotion::EgoMotion(const EgoMotionOptions& options) : options_(options) {
  checkOptions(options);
  covariance_ = State(options.first_speed_std, options.first_yaw_rate_std)
                    .cwiseAbs2()
                    .asDiagonal()
                    .toDenseMatrix();
}

void EgoMotion::step(double seconds, const std::vector<Landmark>& expected,
                     const std::vector<Landmark>& seen) {
  Step step{seconds, {}, seen, options_.gate, options_.outlier_distance};
  const Pose2 fixed_in_base = base_in_fixed_.inverse();
  const Eigen::Matrix2d turn = fixed_in_base.rotation();
  for (const Landmark& landmark : expected) {
    step.expected.push_back(
        {fixed_in_base * landmark.position, turn * landmark.covariance * turn.transpose()});
  }
  covariance_.diagonal() +=
      (seconds * State(options_.acceleration_std, options_.yaw_acceleration_std)).cwiseAbs2();
  const Gaussian prior{state_, covariance_.inverse()};
  const auto min_matches = static_cast<std::size_t>(options_.min_matches);
  const Gaussian corrected = correct(step, prior, searched(step, prior), min_matches);
  state_ = corrected.mean;
  covariance_ = corrected.information.inverse();
  base_in_fixed_ = base_in_fixed_ * motionOf(state_, seconds);
}

}  // namespace datmo::kitti
