// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/slam/grid_slam.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "datmo_fusion/slam/motion_compensation.h"
#include "datmo_fusion/slam/scan_labeling.h"
#include "datmo_fusion/slam/slam_measurement.h"

namespace datmo {

namespace {

/// Each pass halves the error of the yaw rate, if the field of view is 360 degrees.
constexpr int kPassesWithoutOdometry = 4;

/// Mean range of the beams with a hit, m; 0 without any.
double meanRange(const Scan& scan) {
  double sum = 0.0;
  int hits = 0;
  for (const Ray& ray : scan.rays) {
    sum += ray.hit ? ray.range : 0.0;
    hits += ray.hit ? 1 : 0;
  }
  return hits > 0 ? sum / hits : 0.0;
}

}  // namespace

void GridSlamOptions::visit(OptionVisitor& visitor) {
  visitor.group("map", [&] { map.visit(visitor); });
  visitor.group("motion", [&] { motion.visit(visitor); });
  visitor.group("pose", [&] { pose.visit(visitor); });
  visitor.group("matcher", [&] { matcher.visit(visitor); });
  visitor.group("recovery", [&] { recovery.visit(visitor); });
  visitor.toggle({"motion_compensation", "",
                  "move each beam from its own time to the scan's stamp; false: treat all beams of "
                  "a scan as measured at once (thesis)"},
                 motion_compensation);
  visitor.number(
      {"max_step", "m", "neighboring end points farther apart lie on different surfaces"}, max_step,
      {0.05, 20.0});
  visitor.choice({"grid_ends", "",
                  "where the obstacles of a fused grid lie: 'scan', where a beam ends in an "
                  "occupied cell, 'cells', at the cells' centers (thesis 3.2.5)"},
                 grid_ends, {{"scan", GridEnds::kScan}, {"cells", GridEnds::kCells}});
  visitor.integer({"seed", "1", "seed of the random numbers with which poses are sampled"}, seed,
                  {0, 2147483647});
}

GridSlam::GridSlam(const Checked<GridSlamOptions>& options)
    : options_(*options),
      matcher_(options->matcher),
      random_(static_cast<std::uint64_t>(options->seed)),
      tracker_(options->pose, options->motion, options->odometry_hold),
      maps_(options->map, options->recovery, tracker_.filter().scalePrior()),
      kidnapping_(options->recovery.min_kidnapped_log_ratio, options->recovery.kidnapped_after) {}

std::optional<SlamState> GridSlam::state() const {
  const auto pose = tracker_.state();
  const auto map = maps_.state();
  return pose && map && !kidnapping_.isSuspected() ? std::make_optional(SlamState{*pose, *map})
                                                   : std::nullopt;
}

void GridSlam::continueFrom(const SlamState& state, const std::vector<CellEvidence>& window) {
  tracker_.continueFrom(state.pose);
  continued_from_ = tracker_.pose().pose;
  maps_.continueFrom(state.map, window, *continued_from_);
}

void GridSlam::addOdometry(const OdometrySample& sample) { follow(tracker_.addOdometry(sample)); }

bool GridSlam::follow(const PoseTracker::Prediction& prediction) {
  if (prediction.anchored && maps_.isSearching()) {
    maps_.returnToLeftMap();
  }
  return prediction.by_odometry;
}

SlamResult GridSlam::process(const Scan& scan) { return process(SlamMeasurement{scan}); }

SlamResult GridSlam::process(const SensorGrid& grid, const Scan& scan) {
  return process(SlamMeasurement{scan, &grid});
}

SlamResult GridSlam::process(const SlamMeasurement& measurement) {
  SlamResult result;
  const Stamp stamp = measurement.scan.stamp;
  const bool is_first = !tracker_.hasBegun();
  if (!is_first) {
    result.odometry_used = predict(stamp);
  } else if (maps_.hasPriorMap()) {
    tracker_.restartAt(maps_.startInPriorMap(stamp));
  }
  const PoseFilter predicted = tracker_.filter();
  const PreparedScan scan = is_first ? prepared(measurement) : locate(measurement, result);
  const PoseWithCovariance base_in_map = maps_.inFirstMap(tracker_.pose());
  write(scan, measurement.grid, base_in_map, result);
  if (result.may_be_kidnapped) {
    discardMatch(predicted, result);
  }
  followDrift(scan.compensated, result);
  if (result.may_be_kidnapped) {
    leaveIfKidnapped(stamp);
  }
  result.odometry_errors = tracker_.filter().errors();
  result.localization = maps_.localization();
  result.searches_prior_map = maps_.isSearchingPriorMap();
  result.kidnapped = maps_.isSearchingKidnapped();
  tracker_.keepScan(stamp, !scan.compensated.rays.empty(), !maps_.isSearching());
  result.maps_begun = maps_.mapsBegun();
  search(stamp);
  if (!maps_.isSearching()) {
    continued_from_.reset();
  }
  return result;
}

bool GridSlam::predict(Stamp stamp) {
  if (tracker_.undoGap(stamp, maps_.isSearching())) {
    maps_.returnToLeftMap();
  }
  const bool by_odometry = follow(tracker_.predictTo(stamp));
  if (tracker_.isLostInGap(stamp, options_.recovery)) {
    leaveMap(stamp);
  }
  maps_.map().centerOn(tracker_.pose().pose.position());
  return by_odometry;
}

void GridSlam::leaveMap(Stamp stamp) {
  if (maps_.isSearchingPriorMap()) {
    tracker_.forgetAnchor();
  } else if (!maps_.isSearching()) {
    tracker_.awaitOdometryOfGap(stamp);
  }
  const PoseWithCovariance predicted = tracker_.pose();
  tracker_.restartAt(maps_.leave(predicted, stamp));
  if (wasDrivingMeanwhile(predicted.pose)) {
    maps_.endSearchAfter(PoseTracker::kOdometryDelay);
  }
  kidnapping_.reset();
}

bool GridSlam::wasDrivingMeanwhile(const Pose2& predicted) const {
  return continued_from_ && !maps_.hasPriorMap() &&
         (predicted.position() - continued_from_->position()).norm() >
             options_.recovery.from_position_sigma;
}

bool GridSlam::mayBeKidnapped(const Scan& scan, const std::vector<PointState>& states) {
  if (!maps_.isSearching()) {  // a new map knows too little
    kidnapping_.add(scan.stamp, agreementOf(scan, states, maps_.map(), tracker_.pose().pose));
  }
  return kidnapping_.isSuspected();
}

void GridSlam::discardMatch(const PoseFilter& predicted, SlamResult& result) {
  tracker_.discardMatch(predicted);
  result.match.accepted = false;
  result.labeled_scan.base_in_map = anywhereAbout(maps_.inFirstMap(tracker_.pose()));
}

void GridSlam::leaveIfKidnapped(Stamp stamp) {
  if (!kidnapping_.isKidnapped()) {
    return;
  }
  tracker_.forgetAnchor();
  tracker_.restartAt(maps_.leaveKidnapped(tracker_.pose(), stamp));
  kidnapping_.reset();
}

void GridSlam::search(Stamp stamp) {
  const MapKeeper::SearchStep step = maps_.search(tracker_.pose(), stamp);
  if (step.found) {
    tracker_.restartAt(*step.found);
  }
  if (step.found || step.gave_up) {
    tracker_.forgetAnchor();
  }
}

Scan GridSlam::compensated(const Scan& scan) const {
  const double duration = sweepDuration(scan);
  if (!options_.motion_compensation || duration == 0.0) {
    return scan;
  }
  return compensateMotion(scan, tracker_.twistDuring(scan.stamp, duration));
}

PreparedScan GridSlam::prepared(const SlamMeasurement& measurement) const {
  return prepareScan(measurement, compensated(measurement.scan), options_.grid_ends);
}

PreparedScan GridSlam::locate(const SlamMeasurement& measurement, SlamResult& result) {
  const PoseFilter predicted = tracker_.filter();
  const bool guessed = !result.odometry_used && sweepDuration(measurement.scan) > 0.0;
  PreparedScan scan = prepared(measurement);
  for (int pass = 0; pass < (guessed ? kPassesWithoutOdometry : 1); ++pass) {
    const MatchResult match = matcher_.match(maps_.map(), endPoints(scan.own, options_.max_step),
                                             {predicted.pose(), result.odometry_used}, random_);
    tracker_.correct(predicted, match.pose);
    result.match = match.quality;
    if (guessed) {
      scan = prepared(measurement);
    }
  }
  return scan;
}

void GridSlam::followDrift(const Scan& scan, SlamResult& result) {
  MapDrift& drift = maps_.drift();
  drift.moveTo(maps_.inFirstMap(tracker_.pose()).pose, result.odometry_used);
  if (result.match.accepted) {
    drift.write({scan.stamp, tracker_.pose(), result.match.surface_age, meanRange(scan)});
  } else if (!result.may_be_kidnapped) {
    drift.writeUnmatched(tracker_.pose().covariance);
  }
  result.drift = drift.covariance();
}

void GridSlam::write(const PreparedScan& scan, const SensorGrid* grid,
                     const PoseWithCovariance& base_in_map, SlamResult& result) {
  OccupancyMap& map = maps_.map();
  std::vector<PointState> states = judgeRays(scan.own, map, base_in_map.pose);
  result.may_be_kidnapped = mayBeKidnapped(scan.own, states);
  if (result.may_be_kidnapped) {
    std::replace(states.begin(), states.end(), PointState::kMoving, PointState::kUnknown);
  } else if (grid != nullptr) {
    const SensorGrid free_cells = withoutFreeEdges(*grid);
    GridUpdate grid_update = gridUpdateOf(scan.view, states, *grid, map, base_in_map.pose);
    grid_update.grid = &free_cells;
    map.update(grid_update, base_in_map.pose);
  } else {
    map.update(scan.compensated, states, base_in_map.pose);
  }
  Scan own = scan.own;
  removeConflictingBeams(scan.compensated, scan.view, own, states);
  if (maps_.isSearching()) {
    std::replace(states.begin(), states.end(), PointState::kMoving, PointState::kUnknown);
  }
  result.labeled_scan = labelScan(own, states, base_in_map);
}

void GridSlam::reset() {
  GridSlam anew(options_);
  anew.maps_.sharePriorMap(maps_);
  *this = std::move(anew);
}

}  // namespace datmo
