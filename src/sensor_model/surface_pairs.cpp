// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/surface_pairs.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/quantile.h"
#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// Number of columns into which points are sorted: only affects speed.
constexpr int kColumns = 512;

/// 1/m; closer than this, the scanner's inverse depths do not form a plane.
constexpr double kMaxInverse = 1.0;

}  // namespace

void SurfacePairOptions::visit(OptionVisitor& visitor) {
  visitor.number({"min_height", "m",
                  "lower limit of the height above the road of the camera's points that are used"},
                 min_height, {0.0, 3.0});
  visitor.number({"max_height", "m",
                  "upper limit of that height: near the scanner's, since bodies are not upright"},
                 max_height, {0.1, 5.0});
  visitor.number({"max_range", "m", "farther surfaces are not compared"}, max_range, {2.0, 200.0});
  visitor.number(
      {"max_step", "m",
       "distance between neighboring beams of one surface, at most; more if they are wide apart"},
      max_step, {0.01, 5.0});
  visitor.integer({"min_beams", "1", "minimum number of beams on a surface"}, min_beams, {3, 100});
  visitor.number(
      {"min_incidence", "1",
       "cosine of the angle between line of sight and normal; more slanted surfaces are ignored"},
      min_incidence, {0.05, 1.0});
  visitor.number({"straightness", "m", "RMS distance of the beams' ends from their line"},
                 straightness, {0.001, 1.0});
  visitor.number({"range_sigma", "m", "standard deviation of the scanner's ranges"}, range_sigma,
                 {0.001, 2.0});
  visitor.number({"edge_pixels", "px", "at both ends of a surface, this much is ignored"},
                 edge_pixels, {0.0, 50.0});
  visitor.integer({"min_points", "1", "minimum number of the camera's points on a surface"},
                  min_points, {3, 10000});
  visitor.number(
      {"min_share", "1", "minimum share of them that agree with each other within mode_width"},
      min_share, {0.1, 1.0});
  visitor.number({"mode_width", "px", "to either side of their median"}, mode_width, {0.1, 10.0});
  visitor.number(
      {"max_difference", "px", "a larger deviation from the expected disparity is another surface"},
      max_difference, {0.5, 100.0});
}

SurfacePairFinder::SurfacePairFinder(const Checked<SurfacePairOptions>& options)
    : options_(*options), columns_(kColumns) {}

std::vector<SurfacePair> SurfacePairFinder::find(const StereoCloud& cloud,
                                                 const std::vector<Ray>& rays,
                                                 const StereoAlignment& expected,
                                                 const Twist2& twist) {
  const StereoView view(cloud, RoadPlane());
  addPoints(cloud, view);
  std::vector<SurfacePair> pairs;
  for (const Piece& piece : piecesOf(rays, view)) {
    add(piece, cloud.camera, expected, twist, pairs);
  }
  return pairs;
}

void SurfacePairFinder::addPoints(const StereoCloud& cloud, const StereoView& view) {
  left_ = cloud.camera.left_tangent;
  per_tangent_ = kColumns / (cloud.camera.right_tangent - cloud.camera.left_tangent);
  for (std::vector<InView>& column : columns_) {
    column.clear();
  }
  const auto low = static_cast<float>(options_.min_height);
  const auto high = static_cast<float>(options_.max_height);
  const auto farthest = static_cast<float>(2.0 * options_.max_range);
  for (std::size_t i = 0; i < cloud.points.count; ++i) {
    const ViewedPoint point = view(cloud.points[i]);
    if (!(point.height >= low && point.height <= high && point.forward > 0.0F &&
          point.forward < farthest)) {
      continue;
    }
    const double inverse = 1.0 / static_cast<double>(point.forward);
    const double tangent = static_cast<double>(point.right) * inverse;
    const double column = (tangent - left_) * per_tangent_;
    if (column >= 0.0 && column < kColumns) {
      columns_[static_cast<std::size_t>(column)].push_back({tangent, inverse});
    }
  }
}

bool SurfacePairFinder::goesOn(const Ray& last, const Ray& ray, const Point2& begin) const {
  const double across =
      std::abs(angleBetween(last.bearing, ray.bearing)) * std::min(ray.range, last.range);
  return ray.beam == last.beam + 1 && (ray.end - begin).norm() <= options_.max_length &&
         (ray.end - last.end).norm() <=
             std::max(options_.max_step, options_.max_step_ratio * across);
}

