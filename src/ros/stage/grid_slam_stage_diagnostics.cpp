// SPDX-License-Identifier: BSD-3-Clause
// What GridSlamStage reports about its input, the match and whether the vehicle is located.
#include <cstdint>
#include <string>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/grid_slam_stage.h"

namespace datmo {

namespace {

std::uint8_t stateOf(const SlamResult& result) {
  switch (result.localization) {
    case Localization::kLost:
      return LocalizationState::LOST;
    case Localization::kUncertain:
      return LocalizationState::UNCERTAIN;
    case Localization::kLocated:
      break;
  }
  return result.may_be_kidnapped ? LocalizationState::UNCERTAIN : LocalizationState::LOCATED;
}

/// In words, why the vehicle is not located; empty while it is.
std::string reasonOf(const SlamResult& result) {
  const bool is_lost = result.localization == Localization::kLost;
  if (result.localization == Localization::kLocated) {
    return result.may_be_kidnapped ? "the map contradicts the scans, as if the vehicle had been "
                                     "kidnapped: its pose is unknown, and the map is not updated"
                                   : "";
  }
  if (result.searches_prior_map) {
    return std::string(is_lost ? "lost" : "uncertain") +
           ": searches the prior map, and does not update it until a single position fits the "
           "scans while driving";
  }
  if (result.kidnapped) {
    return "kidnapped, since the map contradicts the scans: searches all of its window, and does "
           "not update the map";
  }
  return is_lost ? "lost after a gap: the scan does not fit the map anywhere within reach of the "
                   "vehicle, or that area is too large to search"
                 : "uncertain of the pose in the map after a gap: searches, and does not update "
                   "the map";
}

}  // namespace

void GridSlamStage::warnOf(const ScannerMount& mount, const ConvertedScan& converted) {
  for (const InputError& fault :
       faultsOf(mount, converted, options_.max_tilt, "continues with the predicted pose")) {
    monitor_.warned(fault);
  }
  if (const auto misfit = extent_.update(converted.scan)) {
    monitor_.warned(*misfit);
  }
}

LocalizationStatePtr GridSlamStage::localizationOf(const SlamResult& result) const {
  const auto message = boost::make_shared<LocalizationState>();
  message->header.stamp = toTime(result.labeled_scan.stamp);
  message->header.frame_id = options_.frames.map;
  message->state = stateOf(result);
  message->maps_started = static_cast<std::uint32_t>(result.maps_begun);
  message->reason = reasonOf(result);
  return message;
}

void GridSlamStage::showLocalization(const LocalizationState& state) {
  monitor_.figure("maps started over", state.maps_started);
  if (state.state != LocalizationState::LOCATED) {
    monitor_.condition(
        state.state == LocalizationState::LOST ? HealthLevel::kNoOutput : HealthLevel::kDegraded,
        state.reason);
    return;
  }
  if (state.maps_started > maps_started_) {
    monitor_.condition(HealthLevel::kOk,
                       "pose not recovered: continues in a new map, and the pose's covariance "
                       "keeps the uncertainty");
  } else if (monitor_.health() != HealthLevel::kOk) {
    monitor_.condition(HealthLevel::kOk, "located in the map");
  }
  maps_started_ = state.maps_started;
}

void GridSlamStage::showForgottenTiles() {
  const OccupancyMap& map = slam_.lastingMap();
  const std::size_t forgotten = map.forgottenTiles();
  monitor_.figure("forgotten tiles of the map", static_cast<double>(forgotten));
  if (forgotten > forgotten_tiles_) {
    forgotten_tiles_ = forgotten;
    monitor_.warned(InputError("forgotten_tile",
                               "the oldest tiles of the map are forgotten, and save_map will not "
                               "contain them: there are more than map/max_tiles, and " +
                                   map.tileFileError()));
  }
}

void GridSlamStage::showMatch(const SlamResult& result) {
  const MatchQuality& match = result.match;
  degenerate_scans_ += match.degenerate ? 1 : 0;
  monitor_.figure("points matched", match.matched_points);
  monitor_.figure("match score, 0 to 1", match.score);
  monitor_.figure("weakest direction of the match [m]", match.weakest_sigma);
  monitor_.figure("scans with a degenerate direction", static_cast<double>(degenerate_scans_));
  monitor_.figure("odometry's scale error", result.odometry_errors.speed_scale);
  monitor_.figure("odometry's yaw rate bias [rad/s]", result.odometry_errors.yaw_rate_bias);
}

}  // namespace datmo
