// SPDX-License-Identifier: BSD-3-Clause
#include "surface_groups.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "datmo_fusion/common/disjoint_sets.h"

namespace datmo {

namespace {

/// m; surfaces with a larger lateral gap do not belong to one object.
constexpr double kLateralGap = 0.4;

/// m; maximum depth from a surface to one of the same object seen above it: from a hood to the
/// windshield.
constexpr double kStackedGap = 1.2;

/// m; a surface that begins at most this far below another one's top may stand on it.
constexpr float kOverlap = 0.2F;

/// m above the road; farther surfaces seen only above this may be seen through a window.
constexpr float kWindow = 0.8F;

/// Pixels next to an edge at which the depths of both sides are mixed.
constexpr double kEdgePixels = 2.0;

/// A surface between two others with fewer points than this share of both is a mixture of them.
constexpr float kMixedShare = 0.6F;

/// Joins surfaces pair by pair.
class SurfaceLinks {
 public:
  SurfaceLinks(const SurfaceColumns& columns, const StereoCamera& camera,
               const SurfaceGroupOptions& options)
      : columns_(columns),
        camera_(camera),
        options_(options),
        sets_(columns.surfaces.size()),
        mixed_(columns.surfaces.size()) {}

  std::vector<SurfaceGroup> groups() {
    findMixed();
    for (std::size_t i = 0; i < columns_.surfaces.size(); ++i) {
      if (!mixed_[i]) {
        mergeAbove(i);
        mergeBeside(i);
      }
    }
    return sets_.sets();
  }

 private:
  const ColumnSurface& at(std::size_t index) const { return columns_.surfaces[index]; }
  std::size_t begin(int column) const { return columns_.begin[static_cast<std::size_t>(column)]; }

  /// m; surfaces of one object may differ by this much in depth.
  float gapAt(float depth) const {
    return static_cast<float>(
        std::max(options_.depth_gap,
                 options_.depth_sigmas * camera_.depthSigma(static_cast<double>(depth))));
  }

  bool differentHeight(const ColumnSurface& a, const ColumnSurface& b) const {
    const auto low = static_cast<double>(std::min(a.top, b.top));
    const auto high = static_cast<double>(std::max(a.top, b.top));
    return high > options_.tall && low < options_.low;
  }

  /// Finds surfaces that are not real: next to an edge, points of the background appear at any
  /// depth between foreground and background.
  void findMixed() {
    const double pixels = camera_.focal_length / columns_.per_tangent;
    const int reach = std::max(1, static_cast<int>(std::lround(kEdgePixels / pixels)));
    for (std::size_t i = 0; i < columns_.surfaces.size(); ++i) {
      mixed_[i] = isBetweenLarger(at(i), reach);
    }
  }

  bool isBetweenLarger(const ColumnSurface& surface, int reach) const {
    const float gap = gapAt(surface.depth);
    const float min = surface.points / kMixedShare;
    bool farther = false;
    bool nearer = false;
    const int end = std::min(columns_.count, surface.column + reach + 1);
    for (std::size_t j = begin(std::max(0, surface.column - reach)); j < begin(end); ++j) {
      farther = farther || (at(j).depth > surface.depth + gap && at(j).points > min);
      nearer = nearer || (at(j).depth < surface.depth - gap && at(j).points > min);
    }
    return farther && nearer;
  }

  /// Joins it with what is seen above it, slightly behind.
  void mergeAbove(std::size_t i) {
    const ColumnSurface& surface = at(i);
    const float gap = std::max(static_cast<float>(kStackedGap), gapAt(surface.depth));
    for (std::size_t j = i + 1; j < begin(surface.column + 1); ++j) {
      if (at(j).depth - surface.depth < gap && at(j).bottom > surface.top - kOverlap &&
          static_cast<double>(at(j).top) < options_.tall) {
        sets_.join(i, j);
      }
    }
  }

  /// Joins it with adjacent surfaces, unless something farther away is seen between them.
  void mergeBeside(std::size_t i) {
    const ColumnSurface& surface = at(i);
    const double width = columns_.widthAt(static_cast<double>(surface.depth));
    const int reach = std::max(1, static_cast<int>(kLateralGap / width));
    const float gap = gapAt(surface.depth);
    for (int step = 1; step <= reach && surface.column + step < columns_.count; ++step) {
      const int column = surface.column + step;
      bool seen_through = false;
      bool found = false;
      for (std::size_t j = begin(column); j < begin(column + 1); ++j) {
        if (mixed_[j]) {
          continue;
        }
        if (std::abs(at(j).depth - surface.depth) > gap) {
          seen_through = seen_through || (at(j).depth > surface.depth && at(j).bottom < kWindow);
        } else if (!differentHeight(surface, at(j))) {
          sets_.join(i, j);
          found = true;
        }
      }
      if (seen_through && !found) {
        return;
      }
    }
  }

  const SurfaceColumns& columns_;
  const StereoCamera& camera_;
  const SurfaceGroupOptions& options_;
  DisjointSets sets_;
  std::vector<bool> mixed_;  ///< by surface
};

}  // namespace

std::vector<SurfaceGroup> groupSurfaces(const SurfaceColumns& columns, const StereoCamera& camera,
                                        const SurfaceGroupOptions& options) {
  DentSplitter splitter(columns, camera);
  std::vector<SurfaceGroup> groups;
  for (SurfaceGroup& group : SurfaceLinks(columns, camera, options).groups()) {
    splitter.split(std::move(group), groups);
  }
  return groups;
}

}  // namespace datmo
