// SPDX-License-Identifier: BSD-3-Clause
#include "group_outline.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/quantile.h"
#include "datmo_fusion/common/square.h"
#include "datmo_fusion/common/uniform.h"

namespace datmo {

namespace {

/// Quantile of the columns' tops taken as an object's height: some columns include what is behind.
constexpr double kTopShare = 0.9;

/// Quantiles of its surfaces' depths between which its extent in depth is taken.
constexpr double kNearShare = 0.05;
constexpr double kFarShare = 0.95;

/// Standard deviations of the depth by which something is certainly in front.
constexpr double kSurelyInFront = 2.0;

/// px; an end closer than this to the border of the image may be due to the border.
constexpr double kBorderPixels = 4.0;

/// Standard deviations of an edge's position within which another surface counts as adjacent.
constexpr double kBesideSigmas = 3.0;

}  // namespace

OutlineFinder::OutlineFinder(const StereoObjectDetectorOptions& options, const StereoCamera& camera,
                             const StereoSurfaces& surfaces)
    : options_(options), camera_(camera), surfaces_(surfaces), columns_(surfaces.columns()) {}

GroupOutline OutlineFinder::outlineOf(const SurfaceGroup& group) const {
  GroupOutline outline;
  std::vector<double> depths;
  std::vector<double> tops;
  for (const std::size_t index : group) {
    const ColumnSurface& surface = columns_.surfaces[index];
    const auto depth = static_cast<double>(surface.depth);
    const auto top = static_cast<double>(surface.top);
    outline.surface += static_cast<double>(surface.points) * square(columns_.widthAt(depth));
    depths.push_back(depth);
    if (outline.columns.empty() || outline.columns.back().column < surface.column) {
      outline.columns.push_back(surface);
      tops.push_back(top);
    } else {
      tops.back() = std::max(tops.back(), top);
    }
  }
  const ColumnSurface& first = outline.columns.front();
  const ColumnSurface& last = outline.columns.back();
  outline.depth = quantile(depths, 0.5);
  outline.along = quantile(depths, kFarShare) - quantile(depths, kNearShare);
  outline.top = quantile(tops, kTopShare);
  outline.across = (last.column - first.column + 1) * columns_.widthAt(outline.depth);
  const auto near = static_cast<double>(first.depth);
  const auto far = static_cast<double>(last.depth);
  outline.length = std::hypot(
      far - near, columns_.tangentOf(last.column) * far - columns_.tangentOf(first.column) * near);
  outline.left = endAt(first, Step::kLeft);
  outline.right = endAt(last, Step::kRight);
  return outline;
}

GroupEnd OutlineFinder::endAt(const ColumnSurface& last, Step step) const {
  const auto depth = static_cast<double>(last.depth);
  const double width = columns_.widthAt(depth);
  GroupEnd end;
  end.seen = !isAtBorder(last, step) && !isBesideNearer(last, step);
  end.beyond = 0.5 * width;
  end.sigma = std::hypot(options_.noise.edge_sigma * depth / camera_.focal_length,
                         std::sqrt(kUniformVariance) * width);
  return end;
}

/// At the border of the image; or of what both cameras see: the right one (or the projector) does
/// not see what is at the left border of the left image; or of where the matcher finds anything.
bool OutlineFinder::isAtBorder(const ColumnSurface& last, Step step) const {
  const double tangent = columns_.tangentOf(last.column);
  const double pixel = 1.0 / camera_.focal_length;
  const double margin = std::max(kBorderPixels * pixel, 1.0 / columns_.per_tangent);
  const double overlap_border =
      camera_.left_tangent + camera_.baseline / static_cast<double>(last.depth);
  if (step == Step::kLeft) {
    return tangent - margin < overlap_border ||
           !surfaces_.density().hasPoints(tangent - margin - pixel, tangent - pixel);
  }
  return tangent + margin > camera_.right_tangent ||
         !surfaces_.density().hasPoints(tangent + pixel, tangent + margin + pixel);
}

/// Nearer surfaces may hide the continuation of this one; nor does the right camera see what is
/// just to the left of them.
bool OutlineFinder::isBesideNearer(const ColumnSurface& last, Step step) const {
  const auto depth = static_cast<double>(last.depth);
  const double margin =
      std::max(options_.groups.depth_gap, kSurelyInFront * camera_.depthSigma(depth));
  const double surely_nearer = depth - margin;
  const double column_pixels = camera_.focal_length / columns_.per_tangent;
  const double beside = 1.0 + std::ceil(kBesideSigmas * options_.noise.edge_sigma / column_pixels);
  const auto shadowOf = [&](double nearer) {
    return step == Step::kRight
               ? camera_.baseline * columns_.per_tangent * (1.0 / nearer - 1.0 / depth)
               : 0.0;
  };
  const int reach = static_cast<int>(beside + shadowOf(options_.surfaces.min_depth));
  const int direction = static_cast<int>(step);
  for (int i = 1; i <= reach; ++i) {
    const int column = last.column + direction * i;
    if (column < 0 || column >= columns_.count) {
      return false;
    }
    const auto begin = columns_.begin[static_cast<std::size_t>(column)];
    if (begin < columns_.begin[static_cast<std::size_t>(column) + 1]) {
      const auto nearest = static_cast<double>(columns_.surfaces[begin].depth);
      if (nearest < surely_nearer && i <= beside + shadowOf(nearest)) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace datmo
