// SPDX-License-Identifier: BSD-3-Clause
// GridSlamStage's handling of maps, their files, and their frame.
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/grid_slam_stage.h"
#include "datmo_fusion/ros/stage/map_saving.h"

namespace datmo {

void GridSlamStage::readPriorMap() {
  const std::string& file = options_.prior_map.file;
  if (file.empty()) {
    return;
  }
  try {
    slam_.startIn({readMap(file, options_.slam.map), options_.prior_map.start()});
  } catch (const MapFileError& error) {
    throw OptionError(std::string("prior_map/file: ") + error.what());
  } catch (const std::invalid_argument& error) {
    throw OptionError("prior_map/file: " + file + ": " + error.what());
  }
}

void GridSlamStage::continueAt(Stamp stamp) {
  if (!checkpoints_) {
    return;
  }
  if (const auto checkpoint = checkpoints_->takeAt(stamp)) {
    slam_.continueFrom(checkpoint->slam, checkpoint->window.cells);
    maps_started_ = static_cast<std::uint32_t>(checkpoint->slam.map.maps_begun);
  }
}

void GridSlamStage::keepCheckpoint() {
  if (checkpoints_) {
    checkpoints_->keep(slam_);
  }
}

std::string GridSlamStage::saveMap(const std::string& file) const {
  return savedMapText(file, slam_.lastingMap());
}

/// Whether saving there would overwrite a file of the prior map.
bool GridSlamStage::isOfPriorMap(const std::string& file) const {
  const std::string& prior = options_.prior_map.file;
  return !prior.empty() && mapServerNames(file).yaml == mapServerNames(prior).yaml;
}

datmo_fusion::SaveMap::Response GridSlamStage::answer(
    const datmo_fusion::SaveMap::Request& request) const {
  return answerSaveMap(request, monitor_, [this](const std::string& file) {
    if (isOfPriorMap(file)) {
      throw MapFileError(file + ": the map in use, expected another name");
    }
    return saveMap(file);
  });
}

nav_msgs::OccupancyGridPtr GridSlamStage::mapIfDue(Stamp stamp) {
  if (last_map_ && secondsBetween(*last_map_, stamp) < options_.map_period) {
    return nullptr;
  }
  last_map_ = stamp;
  showForgottenTiles();
  return boost::make_shared<nav_msgs::OccupancyGrid>(
      toMessage(slam_.map(), stamp, options_.frames.map));
}

tf2_msgs::TFMessagePtr GridSlamStage::heldAt(Stamp stamp, Stamp now) const {
  const auto held = held_.at(stamp, now);
  if (!held) {
    return nullptr;
  }
  const auto message = boost::make_shared<tf2_msgs::TFMessage>();
  message->transforms = {*held};
  return message;
}

}  // namespace datmo
