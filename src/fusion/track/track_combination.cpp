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

/// rad; headings that differ by more are not noisy versions of the same one: one of them is wrong.
constexpr double kMaxTurn = 0.3;

/// rad^2; lower limit of heading variances.
constexpr double kMinHeadingVariance = 1e-6;

/// m^2, minimum variance of a box's center along an axis: limits the weights.
constexpr double kMinCenterVariance = 1e-9;

double headingOf(const Track& track) { return track.box.center.heading(); }

double headingVarianceOf(const Track& track) {
  return std::clamp(track.heading_variance, kMinHeadingVariance, kUnknownHeadingVariance);
}

/// The track that knows best which end is the front: a moving one; among several, the one with the
/// most information on the velocity.
const Track& mostCertainFront(const std::vector<Track>& tracks, const TrackState& fused) {
  const auto order = [&](const Track& track) {
    const double ahead = Point2(fused.segment<2>(2)).dot(track.box.center.rotation().col(0));
    return std::make_tuple(!track.moving, ahead < 0.0, headingVarianceOf(track), headingOf(track));
  };
  return *std::min_element(tracks.begin(), tracks.end(),
                           [&](const Track& a, const Track& b) { return order(a) < order(b); });
}

struct Heading {
  double value;     ///< rad
  double variance;  ///< rad^2
};

/// Fuses the headings modulo pi, weighted by variance, of those that agree with the most certain
/// one; then chooses the front. All observe the same motion, so the variance is that of covariance
/// intersection: never less than that of the most certain one.
Heading fusedHeading(const std::vector<Track>& tracks, const TrackState& fused) {
  const Track& surest =
      *std::min_element(tracks.begin(), tracks.end(), [](const Track& a, const Track& b) {
        return std::make_tuple(headingVarianceOf(a), headingOf(a)) <
               std::make_tuple(headingVarianceOf(b), headingOf(b));
      });
  double weights = 0.0;
  double information = 0.0;
  double pull = 0.0;
  for (const Track& track : tracks) {
    const double turn = angleBetween(headingOf(surest), headingOf(track));
    // Angle between the axes, regardless of which end is the front.
    const double apart = std::abs(turn) > kQuarterTurn ? normalizeAngle(turn + kPi) : turn;
    if (std::abs(apart) <= kMaxTurn) {
      const double weight = 1.0 / headingVarianceOf(track);
      weights += weight;
      information += weight * weight;
      pull += weight * weight * apart;
    }
  }
  Heading heading{headingOf(surest) + pull / information, weights / information};
  const double front = headingOf(mostCertainFront(tracks, fused));
  if (std::abs(angleBetween(heading.value, front)) > kQuarterTurn) {
    heading.value += kPi;
  }
  heading.value = normalizeAngle(heading.value);
  return heading;
}

/// Extents of a box along the axes of another heading, and the variance of its center there.
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

Box2 fusedBox(const std::vector<Track>& tracks, const Pose2& center) {
  Eigen::Vector2d weights = Eigen::Vector2d::Zero();
  Eigen::Vector2d sizes = Eigen::Vector2d::Zero();
  for (const Track& track : tracks) {
    const AxisSizes own = sizesAlong(center.heading(), track);
    weights += own.variance.cwiseInverse();
    sizes += own.size.cwiseQuotient(own.variance);
  }
  const Eigen::Vector2d size = sizes.cwiseQuotient(weights);
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

/// Averages the modes with equal weights; tracks without information have none.
std::array<double, kMotionModes> averagedModes(const std::vector<Track>& tracks) {
  std::array<double, kMotionModes> modes{};
  double parts = 0.0;
  for (const Track& track : tracks) {
    const auto& own = track.mode_probabilities;
    const double sum = std::accumulate(own.begin(), own.end(), 0.0);
    if (sum > 0.0) {
      parts += 1.0;
      std::transform(own.begin(), own.end(), modes.begin(), modes.begin(),
                     [sum](double one, double before) { return before + one / sum; });
    }
  }
  for (double& mode : modes) {
    mode /= std::max(parts, 1.0);
  }
  return modes;
}

ClassProbabilities jointClass(const std::vector<Track>& tracks) {
  std::vector<ClassProbabilities> beliefs;
  beliefs.reserve(tracks.size());
  for (const Track& track : tracks) {
    beliefs.push_back(track.class_probabilities);
  }
  return jointBelief(beliefs);
}

double averagedYawRate(const std::vector<Track>& tracks) {
  const double sum =
      std::accumulate(tracks.begin(), tracks.end(), 0.0,
                      [](double before, const Track& one) { return before + one.yaw_rate; });
  return sum / static_cast<double>(tracks.size());
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

/// Adds everything that accumulates over the tracks.
void addEvidence(Track& whole, const Track& track) {
  whole.height = std::max(whole.height, track.height);
  whole.moving = whole.moving || track.moving;
  whole.since_update = std::min(whole.since_update, track.since_update);
  whole.hits = saturatedSum(whole.hits, track.hits);
  whole.sensors = sortedUnion(whole.sensors, track.sensors);
  whole.sources = mergedSources(whole, track);
}

}  // namespace

Track combined(const std::vector<Track>& tracks, bool contradict, const CrossCovarianceOf& cross,
               const TrackCombinationOptions& options) {
  std::vector<StateEstimate> estimates;
  estimates.reserve(tracks.size());
  for (const Track& track : tracks) {
    estimates.push_back({track.state, track.covariance});
  }
  const StateEstimate estimate =
      contradict ? mixtureOf(estimates) : fusedState(estimates, cross, options);
  const Heading heading = fusedHeading(tracks, estimate.mean);
  Track whole = tracks.front();
  whole.box = fusedBox(tracks, Pose2(estimate.mean.head<2>(), heading.value));
  whole.heading_variance = heading.variance;
  whole.state = estimate.mean;
  whole.covariance = estimate.covariance;
  whole.mode_probabilities = averagedModes(tracks);
  whole.yaw_rate = averagedYawRate(tracks);
  whole.class_probabilities = jointClass(tracks);
  for (auto track = tracks.begin() + 1; track != tracks.end(); ++track) {
    addEvidence(whole, *track);
  }
  whole.objects.clear();
  return whole;
}

}  // namespace datmo
