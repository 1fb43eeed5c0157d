#include "surface_groups.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/disjoint_sets.h"

namespace datmo {

namespace {

bool belongTogether(const ColumnSurface& a, const ColumnSurface& b, const StereoCamera& camera,
                    const SurfaceGroupOptions& options) {
  const double depth = static_cast<double>(std::min(a.depth, b.depth));
  const double gap = std::max(options.depth_gap, options.depth_sigmas * camera.depthSigma(depth));
  const auto [low, high] = std::minmax(static_cast<double>(a.top), static_cast<double>(b.top));
  const bool different_height = high > options.tall && low < options.low;
  return std::abs(static_cast<double>(a.depth - b.depth)) <= gap && !different_height;
}

}  // namespace

std::vector<SurfaceGroup> groupSurfaces(const SurfaceColumns& columns, const StereoCamera& camera,
                                        const SurfaceGroupOptions& options) {
  DisjointSets sets(columns.surfaces.size());
  for (std::size_t i = 0; i < columns.surfaces.size(); ++i) {
    const ColumnSurface& surface = columns.surfaces[i];
    const double width = columns.widthAt(static_cast<double>(surface.depth));
    const int reach = std::max(1, static_cast<int>(options.lateral_gap / width));
    const auto end = static_cast<std::size_t>(std::min(columns.count, surface.column + reach + 1));
    for (std::size_t j = columns.begin[static_cast<std::size_t>(surface.column) + 1];
         j < columns.begin[end]; ++j) {
      if (belongTogether(surface, columns.surfaces[j], camera, options)) {
        sets.join(i, j);
      }
    }
  }
  return sets.sets();
}

}  // namespace datmo
