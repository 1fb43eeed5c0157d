// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/road_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include <Eigen/Cholesky>

#include "datmo_fusion/grid/row_major.h"
#include "datmo_fusion/sensor_model/stereo_view.h"

namespace datmo {

namespace {

/// Maximum number of points that are used: a few for each square meter.
constexpr std::size_t kMaxSamples = 8000;

/// m; side of the cells that have one vote each.
constexpr double kVoteSize = 1.0;

/// Minimum number of samples for a cell's vote.
constexpr int kMinSamples = 2;

/// One round of the fit: how far out its points may be, as a share of the distance, and how far
/// from the last plane, in tolerances. Close to the vehicle, a pitch error is small in meters.
struct Round {
  double reach;
  double tolerances;
};
constexpr std::array<Round, 6> kRounds = {
    {{0.35, 6.0}, {0.35, 3.0}, {0.5, 2.5}, {0.7, 2.0}, {1.0, 2.0}, {1.0, 1.0}}};

struct Sample {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< base frame, m
  double depth = 0.0;                                  ///< m ahead of the camera
  double variance = 0.0;                               ///< m^2, of the height
};

/// The points in a square meter that are close to the last plane.
struct Vote {
  Eigen::Vector3d position_sum = Eigen::Vector3d::Zero();
  double variance_sum = 0.0;
  int count = 0;

  /// `is_near`: whether the sample, which is finite, counts. Without a branch, because walls and
  /// objects make it unpredictable.
  void add(const Sample& sample, bool is_near) {
    const auto weight = static_cast<double>(is_near);
    position_sum += weight * sample.position;
    variance_sum += weight * sample.variance;
    count += static_cast<int>(is_near);
  }
};

/// Plane through the votes, each weighted by the variance of its height; none if there are too few.
class PlaneFit {
 public:
  void add(const Eigen::Vector3d& position, double variance) {
    const Eigen::Vector3d row(1.0, position.x(), position.y());
    information_ += row * row.transpose() / variance;
    sum_ += row * position.z() / variance;
    ++votes_;
  }

  int votes() const { return votes_; }

  RoadPlane plane() const {
    const Eigen::Vector3d solution = information_.ldlt().solve(sum_);
    return {solution[0], solution[1], solution[2]};
  }

 private:
  Eigen::Matrix3d information_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  int votes_ = 0;
};

/// The square meters in which the road is searched for, and the points in them.
class RoadSamples {
 public:
  RoadSamples(const StereoCloud& cloud, const RoadPlaneOptions& options)
      : options_(options),
        camera_(cloud.camera),
        camera_height_(cloud.camera_in_base.translation().z()),
        columns_(static_cast<int>(std::ceil(2.0 * options.half_width / kVoteSize))),
        cells_(
            rowMajorSize(columns_, static_cast<int>(std::ceil(options.max_distance / kVoteSize)))) {
    const StereoView view(cloud, RoadPlane());
    std::vector<Sample> samples;
    std::vector<std::size_t> cells;  // in which each of them votes
    samples.reserve(kMaxSamples);
    cells.reserve(kMaxSamples);
    for (const Eigen::Vector3f& point : pointsOf(cloud.points)) {
      add(point, view, cloud.camera_in_base, samples, cells);
    }
    sortByCell(samples, cells);
  }

  /// Fits a plane to the samples close to a given one.
  PlaneFit fitNear(const RoadPlane& plane, const Round& round) const {
    const double reach = round.reach * options_.max_distance;
    const double tolerance = round.tolerances * options_.tolerance;
    PlaneFit fit;
    for (std::size_t cell = 0; cell + 1 < begin_.size(); ++cell) {
      Vote vote;
      for (std::size_t i = begin_[cell]; i < begin_[cell + 1]; ++i) {
        const Sample& sample = samples_[i];
        const double height = plane.heightOf(sample.position);
        const bool is_level = height * height < tolerance * tolerance + 4.0 * sample.variance;
        vote.add(sample, is_level & (sample.depth < reach));
      }
      if (vote.count >= kMinSamples) {
        fit.add(vote.position_sum / vote.count,
                options_.tolerance * options_.tolerance + vote.variance_sum / vote.count);
      }
    }
    return fit;
  }

 private:
  /// Points spread over the cloud, which is larger than a cache: read before any of them is used,
  /// because the processor can then wait for many at a time.
  static std::vector<Eigen::Vector3f> pointsOf(const PointsView& cloud) {
    const std::size_t stride = cloud.count / kMaxSamples + 1;
    std::vector<Eigen::Vector3f> points;
    points.reserve(kMaxSamples);
    for (std::size_t begin = 0; begin + stride <= cloud.count; begin += stride) {
      points.push_back(cloud[begin + offset(begin / stride, stride)]);
    }
    return points;
  }

