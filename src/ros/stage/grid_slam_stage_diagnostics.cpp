// SPDX-License-Identifier: BSD-3-Clause
// GridSlamStage's reports in /diagnostics on its input, the match and whether it is located.
#include <string>

#include "datmo_fusion/ros/stage/grid_slam_stage.h"

namespace datmo {

void GridSlamStage::warnOf(const ScannerMount& mount, const ConvertedScan& converted) {
  for (const InputError& fault :
       faultsOf(mount, converted, options_.max_tilt, "goes on with the predicted pose")) {
    monitor_.warned(fault);
  }
  if (const auto misfit = extent_.take(converted.scan)) {
    monitor_.warned(*misfit);
  }
}

void GridSlamStage::showLocalization(const SlamResult& result) {
  monitor_.figure("maps started over", result.maps_begun);
  switch (result.localization) {
    case Localization::kLocated:
      if (result.maps_begun > maps_begun_) {
        monitor_.condition(HealthLevel::kOk,
                           "not found again: goes on in a new map, and the pose's "
                           "covariance keeps what is not known of it");
      } else if (result.may_be_kidnapped) {
        monitor_.condition(HealthLevel::kDegraded,
                           "the map contradicts what is seen, as if the vehicle had been carried "
                           "elsewhere: its pose is not known, and nothing is written to the map");
      } else if (monitor_.health() != HealthLevel::kOk) {
        monitor_.condition(HealthLevel::kOk, "located in the map");
      }
      maps_begun_ = result.maps_begun;
      return;
    case Localization::kUncertain:
    case Localization::kLost:
      showSearch(result);
      return;
  }
}

void GridSlamStage::showSearch(const SlamResult& result) {
  const bool is_lost = result.localization == Localization::kLost;
  const HealthLevel health = is_lost ? HealthLevel::kNoOutput : HealthLevel::kDegraded;
  if (result.searches_prior_map) {
    monitor_.condition(health, std::string(is_lost ? "lost" : "uncertain") +
                                   ": searches the prior map, and writes nothing to it until one "
                                   "place alone fits what was seen on the way");
  } else if (result.kidnapped) {
    monitor_.condition(health,
                       "carried elsewhere, as the map contradicts what is seen: searches all of "
                       "its window, and keeps the map as it was");
  } else if (is_lost) {
    monitor_.condition(health,
                       "lost after a gap: the map fits nowhere that the vehicle can be, or that is "
                       "too much of it");
  } else {
    monitor_.condition(health,
                       "uncertain where in the map after a gap: searches, and keeps the map as it "
                       "was");
  }
}

void GridSlamStage::showForgottenTiles() {
  const OccupancyMap& map = slam_.lastingMap();
  const std::size_t forgotten = map.forgottenTiles();
  monitor_.figure("tiles of the map that were forgotten", static_cast<double>(forgotten));
  if (forgotten > forgotten_tiles_) {
    forgotten_tiles_ = forgotten;
    monitor_.warned(
        InputError("forgotten_tile",
                   "the oldest tiles of the map are forgotten, and save_map will not have "
                   "them: there are more than map/max_tiles, and " +
                       map.tileFileError()));
  }
}

void GridSlamStage::showMatch(const SlamResult& result) {
  const MatchQuality& match = result.match;
  degenerate_scans_ += match.degenerate ? 1 : 0;
  monitor_.figure("points matched", match.matched_points);
  monitor_.figure("match score, 0 to 1", match.score);
  monitor_.figure("weakest direction of the match [m]", match.weakest_sigma);
  monitor_.figure("scans with a direction left to the odometry",
                  static_cast<double>(degenerate_scans_));
  monitor_.figure("odometry's scale error", result.odometry_errors.speed_scale);
  monitor_.figure("odometry's yaw rate bias [rad/s]", result.odometry_errors.yaw_rate_bias);
}

}  // namespace datmo
