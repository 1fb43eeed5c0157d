#include "stereo_object_maker.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "side_box.h"

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/quantile.h"
#include "datmo_fusion/detection/box_fit.h"

namespace datmo {

namespace {

constexpr char kSensor[] = "stereo";

/// Points that tell the outline of an object, at most.
constexpr std::size_t kMostPoints = 40;

/// Share of an object's columns that are not higher than it is: some reach into what is behind.
constexpr double kTopShare = 0.8;

/// rad; a side that was seen faces the camera: a vaguer heading tells no more of where it ends.
constexpr double kMostSlant = 0.3;

/// Standard deviations of the depth by which something in front is surely so.
constexpr double kSurelyApart = 2.0;

double square(double value) { return value * value; }

}  // namespace

StereoObjectMaker::StereoObjectMaker(const StereoObjectDetectorOptions& options,
                                     const ObjectClassifier& classifier, const StereoCamera& camera,
                                     const StereoView& view, const StereoSurfaces& surfaces)
    : options_(options),
      classifier_(classifier),
      camera_(camera),
      view_(view),
      surfaces_(surfaces),
      columns_(surfaces.columns()),
      highest_tangent_(surfaces.density().highestTangent()) {}

std::optional<Object> StereoObjectMaker::make(const SurfaceGroup& group) const {
  const Outline outline = outlineOf(group);
  if (isLeftOut(outline)) {
    return std::nullopt;
  }
  const Ends ends = {endOf(outline, kLeftEnd), endOf(outline, kRightEnd)};
  Object object;
  object.points = pointsOf(outline);
  object.sensors = {kSensor};
  object.height = outline.top;
  object.position_covariance = covarianceOf(outline);
  setBox(object, outline, ends);
  setClass(object, outline, ends);
  return object;
}

StereoObjectMaker::Outline StereoObjectMaker::outlineOf(const SurfaceGroup& group) const {
  Outline outline;
  std::vector<double> depths;
  std::vector<double> tops;
  for (const std::size_t index : group) {
    const ColumnSurface& surface = columns_.surfaces[index];
    const double depth = static_cast<double>(surface.depth);
    outline.surface += static_cast<double>(surface.points) * square(columns_.widthAt(depth));
    depths.push_back(depth);
    tops.push_back(static_cast<double>(surface.top));
    if (outline.columns.empty() || outline.columns.back().column < surface.column) {
      outline.columns.push_back(surface);
    }
  }
  outline.depth = quantile(depths, 0.5);
  outline.top = quantile(tops, kTopShare);
  const int columns = outline.columns.back().column - outline.columns.front().column + 1;
  outline.across = columns * columns_.widthAt(outline.depth);
  return outline;
}

bool StereoObjectMaker::isLeftOut(const Outline& outline) const {
  const Point2 first(static_cast<double>(outline.columns.front().depth),
                     columns_.tangentOf(outline.columns.front().column) *
                         static_cast<double>(outline.columns.front().depth));
  const Point2 last(static_cast<double>(outline.columns.back().depth),
                    columns_.tangentOf(outline.columns.back().column) *
                        static_cast<double>(outline.columns.back().depth));
  return outline.surface < options_.least_surface || outline.depth > options_.effective_range ||
         (last - first).norm() > options_.largest_size;
}

/// Something nearer may hide where a surface goes on; the right camera does not see what is just to
/// the left of a nearer thing.
bool StereoObjectMaker::isHidden(const ColumnSurface& last, int step) const {
  const double depth = static_cast<double>(last.depth);
  const double pixels = camera_.focal_length / columns_.per_tangent;
  const double edge = std::ceil(2.0 * options_.edge_sigma / pixels) + 1.0;
  const double disparities = camera_.baseline * columns_.per_tangent;
  const int reach =
      static_cast<int>(edge + (step > 0 ? disparities / options_.surfaces.nearest_depth : 0.0));
  for (int i = 1; i <= reach; ++i) {
    const int column = last.column + step * i;
    if (column < 0 || column >= columns_.count) {
      return true;
    }
    const auto c = static_cast<std::size_t>(column);
    for (std::size_t j = columns_.begin[c]; j < columns_.begin[c + 1]; ++j) {
      const double other = static_cast<double>(columns_.surfaces[j].depth);
      const bool nearer = other < depth - std::max(options_.groups.depth_gap,
                                                   kSurelyApart * camera_.depthSigma(depth));
      const double shadow = step > 0 ? disparities * (1.0 / other - 1.0 / depth) : 0.0;
      if (nearer && i <= edge + shadow) {
        return true;
      }
    }
  }
  return false;
}

StereoObjectMaker::End StereoObjectMaker::endOf(const Outline& outline, std::size_t which) const {
  const int step = which == kLeftEnd ? -1 : 1;
  const ColumnSurface& last = which == kLeftEnd ? outline.columns.front() : outline.columns.back();
  const double depth = static_cast<double>(last.depth);
  const double tangent = columns_.tangentOf(last.column);
  const double pixel = 1.0 / camera_.focal_length;
  const double margin = 4.0 * pixel;
  // What is left of the right camera's image has no match.
  const double left_border = camera_.left_tangent + camera_.baseline / depth;
  End end;
  const bool at_border = tangent - margin < left_border || tangent + margin > camera_.right_tangent;
  const double beside = tangent + step * margin;
  const bool dead = !surfaces_.density().hasPoints(std::min(tangent + step * pixel, beside),
                                                   std::max(tangent + step * pixel, beside));
  end.seen = !(at_border && (which == kLeftEnd ? tangent - margin < left_border
                                               : tangent + margin > camera_.right_tangent)) &&
             !dead && !isHidden(last, step);
  end.beyond = 0.5 * columns_.widthAt(depth);
  end.sigma = std::hypot(options_.edge_sigma * pixel * depth, columns_.widthAt(depth) * 0.29);
  return end;
}

std::vector<Point2> StereoObjectMaker::pointsOf(const Outline& outline) const {
  std::vector<Point2> points;
  const std::size_t bundle = (outline.columns.size() + kMostPoints - 1) / kMostPoints;
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

Eigen::Matrix2d StereoObjectMaker::covarianceOf(const Outline& outline) const {
  const double depth = outline.depth;
  const double middle = 0.5 * (columns_.tangentOf(outline.columns.front().column) +
                               columns_.tangentOf(outline.columns.back().column));
  const double along = options_.common_noise * camera_.depthSigma(depth);
  const double across = options_.edge_sigma * depth / camera_.focal_length;
  // A wrong depth moves a place along its line of sight.
  const Point2 sight = view_.positionOf({1.0, middle}) - view_.position();
  const Point2 side = view_.positionOf({1.0, 1.0}) - view_.positionOf({1.0, 0.0});
  const double floor = square(options_.position_sigma);
  return square(along) * sight * sight.transpose() + square(across) * side * side.transpose() +
         floor * Eigen::Matrix2d::Identity();
}

void StereoObjectMaker::setBox(Object& object, const Outline& outline, const Ends& ends) const {
  const double noise = std::hypot(options_.surface_noise * camera_.depthSigma(outline.depth),
                                  options_.position_sigma);
  const BoxFit fit = fitBox(object.points, view_.position(), noise);
  const double heading_std = std::sqrt(std::min(fit.heading_variance, square(kMostSlant)));
  const Point2 to_right = view_.positionOf({1.0, 1.0}) - view_.positionOf({1.0, 0.0});
  SideBox sides(fit);
  for (std::size_t side = 0; side < kBoxSides; ++side) {
    object.side_variance[side] = kHiddenSide;
    if (sides.isSeen(side)) {
      object.side_variance[side] =
          square(fit.noise) / static_cast<double>(fit.points_on_side[side]);
    } else if (sides.isEndOfSeen(side, heading_std)) {
      const Point2 normal = sides.normal(side);
      const double turn = normal.dot(to_right);
      const End& end = turn > 0.0 ? ends[kRightEnd] : ends[kLeftEnd];
      // Ends that lie along the line of sight rest on depth alone.
      if (end.seen && std::abs(turn) > 0.5) {
        sides.extend(side, end.beyond);
        object.side_variance[side] = square(end.sigma) + square(heading_std * sides.across(side));
      }
    }
  }
  object.box = sides.box();
  object.heading_variance = fit.heading_variance;
  turnToLongerSide(object);
}

void StereoObjectMaker::setClass(Object& object, const Outline& outline, const Ends& ends) const {
  SeenSize seen;
  seen.height = outline.top;
  const double pixel = outline.depth / camera_.focal_length;
  seen.height_sigma = std::hypot(0.1, 2.0 * pixel);
  seen.higher =
      outline.top + 2.0 * pixel > view_.cameraHeight() + highest_tangent_ * outline.depth ||
      outline.top > options_.surfaces.highest - 0.3;
  seen.across = outline.across;
  seen.across_sigma = 2.0 * options_.edge_sigma * pixel;
  seen.wider = !ends[kLeftEnd].seen || !ends[kRightEnd].seen;
  const ClassProbabilities probabilities = classifier_.probabilities(seen);
  const auto best = std::max_element(probabilities.begin(), probabilities.end());
  object.object_class = static_cast<ObjectClass>(best - probabilities.begin());
  object.class_probability = *best;
}

}  // namespace datmo
