// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/map/map_fuser.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "datmo_fusion/fusion/grid/grid_fusion.h"
#include "datmo_fusion/slam/map_recovery.h"
#include "datmo_fusion/slam/pose_covariance.h"

namespace datmo {

namespace {

/// Maximum odometry error between two poses, m.
constexpr double kMaxMotionError = 2.0;

/// Expected covariance at another position with the same certainty as at this pose. An uncertain
/// heading of the map makes distant positions more uncertain, which is not a gap.
Eigen::Matrix3d expectedAt(const PoseWithCovariance& there, const PoseWithCovariance& before) {
  return withLeverArm(before.covariance, there.pose.position() - before.pose.position());
}

/// The grid, with occupied cells near a mover set to unknown (m, the grid's frame).
SensorGrid withoutMovers(SensorGrid grid, const std::vector<Point2>& movers, double margin) {
  const GridWindow window = grid.window();
  const Point2 reach(margin, margin);
  for (const Point2& mover : movers) {
    const CellIndex first = window.cellAt(mover - reach);
    const CellIndex last = window.cellAt(mover + reach);
    for (int row = first.row; row <= last.row; ++row) {
      for (int column = first.column; column <= last.column; ++column) {
        const CellIndex cell{column, row};
        if (isOccupied(grid.atOrUnknown(cell)) &&
            (window.centerOf(cell) - mover).norm() <= margin) {
          grid.at(cell) = kUnknownPercent;
        }
      }
    }
  }
  return grid;
}

/// Draws each probability toward 1/2 according to the source's reliability.
SensorGrid discounted(SensorGrid grid, double reliability) {
  for (Percent& percent : grid.cells()) {
    if (percent != kUnknownPercent) {
      const double evidence = reliability * (percent - kUndecidedPercent);
      percent = static_cast<Percent>(std::lround(kUndecidedPercent + evidence));
    }
  }
  return grid;
}

/// A map in the window around a position.
SensorGrid imageOf(OccupancyMap& map, const Point2& center, Stamp stamp) {
  map.centerOn(center);
  SensorGrid image(stamp, map.window());
  image.cells() = map.occupancyImage();
  return image;
}

}  // namespace

MapFuserOptions::MapFuserOptions() {
  sources["lidar"].reliability = 0.93;
  sources["stereo"].reliability = 0.62;
  sources["mono"] = {false, 0.5};
}

void MapSourceOptions::visit(OptionVisitor& visitor) {
  visitor.toggle({"use", "", "whether the map of this source is fused"}, use);
  visitor.number({"reliability", "1",
                  "share of the occupied cells of the source's own map that are right (evaluate "
                  "maps with this source alone); the rest of its evidence is discounted (Shafer "
                  "1976); 0: it is not a source"},
                 reliability, {0.0, 1.0});
}

void MapFuserOptions::visit(OptionVisitor& visitor) {
  visitor.group("map", [&] { map.visit(visitor); });
  visitor.group("changes", [&] { changes.visit(visitor); });
  visitor.number({"prior_reliability", "1",
                  "reliability of the prior map; less than the scanner's, which sees the current "
                  "state; 0: it is not fused"},
                 prior_reliability, {0.0, 1.0});
  visitor.number({"conflict_from", "1",
                  "share of contradictory evidence above which a cell is counted as in conflict: "
                  "two sources, each half sure of the opposite"},
                 conflict_from, {0.01, 1.0});
  visitor.number({"mover_margin", "m",
                  "occupied cells this close to a moving end point are not added to the maps: the "
                  "rest of the moving body, and a camera's depth error"},
                 mover_margin, {0.0, 10.0});
  visitor.each({"sources", "", "the sensors whose maps are fused"}, sources);
}

std::vector<std::string> MapFuserOptions::sourcesInUse() const {
  std::vector<std::string> names;
  for (const auto& [name, source] : sources) {
    if (source.use && source.reliability > 0.0) {
      names.push_back(name);
    }
  }
  return names;
}

MapFuser::MapFuser(const Checked<MapFuserOptions>& options) : options_(*options) { reset(); }

void MapFuser::reset() {
  maps_.clear();
  for (const std::string& source : options_.sourcesInUse()) {
    maps_[source];
  }
  pose_.reset();
}

bool MapFuser::isLessCertain(const PoseWithCovariance& base_in_map) const {
  return pose_ &&
         grewWider(expectedAt(base_in_map, *pose_), base_in_map.covariance, MapRecoveryOptions());
}

bool MapFuser::isElsewhere(const PoseWithCovariance& base_in_map,
                           const std::optional<Pose2>& motion) const {
  if (!pose_) {
    return false;
  }
  const bool has_jumped =
      motion &&
      ((pose_->pose * *motion).position() - base_in_map.pose.position()).norm() > kMaxMotionError;
  return has_jumped || isLessCertain(base_in_map) ||
         grewWider(base_in_map.covariance, expectedAt(base_in_map, *pose_), MapRecoveryOptions());
}

void MapFuser::moveTo(const PoseWithCovariance& base_in_map, const std::optional<Pose2>& motion) {
  if (isElsewhere(base_in_map, motion)) {
    reset();
    ++maps_begun_;
  }
  pose_ = base_in_map;
  for (auto& [source, map] : maps_) {
    if (map) {
      map->centerOn(base_in_map.pose.position());
    }
  }
}

void MapFuser::add(const std::string& source, const SensorGrid& grid, const Pose2& base_in_map,
                   const std::vector<Point2>& movers) {
  std::optional<AgingMap>& map = maps_.at(source);
  if (!map) {
    const auto any = std::find_if(maps_.begin(), maps_.end(),
                                  [](const auto& one) { return one.second.has_value(); });
    const GridWindow& window = any == maps_.end() ? grid.window() : any->second->window();
    map.emplace(options_.map, window.columns, window.rows, window.cell_size);
    map->centerOn(pose_ ? pose_->pose.position() : base_in_map.position());
  }
  const Pose2 map_in_base = base_in_map.inverse();
  std::vector<Point2> movers_in_grid;
  movers_in_grid.reserve(movers.size());
  for (const Point2& mover : movers) {
    movers_in_grid.push_back(map_in_base * mover);
  }
  map->update(withoutMovers(grid, movers_in_grid, options_.mover_margin), base_in_map);
}

bool MapFuser::isLocated() const {
  const MapRecoveryOptions gap;
  // Written so that NaN counts as not located.
  return pose_ && maxPositionVariance(pose_->covariance) <= std::pow(gap.from_position_sigma, 2) &&
         pose_->covariance(2, 2) <= std::pow(gap.from_heading_sigma, 2);
}

std::optional<FusedMaps> MapFuser::fuse(Stamp now) {
  std::deque<SensorGrid> images;  // storage for `grids`
  std::vector<WeightedGrid> grids;
  for (const auto& [source, map] : maps_) {
    if (map) {
      images.push_back(discounted(map->image(now), options_.sources.at(source).reliability));
      grids.push_back({&images.back(), {}});
    }
  }
  if (grids.empty()) {
    return std::nullopt;
  }
  FusedGrids fused = fuseGrids(FusionRule::kLogOdds, grids);
  FusedMaps result;
  if (prior_ && isLocated()) {
    images.push_back(imageOf(*prior_, pose_->pose.position(), now));
    result.changes = changesBetween(images.back(), fused.fused, *pose_, options_.changes);
    if (options_.prior_reliability > 0.0) {
      images.push_back(discounted(images.back(), options_.prior_reliability));
      grids.push_back({&images.back(), {}});
      fused = fuseGrids(FusionRule::kLogOdds, grids);
    }
  }
  result.fused = std::move(fused.fused);
  result.conflict = std::move(fused.conflict);
  result.cells_in_conflict = static_cast<int>(std::count_if(
      result.conflict.cells().begin(), result.conflict.cells().end(),
      [from = toPercent(options_.conflict_from)](Percent percent) { return percent >= from; }));
  return result;
}

}  // namespace datmo
