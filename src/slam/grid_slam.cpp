// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/grid_slam.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "datmo_fusion/slam/motion_compensation.h"

namespace datmo {

namespace {

/// Each pass halves what is wrong with the yaw rate, where the beams go all round.
constexpr int kPassesWithoutOdometry = 4;

/// Without scans the pose follows the odometry before the buffer forgets it, this long (s) behind:
/// for a scan that is still on its way.
constexpr double kScanDelay = 0.4 * kOdometryMemory;

/// Of a motion that counts as measured, the largest share that may be extrapolated.
constexpr double kMaxExtrapolated = 0.5;

/// State of each ray, in order; kUnknown for beams without a hit.
std::vector<PointState> judge(const Scan& scan, const OccupancyMap& map, const Pose2& base_in_map) {
  std::vector<PointState> states;
  states.reserve(scan.rays.size());
  for (const Ray& ray : scan.rays) {
    const Point2 half_footprint = 0.5 * stepAcross(ray, scan.field.beam_spacing);
    states.push_back(ray.hit ? map.judge(base_in_map * ray.end, base_in_map.rotate(half_footprint))
                             : PointState::kUnknown);
  }
  return states;
}

/// The scan with the scanner's own end points alone, where there are any: what others see is off by
/// their depth's error, no point to match the pose with, and nothing that hides what is behind.
Scan measuredScan(const GridMaskedScan& view) {
  Scan scan = view.scan;
  if (view.any_measured) {
    for (std::size_t i = 0; i < scan.rays.size(); ++i) {
      scan.rays[i].hit = scan.rays[i].hit && view.measured[i];
    }
  }
  return scan;
}

/// What the map takes of a grid: where beams end on what does not move, and occupied cells. What
/// others alone have seen is no point to match scans with, and is excluded where it belongs to a
/// mover, whose depth they blur, or lies in space that the map knows to be free.
GridUpdate gridUpdateOf(const GridMaskedScan& view, const std::vector<PointState>& states,
                        const SensorGrid& grid, const OccupancyMap& map, const Pose2& base_in_map) {
  GridUpdate grid_update;
  std::vector<Point2> others = view.cells;
  for (std::size_t i = 0; i < view.scan.rays.size(); ++i) {
    const Ray& ray = view.scan.rays[i];
    if (!ray.hit) {
      continue;
    }
    if (view.any_measured && !view.measured[i]) {
      others.push_back(ray.end);
    } else {
      (states[i] == PointState::kMoving ? grid_update.movers : grid_update.surfaces)
          .push_back(ray.end);
    }
  }
  std::vector<Point2>& target = view.any_measured ? grid_update.cells : grid_update.surfaces;
  for (const Point2& position : excludeConnectedTo(grid_update.movers, grid, others)) {
    if (map.judge(base_in_map * position) != PointState::kMoving) {
      target.push_back(position);
    }
  }
  grid_update.refuted = view.refuted;
  grid_update.viewpoint = view.scan.scanner_in_base.position();
  return grid_update;
}

/// Beams of the scan that have no ray.
std::vector<std::uint32_t> blindBeams(const Scan& scan) {
  std::vector<std::uint32_t> blind;
  std::uint32_t beam = 0;
  for (const Ray& ray : scan.rays) {
    for (; beam < ray.beam; ++beam) {
      blind.push_back(beam);
    }
    beam = ray.beam + 1;
  }
  for (; beam < scan.field.beams; ++beam) {
    blind.push_back(beam);
  }
  return blind;
}

/// Removes the beams of `measured` whose ends the grid does not confirm, if there are others:
/// sensors that contradict each other give no evidence, neither of occupied nor of free space.
void removeConflictingBeams(const Scan& measured, const GridMaskedScan& view, Scan& scan,
                            std::vector<PointState>& states) {
  if (!view.any_measured) {
    return;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < scan.rays.size(); ++i) {
    if (!measured.rays[i].hit || view.measured[i]) {
      scan.rays[kept] = scan.rays[i];
      states[kept] = states[i];
      ++kept;
    }
  }
  scan.rays.resize(kept);
  states.resize(kept);
}

LabeledScan label(const Scan& scan, const std::vector<PointState>& states,
                  const PoseWithCovariance& base_in_map) {
  LabeledScan result{scan.stamp, base_in_map,      scan.scanner_in_base,
                     scan.field, blindBeams(scan), {}};
  for (std::size_t i = 0; i < scan.rays.size(); ++i) {
    const Ray& ray = scan.rays[i];
    if (ray.hit) {
      result.points.push_back({ray.end, ray.range, ray.bearing, ray.beam, states[i]});
    }
  }
  return result;
}

}  // namespace

void GridSlamOptions::visit(OptionVisitor& visitor) {
  visitor.group("map", [&] { map.visit(visitor); });
  visitor.group("motion", [&] { motion.visit(visitor); });
  visitor.group("pose", [&] { pose.visit(visitor); });
  visitor.group("matcher", [&] { matcher.visit(visitor); });
  visitor.group("recovery", [&] { recovery.visit(visitor); });
  visitor.toggle({"motion_compensation", "",
                  "bring each beam from its own time to the scan's stamp; false: take all beams of "
                  "a scan as measured at once (thesis)"},
                 motion_compensation);
  visitor.number(
      {"max_step", "m", "neighboring end points further apart are on different surfaces"}, max_step,
      {0.05, 20.0});
  visitor.choice(
      {"grid_ends", "",
       "where the obstacles of a fused grid lie: 'scan', where a beam ends in an occupied "
       "cell, 'cells', at the cells' centers (thesis 3.2.5)"},
      grid_ends, {{"scan", GridEnds::kScan}, {"cells", GridEnds::kCells}});
  visitor.integer({"seed", "1", "of the random numbers with which poses are drawn"}, seed,
                  {0, 2147483647});
}

GridSlam::GridSlam(const Checked<GridSlamOptions>& options)
    : options_(*options),
      matcher_(options->matcher),
      map_(options->map),
      odometry_(options->odometry_hold, kOdometryMemory),
      random_(static_cast<std::uint64_t>(options->seed)),
      filter_(options->pose, options->motion),
      drift_(noDrift()),
      drift_of_left_map_(drift_) {}

void GridSlam::addOdometry(const OdometrySample& sample) {
  odometry_.add(sample);
  if (stamp_ && secondsBetween(*stamp_, sample.stamp) > 2.0 * kScanDelay) {
    const Stamp behind = sample.stamp + -kScanDelay;
    predict(behind);
    stamp_ = behind;
  }
}

bool GridSlam::predict(Stamp stamp) {
  const double seconds = secondsBetween(*stamp_, stamp);
  const auto measured = odometry_.motion(*stamp_, stamp, filter_.errors(), estimatedSpeed());
  const double extrapolated = std::min(odometry_.overdue(stamp), seconds);
  if (!measured && isGap(seconds)) {
    filter_.predictGap(seconds, odometry_.twistAt(stamp));
  } else if (!measured) {
    filter_.predictUnmeasured(seconds);
  } else if (!odometry_.measuresSpeed()) {
    filter_.predictTurn(*measured, seconds);
  } else if (extrapolated > 0.0) {
    extrapolate(stamp, extrapolated);
  } else {
    filter_.predictMeasured(*measured, seconds);
  }
  if (const auto corrected = anchor_.correction(stamp, filter_, odometry_)) {
    if (recovery_) {
      returnToMap();
    }
    filter_ = *corrected;
    return true;
  }
  return measured && odometry_.measuresSpeed() && extrapolated <= kMaxExtrapolated * seconds;
}

void GridSlam::extrapolate(Stamp stamp, double seconds) {
  const Stamp due = stamp + -seconds;
  const OdometrySample& newest = *odometry_.newest();
  if (due > *stamp_) {
    const auto measured = odometry_.motion(*stamp_, due, filter_.errors(), estimatedSpeed());
    filter_.predictMeasured(measured.value_or(Pose2()), secondsBetween(*stamp_, due));
  } else if (newest.stamp > late_odometry_ && newest.twist_measured) {
    filter_.observeVelocity(filter_.errors().correct(newest.twist),
                            std::max(0.0, secondsBetween(newest.stamp, *stamp_)));
  }
  late_odometry_ = newest.stamp;
  filter_.predictUnmeasured(seconds);
}

Scan GridSlam::compensated(const Scan& scan) const {
  const double duration = sweepDuration(scan);
  if (!options_.motion_compensation || duration == 0.0) {
    return scan;
  }
  const auto measured =
      odometry_.motion(scan.stamp, scan.stamp + duration, filter_.errors(), estimatedSpeed());
  return compensateMotion(scan, measured ? twistOf(*measured, duration) : filter_.velocity());
}

GridMaskedScan GridSlam::viewOf(const Measurement& measurement,
                                const Scan& compensated_scan) const {
  if (measurement.grid != nullptr) {
    return maskScanWithGrid(*measurement.grid, compensated_scan, options_.grid_ends);
  }
  return {compensated_scan, std::vector<bool>(compensated_scan.rays.size(), true), true, {}, {}};
}

Scan GridSlam::locate(const Measurement& measurement, SlamResult& result) {
  const PoseFilter predicted = filter_;
  const bool guessed = !result.odometry_used && sweepDuration(measurement.scan) > 0.0;
  Scan scan = compensated(measurement.scan);
  for (int pass = 0; pass < (guessed ? kPassesWithoutOdometry : 1); ++pass) {
    const Scan seen = measuredScan(viewOf(measurement, scan));
    const MatchResult match = matcher_.match(map_, endPoints(seen, options_.max_step),
                                             {predicted.pose(), result.odometry_used}, random_);
    filter_ = predicted;
    filter_.correct(match.pose);
    result.match = match.quality;
    scan = guessed ? compensated(measurement.scan) : scan;
  }
  return scan;
}

SlamResult GridSlam::process(const Scan& scan) { return process(Measurement{scan}); }

SlamResult GridSlam::process(const SensorGrid& grid, const Scan& scan) {
  return process(Measurement{scan, &grid});
}

SlamResult GridSlam::process(const Measurement& measurement) {
  SlamResult result;
  const Stamp stamp = measurement.scan.stamp;
  if (stamp_) {
    undoGapForOdometry(stamp);
    result.odometry_used = stamp > *stamp_ && predict(stamp);
    leaveMapAfterGap(stamp);
    map_.centerOn(filter_.pose().pose.position());
  } else if (prior_map_) {
    searchPriorMap(prior_map_->map, prior_map_->start, stamp);
  }
  const Scan scan = stamp_ ? locate(measurement, result) : compensated(measurement.scan);
  const PoseWithCovariance base_in_map = poseInFirstMap();
  followDrift(base_in_map, scan, result);
  const GridMaskedScan view = viewOf(measurement, scan);
  Scan own = measuredScan(view);
  std::vector<PointState> states = judge(own, map_, base_in_map.pose);
  if (measurement.grid != nullptr) {
    const SensorGrid free_cells = withoutFreeEdges(*measurement.grid);
    GridUpdate grid_update = gridUpdateOf(view, states, *measurement.grid, map_, base_in_map.pose);
    grid_update.grid = &free_cells;
    map_.update(grid_update, base_in_map.pose);
  } else {
    map_.update(scan, states, base_in_map.pose);
  }
  stamp_ = std::max(stamp, stamp_.value_or(stamp));
  if (!recovery_) {  // else the pose is in the newer map's frame, and the anchor leads to the older
    anchor_.keep(stamp, filter_, odometry_);
  }
  result.odometry_errors = filter_.errors();
  result.localization = recovery_ ? recovery_->state() : Localization::kLocated;
  result.searches_prior_map = recovery_ && recovery_->isInPriorMap();
  removeConflictingBeams(scan, view, own, states);
  if (recovery_) {
    std::replace(states.begin(), states.end(), PointState::kMoving, PointState::kUnknown);
  }
  result.labeled_scan = label(own, states, base_in_map);
  rememberScan(scan);
  recover(stamp);
  result.maps_begun = maps_begun_;
  return result;
}

void GridSlam::reset() {
  GridSlam anew(options_);
  anew.prior_map_ = prior_map_;
  *this = std::move(anew);
}

}  // namespace datmo