std::vector<SurfacePairFinder::Piece> SurfacePairFinder::piecesOf(const std::vector<Ray>& rays,
                                                                  const StereoView& view) const {
  std::vector<Piece> pieces;
  const Ray* last = nullptr;
  Point2 begin = Point2::Zero();
  for (const Ray& ray : rays) {
    if (!ray.hit) {
      last = nullptr;
      continue;
    }
    const PointInView point = view.viewedPoint(ray.end);
    if (!(point.forward > 1.0 / kMaxInverse && ray.range < options_.max_range)) {
      last = nullptr;
      continue;
    }
    if (last == nullptr || !goesOn(*last, ray, begin)) {
      pieces.emplace_back();
      begin = ray.end;
    }
    pieces.back().push_back({point.tangent(), 1.0 / point.forward});
    last = &ray;
  }
  return pieces;
}

void SurfacePairFinder::add(const Piece& piece, const StereoCamera& camera,
                            const StereoAlignment& expected, const Twist2& twist,
                            std::vector<SurfacePair>& pairs) {
  const double disparity_at_meter = camera.noise.disparity_at_meter;
  SurfacePair pair;
  if (piece.size() < static_cast<std::size_t>(options_.min_beams) ||
      !fit(piece, disparity_at_meter, pair)) {
    return;
  }
  const auto [first, last] =
      std::minmax_element(piece.begin(), piece.end(),
                          [](const InView& a, const InView& b) { return a.tangent < b.tangent; });
  const double edge = options_.edge_pixels / camera.focal_length;
  // To the left of this, the right camera may not see the surface.
  const double left = std::max(first->tangent + edge,
                               camera.left_tangent + camera.baseline * pair.inverseDepth() + edge);
  const double right = std::min(last->tangent - edge, camera.right_tangent - edge);
  const double predicted = alignmentRates(pair, disparity_at_meter, twist).dot(expected.mean);
  if (left < right && compare(left, right, disparity_at_meter, predicted, pair)) {
    pairs.push_back(pair);
  }
}

bool SurfacePairFinder::fit(const Piece& piece, double disparity_at_meter,
                            SurfacePair& pair) const {
  const auto count = static_cast<double>(piece.size());
  double tangent = 0.0;
  double inverse = 0.0;
  for (const InView& point : piece) {
    tangent += point.tangent / count;
    inverse += point.inverse / count;
  }
  double square_sum = 0.0;
  double product_sum = 0.0;
  for (const InView& point : piece) {
    square_sum += square(point.tangent - tangent);
    product_sum += (point.tangent - tangent) * (point.inverse - inverse);
  }
  if (!(square_sum > 0.0)) {
    return false;
  }
  pair.tangent = tangent;
  pair.slope = product_sum / square_sum;
  pair.intercept = inverse - pair.slope * tangent;
  double residual_sum = 0.0;
  for (const InView& point : piece) {
    residual_sum += square(point.inverse - pair.intercept - pair.slope * point.tangent);
  }
  const double incidence =
      inverse / (std::hypot(pair.intercept, pair.slope) * std::hypot(1.0, tangent));
  // Of inverse depths: from the surface's shape and the scanner's noise.
  const double rms = std::sqrt(residual_sum / count);
  if (incidence < options_.min_incidence || rms > options_.straightness * square(inverse)) {
    return false;
  }
  pair.variance = square(disparity_at_meter * square(inverse) * options_.range_sigma) / count;
  return true;
}

bool SurfacePairFinder::compare(double left, double right, double disparity_at_meter,
                                double predicted, SurfacePair& pair) {
  const auto column = [&](double tangent) {
    return static_cast<std::size_t>(
        std::clamp((tangent - left_) * per_tangent_, 0.0, kColumns - 1.0));
  };
  differences_.clear();
  std::size_t all = 0;
  for (std::size_t i = column(left); i <= column(right); ++i) {
    for (const InView& point : columns_[i]) {
      if (point.tangent < left || point.tangent > right) {
        continue;
      }
      ++all;
      const double difference =
          disparity_at_meter * (point.inverse - pair.intercept - pair.slope * point.tangent);
      if (std::abs(difference - predicted) <= options_.max_difference) {
        differences_.push_back(difference);
      }
    }
  }
  if (differences_.size() < static_cast<std::size_t>(options_.min_points)) {
    return false;
  }
  const double median = quantile(differences_, 0.5);
  double sum = 0.0;
  std::size_t agreeing = 0;
  for (const double difference : differences_) {
    if (std::abs(difference - median) <= options_.mode_width) {
      sum += difference;
      ++agreeing;
    }
  }
  if (agreeing < static_cast<std::size_t>(options_.min_points) ||
      static_cast<double>(agreeing) < options_.min_share * static_cast<double>(all)) {
    return false;
  }
  pair.difference = sum / static_cast<double>(agreeing);
  return true;
}

}  // namespace datmo
