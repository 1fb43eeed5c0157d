#include "stereo_evidence.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace datmo {

namespace {

/// Columns and bins are this much finer than the cells that they are to fill, at the farthest one.
constexpr double kColumnsPerCell = 2.0;
constexpr double kBinsPerCell = 4.0;

/// Bounds of what is needed of memory, whatever is asked for: as fine as any image.
constexpr double kMostColumns = 4096.0;
constexpr double kMostBins = 2048.0;

/// m; cameras mark a depth that they do not know by a far one.
constexpr float kBeyondSight = 1000.0F;

/// The density of points is taken from square tiles of the image: about so wide, px, and up to this
/// tangent above and below the horizon.
constexpr double kTileSize = 16.0;
constexpr double kHighestTangent = 1.0;

/// This share of the tiles with points may have holes; the others tell how the cloud was thinned.
constexpr double kHolesShare = 0.8;

}  // namespace

void StereoEvidence::take(const StereoCloud& cloud, const StereoView& view,
                          const EvidenceLimits& limits) {
  prepare(cloud.camera, limits);
  addPoints(cloud, view, limits);
  thinning_ = estimateThinning();
  obstacles_.sumUp();
  lines_.sumUp();
}

void StereoEvidence::prepare(const StereoCamera& camera, const EvidenceLimits& limits) {
  points_ = 0;
  in_layer_ = 0;
  focal_length_ = camera.focal_length;
  left_ = camera.left_tangent;
  band_ = limits.layer_bottom;
  bins_ = DepthBins(camera, limits.farthest_depth,
                    std::max(limits.cell_size / kBinsPerCell, limits.farthest_depth / kMostBins));
  const double width = camera.right_tangent - camera.left_tangent;
  const double finest = std::max({limits.cell_size / limits.farthest_depth / kColumnsPerCell,
                                  1.0 / focal_length_, width / kMostColumns});
  columns_ = static_cast<int>(std::ceil(width / finest));
  columns_per_tangent_ = columns_ / width;
  obstacles_.reset(bins_.size() + 1, columns_);
  lines_.reset(bins_.size() + 1, columns_);

  const double column_size = focal_length_ / columns_per_tangent_;
  tile_shift_ = std::max(0, static_cast<int>(std::lround(std::log2(kTileSize / column_size))));
  const double tiles_per_tangent = columns_per_tangent_ / (1 << tile_shift_);
  tile_rows_ = static_cast<int>(std::ceil(2.0 * kHighestTangent * tiles_per_tangent));
  tile_columns_ = (columns_ >> tile_shift_) + 1;
  tiles_.assign(static_cast<std::size_t>(tile_rows_) * static_cast<std::size_t>(tile_columns_), 0);
}