  /// Keeps the order within each cell.
  void sortByCell(const std::vector<Sample>& samples, const std::vector<std::size_t>& cells) {
    begin_.assign(cells_ + 1, 0);
    for (const std::size_t cell : cells) {
      ++begin_[cell + 1];
    }
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    samples_.resize(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
      samples_[next[cells[i]]++] = samples[i];
    }
  }

  void add(const Eigen::Vector3f& point, const StereoView& view,
           const Eigen::Isometry3d& camera_in_base, std::vector<Sample>& samples,
           std::vector<std::size_t>& cells) const {
    const ViewedPoint seen = view(point);
    const double depth = seen.forward;
    const double column = (seen.right + options_.half_width) / kVoteSize;
    // Comparisons in this order exclude NaN.
    if (depth > 0.0 && depth < options_.max_distance && column >= 0.0 &&
        column < static_cast<double>(columns_)) {
      const auto row = static_cast<int>(depth / kVoteSize);
      // A line of sight drops by the camera's height over the distance to the road, so a depth that
      // is off by its standard deviation raises or lowers the point.
      const double sigma = camera_height_ * camera_.depthSigma(depth) / depth;
      samples.push_back({camera_in_base * point.cast<double>(), depth, sigma * sigma});
      cells.push_back(rowMajorIndex(static_cast<int>(column), row, columns_));
    }
  }

  /// Index of the point taken from a block of `stride`: spread by the golden ratio, so that for no
  /// image width all of them fall on the same columns.
  static std::size_t offset(std::size_t block, std::size_t stride) {
    constexpr double kGolden = 0.6180339887498949;
    const double turns = static_cast<double>(block) * kGolden;
    const double rest = turns - static_cast<double>(static_cast<std::size_t>(turns));
    return static_cast<std::size_t>(rest * static_cast<double>(stride));
  }

  const RoadPlaneOptions& options_;
  StereoCamera camera_;
  double camera_height_;  ///< m
  int columns_;
  std::size_t cells_;
  std::vector<Sample> samples_;     ///< cell by cell, nearest row first
  std::vector<std::size_t> begin_;  ///< index of each cell's first sample; one more than cells
};

}  // namespace

void RoadPlaneOptions::visit(OptionVisitor& visitor) {
  visitor.toggle({"estimate", "",
                  "estimate the road plane from the points; false: the road is flat, z = 0 of the "
                  "vehicle's frame (thesis 3.2.2)"},
                 estimate);
  visitor.number({"max_distance", "m", "how far ahead of the camera the road is searched for"},
                 max_distance, {5.0, 100.0});
  visitor.number({"half_width", "m", "how far to either side of the camera"}, half_width,
                 {1.0, 50.0});
  visitor.number({"tolerance", "m",
                  "points farther from the plane do not belong to the road: less than a curb's "
                  "height; the noise of their depth is allowed in addition"},
                 tolerance, {0.01, 0.5});
  visitor.integer(
      {"min_cells", "1", "minimum area of road that supports a plane, in square meters"}, min_cells,
      {3, 1000});
  visitor.number(
      {"max_slope", "m/m", "a plane steeper than this relative to the vehicle is not the road"},
      max_slope, {0.0, 0.5});
  visitor.number({"max_height", "m", "nor is one farther from the vehicle's z = 0 at its origin"},
                 max_height, {0.0, 2.0});
}

RoadPlaneEstimator::RoadPlaneEstimator(const Checked<RoadPlaneOptions>& options)
    : options_(*options) {}

std::optional<RoadPlane> RoadPlaneEstimator::update(const StereoCloud& cloud) {
  if (!options_.estimate) {
    return std::nullopt;
  }
  const RoadSamples road(cloud, options_);
  RoadPlane plane = last_;
  bool seen = false;
  for (const Round& round : kRounds) {
    const PlaneFit fit = road.fitNear(plane, round);
    seen = fit.votes() >= options_.min_cells;
    if (seen) {
      plane = fit.plane();
    }
  }
  // With comparisons in this order, a plane with NaN is not credible.
  const bool credible = plane.heightOf(cloud.camera_in_base.translation()) > 0.0 &&
                        std::abs(plane.height) <= options_.max_height &&
                        std::hypot(plane.slope_x, plane.slope_y) <= options_.max_slope;
  if (!seen || !credible) {
    return std::nullopt;
  }
  last_ = plane;
  return plane;
}

}  // namespace datmo
