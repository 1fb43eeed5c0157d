// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/track_combination.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "datmo_fusion/common/angle.h"

namespace datmo {

namespace {

/// rad; headings that differ by more are not one heading with noise: one of them is wrong.
constexpr double kMaxTurn = 0.3;

/// rad^2; nobody knows a heading better.
constexpr double kMinHeadingVariance = 1e-6;

/// m^2, of a box's center along an axis: no weight is without end.
constexpr double kMinCenterVariance = 1e-9;

double headingOf(const Track& track) { return track.box.center.heading(); }

double headingVarianceOf(const Track& track) {
  return std::clamp(track.heading_variance, kMinHeadingVariance, kUnknownHeadingVariance);
}

/// Whether the front is where a takes it to be, and not at the other end as b says. Who moves knows
/// it; if both do, their information on the velocity decides.
bool aKnowsFront(const Track& a, const Track& b, const TrackState& fused) {
  if (a.moving != b.moving) {
    return a.moving;
  }
  const auto order = [&](const Track& track) {
    const double ahead = Point2(fused.segment<2>(2)).dot(track.box.center.rotation().col(0));
    return std::make_tuple(ahead < 0.0, headingVarianceOf(track), headingOf(track));
  };
  return order(a) <= order(b);
}

struct Heading {
  double value;     ///< rad
  double variance;  ///< rad^2
};

/// Modulo pi by the variances, then the front. Both follow the same motion, so that the result is
/// weighted as by covariance intersection: it is never surer than the surer one.
Heading fusedHeading(const Track& a, const Track& b, const TrackState& fused) {
  const double of_a = headingVarianceOf(a);
  const double of_b = headingVarianceOf(b);
  const double turn = angleBetween(headingOf(a), headingOf(b));
  const bool opposite = std::abs(turn) > kQuarterTurn;
  // Of the axes, whichever end of them is the front.
  const double apart = opposite ? normalizeAngle(turn + kPi) : turn;
  double share_of_b = of_a / (of_a + of_b);
  Heading heading{};
  if (std::abs(apart) > kMaxTurn) {
    const bool a_is_surer =
        std::make_tuple(of_a, headingOf(a)) <= std::make_tuple(of_b, headingOf(b));
    share_of_b = a_is_surer ? 0.0 : 1.0;
    heading.variance = std::min(of_a, of_b);
  } else {
    const double share_of_a = 1.0 - share_of_b;
    heading.variance = 1.0 / (share_of_a / of_a + share_of_b / of_b);
    share_of_b = share_of_b / of_b * heading.variance;
  }
  heading.value = headingOf(a) + share_of_b * apart;
  if (opposite && !aKnowsFront(a, b, fused)) {
    heading.value += kPi;
  }
  heading.value = normalizeAngle(heading.value);
  return heading;
}

/// Extents of a box along the axes of another heading, and what is known of its center there.
struct AxisSizes {
  Eigen::Vector2d size;      ///< m
  Eigen::Vector2d variance;  ///< m^2
};

AxisSizes sizesAlong(double heading, const Track& track) {
  const Box2& box = track.box;
  const double turn = std::abs(std::sin(heading - headingOf(track)));
  const bool across = turn > std::sqrt(0.5);
  const Eigen::Matrix2d axes = Pose2(0.0, 0.0, heading).rotation();
  const Eigen::Matrix2d along = axes.transpose() * track.covariance.topLeftCorner<2, 2>() * axes;
  return {across ? Eigen::Vector2d(box.width, box.length) : Eigen::Vector2d(box.length, box.width),
          along.diagonal().cwiseMax(kMinCenterVariance)};
}

Box2 fusedBox(const Track& a, const Track& b, const Pose2& center) {
  const AxisSizes of_a = sizesAlong(center.heading(), a);
  const AxisSizes of_b = sizesAlong(center.heading(), b);
  const Eigen::Vector2d size =
      (of_a.size.cwiseProduct(of_b.variance) + of_b.size.cwiseProduct(of_a.variance))
          .cwiseQuotient(of_a.variance + of_b.variance);
  return {center, size.x(), size.y()};
}

template <typename Value>
std::vector<Value> sortedUnion(const std::vector<Value>& a, const std::vector<Value>& b) {
  std::vector<Value> all = a;
  all.insert(all.end(), b.begin(), b.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::uint32_t saturatedSum(std::uint32_t a, std::uint32_t b) {
  return a + std::min(b, std::numeric_limits<std::uint32_t>::max() - a);
}

/// Each with as much say as the other; who knows nothing of it has none.
std::array<double, kMotionModes> averagedModes(const std::array<double, kMotionModes>& a,
                                               const std::array<double, kMotionModes>& b) {
  const double of_a = std::accumulate(a.begin(), a.end(), 0.0);
  const double of_b = std::accumulate(b.begin(), b.end(), 0.0);
  const double parts = (of_a > 0.0 ? 1.0 : 0.0) + (of_b > 0.0 ? 1.0 : 0.0);
  std::array<double, kMotionModes> modes{};
  for (std::size_t i = 0; i < modes.size(); ++i) {
    modes[i] = ((of_a > 0.0 ? a[i] / of_a : 0.0) + (of_b > 0.0 ? b[i] / of_b : 0.0)) /
               std::max(parts, 1.0);
  }
  return modes;
}

std::vector<SourceTrack> mergedSources(const Track& a, const Track& b) {
  std::vector<SourceTrack> all = a.sources;
  all.insert(all.end(), b.sources.begin(), b.sources.end());
  const auto key = [](const SourceTrack& one) { return std::tie(one.source, one.id); };
  std::sort(all.begin(), all.end(), [&](const SourceTrack& one, const SourceTrack& other) {
    return key(one) < key(other);
  });
  all.erase(std::unique(all.begin(), all.end(),
                        [&](const SourceTrack& one, const SourceTrack& other) {
                          return key(one) == key(other);
                        }),
            all.end());
  return all;
}

}  // namespace

Track combined(Track a, const Track& b, bool contradict, const CrossCovariance& cross,
               const TrackCombinationOptions& options) {
  const StateEstimate of_a{a.state, a.covariance};
  const StateEstimate of_b{b.state, b.covariance};
  const StateEstimate estimate =
      contradict ? mixtureOf(of_a, of_b) : fusedState(of_a, of_b, cross, options);
  const Heading heading = fusedHeading(a, b, estimate.mean);
  a.box = fusedBox(a, b, Pose2(estimate.mean.head<2>(), heading.value));
  a.heading_variance = heading.variance;
  a.state = estimate.mean;
  a.covariance = estimate.covariance;
  a.height = std::max(a.height, b.height);
  a.mode_probabilities = averagedModes(a.mode_probabilities, b.mode_probabilities);
  a.yaw_rate = 0.5 * (a.yaw_rate + b.yaw_rate);
  a.moving = a.moving || b.moving;
  a.class_probabilities = jointBelief(a.class_probabilities, b.class_probabilities);
  a.since_update = std::min(a.since_update, b.since_update);
  a.hits = saturatedSum(a.hits, b.hits);
  a.sensors = sortedUnion(a.sensors, b.sensors);
  a.sources = mergedSources(a, b);
  a.objects.clear();
  return a;
}

}  // namespace datmo