void StereoEvidence::addPoints(const StereoCloud& cloud, const StereoView& view,
                               const EvidenceLimits& limits) {
  const auto nearest = static_cast<float>(limits.nearest_depth);
  const auto bottom = static_cast<float>(limits.layer_bottom);
  const auto top = static_cast<float>(limits.layer_top);
  const auto left = static_cast<float>(left_);
  const auto columns_per_tangent = static_cast<float>(columns_per_tangent_);
  const auto columns = static_cast<float>(columns_);
  const auto tiles_per_tangent = static_cast<float>(columns_per_tangent_ / (1 << tile_shift_));
  const auto horizon = static_cast<float>(0.5 * tile_rows_);
  const auto tile_rows = static_cast<float>(tile_rows_);
  // The noise of a depth is uniform in its inverse, 1/m.
  const StereoCamera& camera = cloud.camera;
  const double inverse_sigma = camera.disparity_sigma / (camera.focal_length * camera.baseline);
  const auto road_margin = static_cast<float>(limits.road_sigmas * inverse_sigma);
  const auto obstacle_margin = static_cast<float>(limits.obstacle_sigmas * inverse_sigma);
  const float camera_height = view.cameraHeight();

  for (std::size_t i = 0; i < cloud.points.count; ++i) {
    const ViewedPoint point = view(cloud.points[i]);
    if (!(point.forward > nearest && point.forward < kBeyondSight)) {
      continue;
    }
    ++points_;
    const float inverse = 1.0F / point.forward;
    const float place = (point.right * inverse - left) * columns_per_tangent;
    if (!(place >= 0.0F && place < columns)) {
      continue;
    }
    const int column = static_cast<int>(place);

    // m that the line of sight falls on its way to the point.
    const float fall = camera_height - point.height;
    const float row = horizon + fall * inverse * tiles_per_tangent;
    if (row >= 0.0F && row < tile_rows) {
      ++tiles_[static_cast<std::size_t>(static_cast<int>(row) * tile_columns_ +
                                        (column >> tile_shift_))];
    }

    // On that line, the road is at the inverse depth inverse * fall / camera_height.
    const bool on_road = point.height * inverse <= road_margin * camera_height;
    if (!on_road && point.height >= bottom && point.height <= top &&
        bins_.contains(point.forward)) {
      obstacles_.add(bins_.at(point.forward), column, 1);
      ++in_layer_;
    }

    // From where to where the line is below the layer's bottom, and nothing stops it.
    const float at_bottom = point.forward * (camera_height - bottom) / fall;
    const float stop =
        on_road ? point.forward * camera_height / fall : 1.0F / (inverse + obstacle_margin);
    const float begin = fall > 0.0F ? std::max(0.0F, at_bottom) : 0.0F;
    const float end = fall > 0.0F ? stop : std::min(stop, at_bottom);
    if (begin < end) {
      lines_.add(bins_.before(begin), column, 1);
      lines_.add(bins_.before(end), column, -1);
    }
  }
}

double StereoEvidence::estimateThinning() const {
  std::vector<int> counts;
  std::copy_if(tiles_.begin(), tiles_.end(), std::back_inserter(counts),
               [](int count) { return count > 0; });
  if (counts.empty()) {
    return 1.0;
  }
  const auto dense = counts.begin() + static_cast<std::ptrdiff_t>(
                                          kHolesShare * static_cast<double>(counts.size() - 1));
  std::nth_element(counts.begin(), dense, counts.end());
  const double tile_size = (1 << tile_shift_) * focal_length_ / columns_per_tangent_;
  return std::max(1.0, tile_size * tile_size / *dense);
}

StereoEvidence::Columns StereoEvidence::columnsAt(const ViewedPlace& place,
                                                  double half_width) const {
  // In columns; those are in whose middles are.
  const double middle = (place.tangent() - left_) * columns_per_tangent_;
  const double half = half_width / place.forward * columns_per_tangent_;
  const int first = std::max(0, static_cast<int>(std::ceil(middle - half - 0.5)));
  const int end = std::min(columns_, static_cast<int>(std::ceil(middle + half - 0.5)));
  if (first < end) {
    return {first, end};
  }
  const int nearest = std::clamp(static_cast<int>(middle), 0, columns_ - 1);
  return {nearest, nearest + 1};
}

double StereoEvidence::surface(const ViewedPlace& place, double half_width, double near,
                               double far) const {
  const Columns columns = columnsAt(place, half_width);
  const int first = std::min(bins_.before(static_cast<float>(near)), bins_.size() - 1);
  const int end = std::max(first + 1, bins_.before(static_cast<float>(far)));
  const double pixel = place.forward / focal_length_;
  return obstacles_.sum(first, end, columns.first, columns.end) * pixel * pixel * thinning_;
}

int StereoEvidence::lines(const ViewedPlace& place, double half_width) const {
  const Columns columns = columnsAt(place, half_width);
  return lines_.sum(0, bins_.at(static_cast<float>(place.forward)) + 1, columns.first, columns.end);
}

double StereoEvidence::expectedLines(const ViewedPlace& place, double half_width) const {
  const Columns columns = columnsAt(place, half_width);
  const double pixels_across = (columns.end - columns.first) * focal_length_ / columns_per_tangent_;
  const double pixels_high = band_ / place.forward * focal_length_;
  return pixels_across * pixels_high / thinning_;
}

}  // namespace datmo
