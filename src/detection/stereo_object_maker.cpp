// SPDX-License-Identifier: BSD-3-Clause
#include "stereo_object_maker.h"

#include <algorithm>
#include <cmath>

#include "side_model.h"

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/square.h"
#include "datmo_fusion/detection/box_fit.h"

namespace datmo {

namespace {

/// m; standard deviation of an extent in depth, in addition to that of the depth.
constexpr double kExtentSigma = 0.2;

/// Maximum number of outline points of an object: neighboring columns are averaged.
constexpr std::size_t kMaxPoints = 40;

/// Sides whose normal is closer to the line of sight than this (sine of the angle) end in depth;
/// the ends in the image carry no information on them.
constexpr double kSideways = 0.5;

/// Share of the noise that points within the correlated width have in common.
constexpr double kCorrelatedShare = 0.5;

/// Standard deviations between the minimum and maximum of many values, without a few outliers.
constexpr double kSpreadSigmas = 3.3;

/// Number of ends of an extent, each of which adds to its error.
constexpr double kBothEnds = 2.0;

/// m; a top that is closer than this to the upper height limit may be higher.
constexpr double kBelowHighest = 0.3;

}  // namespace

StereoObjectMaker::StereoObjectMaker(const StereoObjectDetectorOptions& options,
                                     const ObjectClassifier& classifier, const StereoCamera& camera,
                                     const StereoView& view, const StereoSurfaces& surfaces)
    : options_(options),
      classifier_(classifier),
      camera_(camera),
      view_(view),
      columns_(surfaces.columns()),
      max_tangent_(surfaces.density().maxTangent()) {}

Object StereoObjectMaker::objectOf(const GroupOutline& outline) const {
  Object object;
  object.points = pointsOf(outline);
  object.sensors = {kStereoSensor};
  object.height = outline.top;
  object.position_covariance = covarianceOf(outline);
  setBox(object, outline);
  classifier_.classify(sizeOf(outline), options_.max_doubt, object);
  return object;
}

std::vector<Point2> StereoObjectMaker::pointsOf(const GroupOutline& outline) const {
  std::vector<Point2> points;
  const std::size_t bundle = (outline.columns.size() + kMaxPoints - 1) / kMaxPoints;
  for (std::size_t begin = 0; begin < outline.columns.size(); begin += bundle) {
    const std::size_t end = std::min(begin + bundle, outline.columns.size());
    double inverse = 0.0;
    double tangent = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      inverse += 1.0 / static_cast<double>(outline.columns[i].depth);
      tangent += columns_.tangentOf(outline.columns[i].column);
    }
    const auto count = static_cast<double>(end - begin);
    const double depth = count / inverse;
    points.push_back(view_.positionOf({depth, tangent / count * depth}));
  }
  return points;
}

/// A wrong depth shifts all of an object along its line of sight, a wrong edge sideways.
Eigen::Matrix2d StereoObjectMaker::covarianceOf(const GroupOutline& outline) const {
  const double middle = 0.5 * (columns_.tangentOf(outline.columns.front().column) +
                               columns_.tangentOf(outline.columns.back().column));
  const Point2 ray = view_.positionOf({1.0, middle}) - view_.position();
  const Point2 aside = toRight();
  const double along = std::hypot(options_.noise.common * camera_.depthSigma(outline.depth),
                                  camera_.commonDepthSigma(outline.depth));
  const double across = options_.noise.edge_sigma * outline.depth / camera_.focal_length;
  return square(along) * ray * ray.transpose() + square(across) * aside * aside.transpose() +
         square(options_.noise.body_sigma) * Eigen::Matrix2d::Identity();
}

/// Sets the box and its sides from the object's points.
void StereoObjectMaker::setBox(Object& object, const GroupOutline& outline) const {
  const double sigma = std::hypot(columnNoise(outline.depth), options_.noise.body_sigma);
  // Points that share their noise count as fewer.
  const double bundle = static_cast<double>(outline.columns.size()) /
                        static_cast<double>(object.points.size()) * camera_.focal_length /
                        columns_.per_tangent;
  const double alike = std::max(1.0, kCorrelatedShare * options_.noise.correlated_width / bundle);
  BoxFit fit = fitBox(object.points, view_.position(), {sigma, alike});
  if (fit.heading_variance >= kUnknownAxisVariance) {
    fit = boxAcross(object.points, view_.position(), fit.noise);
  }
  const auto seen_variance = [&](std::size_t points) {
    return square(fit.noise) * std::min(1.0, alike / static_cast<double>(points));
  };
  const auto end_beyond = [&](const Point2& normal, double) { return endOn(normal, outline); };
  setSides(object, fit, {seen_variance, end_beyond});
}

/// The end in the image is known precisely, that along the line of sight as well as the depth of
/// the last column.
std::optional<SurfaceEnd> StereoObjectMaker::endOn(const Point2& normal,
                                                   const GroupOutline& outline) const {
  std::optional<SurfaceEnd> result;
  for (const bool to_right : {false, true}) {
    const GroupEnd& end = to_right ? outline.right : outline.left;
    const ColumnSurface& last = to_right ? outline.columns.back() : outline.columns.front();
    const Point2 ray =
        (view_.positionOf({1.0, columns_.tangentOf(last.column)}) - view_.position()).normalized();
    const double aside =
        normal.dot(to_right ? Point2(ray.y(), -ray.x()) : Point2(-ray.y(), ray.x()));
    if (aside > kSideways) {
      const double in_depth = normal.dot(ray) * columnNoise(static_cast<double>(last.depth));
      result.reset();
      if (end.seen) {
        result = {aside * end.beyond, square(aside * end.sigma) + square(in_depth)};
      }
    }
  }
  return result;
}

SeenSize StereoObjectMaker::sizeOf(const GroupOutline& outline) const {
  const double edge = options_.noise.edge_sigma * outline.depth / camera_.focal_length;
  const double noise = columnNoise(outline.depth);
  const double seen_up_to =
      std::min(view_.cameraHeight() + max_tangent_ * outline.depth - kBothEnds * edge,
               options_.surfaces.max_height - kBelowHighest);
  SeenSize seen;
  seen.height = outline.top;
  seen.height_sigma = std::hypot(options_.noise.height_sigma, kBothEnds * edge);
  seen.higher = outline.top > seen_up_to;
  seen.across = outline.across;
  seen.across_sigma = kBothEnds * edge;
  seen.along = std::sqrt(std::max(0.0, square(outline.along) - square(kSpreadSigmas * noise)));
  seen.along_sigma = std::hypot(kExtentSigma, std::sqrt(kBothEnds) * noise);
  seen.wider = !outline.left.seen || !outline.right.seen;
  return seen;
}

}  // namespace datmo
