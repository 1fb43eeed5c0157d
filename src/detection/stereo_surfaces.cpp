// SPDX-License-Identifier: BSD-3-Clause
#include "stereo_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "datmo_fusion/common/wide.h"

namespace datmo {

namespace {

/// m; points between min_height and this make objects: above, the camera looks over road users at
/// what is behind them.
constexpr double kLayerTop = 2.2;

/// A point belongs to the road if a depth error of this many standard deviations explains its
/// height.
constexpr double kRoadSigmas = 2.0;

/// m; minimum visible height of a surface in a column.
constexpr double kMinVisible = 0.35;

/// m; some cameras mark unknown depths by very large ones.
constexpr float kMaxDepth = 1000.0F;

/// Limits on columns and bins, independent of the options: as fine as any image.
constexpr double kMaxColumns = 4096.0;
constexpr double kMaxBins = 2048.0;

/// Two modes are two surfaces if the counts between them fall below this share of both.
constexpr double kValley = 0.6;

/// A mode ends where its counts fall below this share of its peak.
constexpr double kTail = 0.1;

/// Bins (half standard deviations of the depth) on both sides of a mode's peak that support it.
constexpr int kCore = 3;

/// m; size of the slices in which heights are counted.
constexpr float kSlice = 0.2F;

/// A slice belongs to a surface if it has this share of the points that it would have without
/// holes.
constexpr double kSliceShare = 0.3;

/// Maximum number of empty slices within a surface, in regions without texture.
constexpr int kMaxHole = 2;

constexpr std::int32_t kNoSurface = -1;

bool isInLayer(float height) { return height <= static_cast<float>(kLayerTop); }

}  // namespace

void StereoSurfaces::find(const StereoCloud& cloud, const StereoView& view,
                          const StereoSurfaceOptions& options, double farthest) {
  addPoints(cloud, view, options, farthest);
  countLayer(cloud.camera, options, farthest);
  findModes(options);
  measure(options);
}

void StereoSurfaces::addPoints(const StereoCloud& cloud, const StereoView& view,
                               const StereoSurfaceOptions& options, double farthest) {
  density_.reset(cloud.camera);
  points_ = 0;
  const Bounds bounds = boundsOf(cloud.camera, view, options, farthest);
  upright_.clear();
  ImagePoints points;
  std::array<Upright, ViewedPoints::kMax> standing;
  for (std::size_t begin = 0; begin < cloud.points.count; begin += ViewedPoints::kMax) {
    const std::size_t count = std::min(ViewedPoints::kMax, cloud.points.count - begin);
    view.view(cloud.points, begin, count, points.viewed);
    points_ += static_cast<std::size_t>(locate(bounds, count, points));
    density_.add(points.right, points.up, points.is_seen, count);
    std::ptrdiff_t found = 0;
    // Which points stand is unpredictable: without branches, the others are overwritten.
    for (std::size_t i = 0; i < count; ++i) {
      standing[static_cast<std::size_t>(found)] = {points.right[i], points.viewed.forward[i],
                                                   points.viewed.height[i], 0};
      found += points.stands[i];
    }
    upright_.insert(upright_.end(), standing.begin(), standing.begin() + found);
  }
}

StereoSurfaces::Bounds StereoSurfaces::boundsOf(const StereoCamera& camera, const StereoView& view,
                                                const StereoSurfaceOptions& options,
                                                double farthest) {
  Bounds bounds;
  bounds.nearest = static_cast<float>(options.min_depth);
  bounds.farthest = static_cast<float>(farthest);
  bounds.lowest = static_cast<float>(options.min_height);
  bounds.highest = static_cast<float>(options.max_height);
  bounds.left = static_cast<float>(camera.left_tangent);
  bounds.right = static_cast<float>(camera.right_tangent);
  bounds.camera_height = view.cameraHeight();
  bounds.road_margin = InverseDepthMargin(camera.noise, kRoadSigmas);
  return bounds;
}

DATMO_FUSION_WIDE
int StereoSurfaces::locate(const Bounds& bounds, std::size_t count, ImagePoints& points) {
  int seen = 0;
  // Without branches, because which points are seen is unpredictable.
  for (std::size_t i = 0; i < count; ++i) {
    const float forward = points.viewed.forward[i];
    const float height = points.viewed.height[i];
    const float inverse = points.viewed.inverse[i];
    const float right = points.viewed.right[i] * inverse;
    const int is_seen = (forward > bounds.nearest) & (forward < kMaxDepth);
    points.right[i] = right;
    points.up[i] = (height - bounds.camera_height) * inverse;
    points.is_seen[i] = is_seen;
    // A depth error of the noise lifts a point of the road by this much of height / depth.
    points.stands[i] = is_seen & (height >= bounds.lowest) & (height < bounds.highest) &
                       (forward < bounds.farthest) & (right >= bounds.left) &
                       (right <= bounds.right) &
                       (height * inverse > bounds.road_margin.at(inverse) * bounds.camera_height);
    seen += is_seen;
  }
  return seen;
}

void StereoSurfaces::countLayer(const StereoCamera& camera, const StereoSurfaceOptions& options,
                                double farthest) {
  const double width = camera.right_tangent - camera.left_tangent;
  const double pixels =
      std::max(std::sqrt(density_.pixelsPerPoint()), width * camera.focal_length / kMaxColumns);
  columns_.count = std::max(1, static_cast<int>(std::lround(width * camera.focal_length / pixels)));
  columns_.left = camera.left_tangent;
  columns_.per_tangent = columns_.count / width;
  left_ = static_cast<float>(columns_.left);
  per_tangent_ = static_cast<float>(columns_.per_tangent);
  depth_bins_ = DepthBins(camera, farthest, std::max(options.finest_depth, farthest / kMaxBins));
  bins_ = static_cast<std::size_t>(depth_bins_.size());
  counts_.assign(static_cast<std::size_t>(columns_.count) * bins_, 0);
  for (Upright& point : upright_) {
    point.slot =
        static_cast<std::uint32_t>(slot(columnOf(point.right), depth_bins_.at(point.depth)));
    counts_[point.slot] = static_cast<std::uint16_t>(counts_[point.slot] + isInLayer(point.height));
  }
}

void StereoSurfaces::findModes(const StereoSurfaceOptions& options) {
  columns_.begin.clear();
  columns_.surfaces.clear();
  surface_at_.assign(counts_.size(), kNoSurface);
  raw_.assign(bins_ + 4, 0);
  smooth_.assign(bins_, 0);
  for (int column = 0; column < columns_.count; ++column) {
    columns_.begin.push_back(columns_.surfaces.size());
    smoothColumn(column);
    addModes(column, options);
  }
  columns_.begin.push_back(columns_.surfaces.size());
}

/// Weights 1 2 1 over columns, 1 2 3 2 1 over bins.
void StereoSurfaces::smoothColumn(int column) {
  const std::uint16_t* own = &counts_[slot(column, 0)];
  const std::uint16_t* left = column > 0 ? own - bins_ : own;
  const std::uint16_t* right = column + 1 < columns_.count ? own + bins_ : own;
  for (std::size_t bin = 0; bin < bins_; ++bin) {
    raw_[bin + 2] = left[bin] + 2 * own[bin] + right[bin];
  }
  for (std::size_t bin = 0; bin < bins_; ++bin) {
    const int* raw = &raw_[bin];
    smooth_[bin] = raw[0] + 2 * raw[1] + 3 * raw[2] + 2 * raw[3] + raw[4];
  }
}

void StereoSurfaces::addModes(int column, const StereoSurfaceOptions& options) {
  const int bins = static_cast<int>(bins_);
  const auto at = [&](int bin) { return smooth_[static_cast<std::size_t>(bin)]; };
  int bin = 0;
  while (bin < bins) {
    if (at(bin) == 0) {
      ++bin;
      continue;
    }
    Mode mode{column, bin, bin, bin};
    int valley = bin;
    for (; bin < bins && at(bin) > 0; ++bin) {
      if (at(bin) > at(mode.peak) &&
          (valley <= mode.peak || at(valley) >= kValley * at(mode.peak))) {
        mode.peak = bin;
        valley = bin;
      } else if (at(bin) <= at(valley)) {
        valley = bin;
      } else if (at(valley) < kValley * at(mode.peak) && at(valley) < kValley * at(bin)) {
        mode.end_bin = valley;
        addMode(mode, options);
        mode = {column, valley, bin, valley};
        valley = bin;
      }
    }
    mode.end_bin = bin;
    addMode(mode, options);
  }
}

void StereoSurfaces::addMode(const Mode& mode, const StereoSurfaceOptions& options) {
  const auto min = static_cast<int>(kTail * smooth_[static_cast<std::size_t>(mode.peak)]);
  int first = mode.peak;
  while (first > mode.first_bin && smooth_[static_cast<std::size_t>(first - 1)] > min) {
    --first;
  }
  int end = mode.peak + 1;
  while (end < mode.end_bin && smooth_[static_cast<std::size_t>(end)] > min) {
    ++end;
  }
  const auto pointsIn = [&](int begin_bin, int end_bin) {
    int points = 0;
    for (int bin = begin_bin; bin < end_bin; ++bin) {
      points += counts_[slot(mode.column, bin)];
    }
    return points;
  };
  const int core = std::max(first, mode.peak - kCore);
  const int core_end = std::min(end, mode.peak + kCore + 1);
  const int points = pointsIn(first, end);
  const double depth = static_cast<double>(depth_bins_.middle(mode.peak));
  // The peak may come from neighboring columns only.
  if (points < options.min_points || points < kMinVisible * pointsPerMeter(depth) ||
      pointsIn(core, core_end) == 0) {
    return;
  }
  const auto index = static_cast<std::int32_t>(columns_.surfaces.size());
  ColumnSurface surface;
  surface.column = mode.column;
  columns_.surfaces.push_back(surface);
  for (int bin = core; bin < core_end; ++bin) {
    surface_at_[slot(mode.column, bin)] = index;
  }
}

std::size_t StereoSurfaces::slicesUpTo(double height) {
  return static_cast<std::size_t>(static_cast<float>(height) / kSlice) + 1;
}

void StereoSurfaces::measure(const StereoSurfaceOptions& options) {
  const std::size_t count = columns_.surfaces.size();
  const std::size_t slices = slicesUpTo(options.max_height);
  inverse_sums_.assign(count, 0.0);
  slices_.assign(count * slices, 0);
  for (const Upright& point : upright_) {
    const std::int32_t index = surface_at_[point.slot];
    if (index == kNoSurface) {
      continue;
    }
    const auto surface = static_cast<std::size_t>(index);
    ++slices_[surface * slices + static_cast<std::size_t>(point.height / kSlice)];
    if (isInLayer(point.height)) {
      inverse_sums_[surface] += static_cast<double>(1.0F / point.depth);
      columns_.surfaces[surface].points += 1.0F;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    ColumnSurface& surface = columns_.surfaces[i];
    surface.depth = static_cast<float>(static_cast<double>(surface.points) / inverse_sums_[i]);
    setHeights(surface, &slices_[i * slices], options);
  }
}

/// From the fullest slice up and down to where the surface ends, across holes.
void StereoSurfaces::setHeights(ColumnSurface& surface, const std::uint16_t* slices,
                                const StereoSurfaceOptions& options) const {
  const auto end = static_cast<int>(slicesUpTo(options.max_height));
  const double dense =
      static_cast<double>(kSlice) * pointsPerMeter(static_cast<double>(surface.depth));
  const double min = std::max(1.0, kSliceShare * dense);
  const auto start = static_cast<int>(std::max_element(slices, slices + end) - slices);
  const auto reach = [&](int step) {
    int last = start;
    for (int i = start; i >= 0 && i < end && std::abs(i - last) <= kMaxHole + 1; i += step) {
      last = slices[i] >= min ? i : last;
    }
    return last;
  };
  // The outermost slices are only partly filled.
  const int highest = reach(1);
  const int lowest = reach(-1);
  const double share = std::min(1.0, slices[highest] / dense);
  surface.top = kSlice * (static_cast<float>(highest) + static_cast<float>(share));
  surface.bottom = kSlice * static_cast<float>(lowest);
}

}  // namespace datmo
