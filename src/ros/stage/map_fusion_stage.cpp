// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/map_fusion_stage.h"

#include <memory>
#include <utility>

#include <boost/make_shared.hpp>

#include "datmo_fusion/fusion/grid/grid_matcher.h"
#include "datmo_fusion/fusion/sync/relative_motion.h"
#include "datmo_fusion/ros/convert/grid_conversion.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/map_files.h"
#include "datmo_fusion/ros/stage/stage_inputs.h"
#include "datmo_fusion/slam/keyframe_selector.h"

namespace datmo {

namespace {

/// The source of the poses.
constexpr char kPoses[] = "labeled_scan";

SourceMatcherOptions matcherOptions(const MapFusionStageOptions& options) {
  SourceMatcherOptions matcher;
  matcher.reference = kPoses;
  matcher.tolerance = options.tolerance;
  matcher.max_wait = options.max_wait;
  return matcher;
}

std::vector<std::string> withPoses(std::vector<std::string> sources) {
  sources.emplace_back(kPoses);
  return sources;
}

std::vector<Point2> moversOf(const LabeledScan& scan) {
  std::vector<Point2> movers;
  for (const ScanPoint& point : scan.points) {
    if (point.state == PointState::kMoving) {
      movers.push_back(scan.base_in_map.pose * point.position);
    }
  }
  return movers;
}

}  // namespace

void MapFusionStageOptions::visit(OptionVisitor& visitor) {
  visitor.group("input", [&] { input.visit(visitor); });
  visitor.number({"period", "s", "minimum time between two fused maps, by their stamps"}, period,
                 {0.0, 3600.0});
  visitor.number(
      {"tolerance", "s", "maximum time between a grid and a pose with which it is fused"},
      tolerance, {0.0, 1.0});
  visitor.number({"max_wait", "s", "longest time that a pose waits for the grids"}, max_wait,
                 {0.0, 1.0});
  visitor.text({"prior_map", "",
                "absolute path of the map that grid_slam starts in (its prior_map/file): an "
                "additional source, and the reference for changes; empty: none"},
               prior_map, {});
  fuser.visit(visitor);
}

MapFusionStage::MapFusionStage(const Checked<MapFusionStageOptions>& options, StageMonitor& monitor)
    : options_(*options),
      monitor_(monitor),
      runner_(monitor, options->input, "forgets the sensors' maps", [this] { reset(); }),
      inputs_({options->frames.base, options->frames, options->motion, options->input,
               matcherOptions(*options), withPoses(sources()), "message"},
              runner_),
      matcher_(matcherOptions(*options), withPoses(sources()), Serving::kOnce),
      fuser_(options->fuser) {
  checkSourceNames(sources(), "grid", {"fused", "conflict", kPoses});
}

void MapFusionStage::reset() {
  inputs_.reset();
  matcher_.reset();
  fuser_.reset();
  last_pose_.reset();
  last_output_.reset();
}

void MapFusionStage::checkWindow(const std::string& source, const GridWindow& window) {
  if (!window_) {
    window_ = window;
    readPriorMap(window);
  }
  if (window != *window_) {
    throw InputError("wrong_window", "grid of " + source + " of " + describe(window) +
                                         ": expected " + describe(*window_) +
                                         ", as in the first grid");
  }
}

void MapFusionStage::readPriorMap(const GridWindow& window) {
  if (options_.prior_map.empty()) {
    return;
  }
  OccupancyMapOptions map;
  map.window.cell_size = window.cell_size;
  map.window.length = window.columns * window.cell_size;
  map.window.width = window.rows * window.cell_size;
  try {
    fuser_.setPrior(readMap(options_.prior_map, map));
  } catch (const std::exception& error) {  // out of memory, too
    monitor_.warned(InputError("bad_prior_map", error.what()));
    monitor_.condition(HealthLevel::kDegraded, "continues without the prior map");
  }
}

void MapFusionStage::handleGrid(const std::string& source, const nav_msgs::OccupancyGrid& message,
                                Stamp now) {
  runner_.serve([&] {
    SensorGrid grid = fromMessage(message);
    inputs_.check(source, message.header, now);
    checkWindow(source, grid.window());
    const Stamp stamp = grid.stamp();
    matcher_.add(source, stamp, std::make_shared<const Sample>(std::move(grid)));
  });
}

void MapFusionStage::handleLabeledScan(const LabeledScanMessage& message, Stamp now) {
  runner_.serve([&] {
    LabeledScan scan = fromMessage(message);
    if (message.map_frame != options_.frames.map) {
      throw InputError("wrong_frame", "labeled scan in a map '" + message.map_frame +
                                          "': expected '" + options_.frames.map + "'");
    }
    inputs_.check(kPoses, message.header, now);
    const Stamp stamp = scan.stamp;
    matcher_.add(kPoses, stamp, std::make_shared<const Sample>(std::move(scan)));
  });
}

std::optional<MapFusionOutput> MapFusionStage::next(Stamp now) {
  return runner_.serve([&]() -> std::optional<MapFusionOutput> {
    const std::optional<Matched> matched = inputs_.nextOf(matcher_, now);
    return matched ? std::make_optional(fuse(*matched)) : std::nullopt;
  });
}

MapFusionOutput MapFusionStage::fuse(const Matched& matched) {
  const auto* const scan = std::get_if<LabeledScan>(matched.reference().payload.get());
  if (scan == nullptr) {  // poses are silent: another source led the set
    inputs_.report(matched.stamp(), matched.missing);
    return {};
  }
  inputs_.report(matched.stamp(), ingest(matched, *scan));
  MapFusionOutput output;
  if (!last_output_ || secondsBetween(*last_output_, matched.stamp()) >= options_.period) {
    output = outputAt(matched.stamp());
  }
  inputs_.reportUnserved(matcher_);
  runner_.processed(matched.stamp());
  return output;
}

std::vector<MissingSource> MapFusionStage::ingest(const Matched& matched, const LabeledScan& scan) {
  std::vector<MissingSource> missing = matched.missing;
  if (fuser_.isLessCertain(scan.base_in_map) && last_pose_ &&
      secondsBetween(*last_pose_, scan.stamp) < KeyframeOptions().new_map_after) {
    monitor_.figure("scans left out because of an uncertain pose",
                    static_cast<double>(++left_out_));
    return missing;
  }
  const std::vector<Point2> movers = moversOf(scan);
  fuser_.moveTo(scan.base_in_map,
                last_pose_ ? inputs_.motion(*last_pose_, scan.stamp) : std::nullopt);
  last_pose_ = scan.stamp;
  for (const SourceSample<Sample>& sample : matched.samples) {
    const auto* const grid = std::get_if<SensorGrid>(sample.payload.get());
    if (grid == nullptr) {
      continue;
    }
    const auto base = baseAt(sample.stamp, scan.stamp,
                             [this](Stamp from, Stamp to) { return inputs_.motion(from, to); });
    if (base) {
      fuser_.add(sample.source, *grid, scan.base_in_map.pose * *base, movers);
    } else {
      missing.push_back({sample.source, WhyMissing::kNoMotion});
    }
  }
  return missing;
}

MapFusionOutput MapFusionStage::outputAt(Stamp stamp) {
  std::optional<FusedMaps> maps = fuser_.fuse(stamp);
  if (!maps) {
    return {};
  }
  last_output_ = stamp;
  show(*maps);
  const auto toOutput = [this](SensorGrid& grid) {
    return boost::make_shared<nav_msgs::OccupancyGrid>(
        toMessage(std::move(grid), options_.frames.map));
  };
  return {toOutput(maps->fused), toOutput(maps->conflict),
          maps->changes ? toOutput(maps->changes->grid) : nullptr};
}

void MapFusionStage::show(const FusedMaps& maps) {
  monitor_.figure("cells in conflict", maps.cells_in_conflict);
  monitor_.figure("maps started over", fuser_.mapsBegun());
  if (maps.changes) {
    monitor_.figure("cells new since the prior map", maps.changes->appeared);
    monitor_.figure("cells vanished since the prior map", maps.changes->vanished);
  }
}

void MapFusionStage::connect(StagePorts& ports) {
  fused_ = ports.out<nav_msgs::OccupancyGrid>("map/fused", true);
  conflicts_ = ports.out<nav_msgs::OccupancyGrid>("map/conflicts", true);
  changes_ = ports.out<nav_msgs::OccupancyGrid>("map/changes", true);
  connectMotion(ports, options_.motion, *this);
  for (const std::string& source : sources()) {
    ports.in<nav_msgs::OccupancyGrid>(
        "grids/" + source,
        [this, source](const auto& grid, Stamp now) { handleGrid(source, *grid, now); });
  }
  ports.in<LabeledScanMessage>(
      kPoses, [this](const auto& scan, Stamp now) { handleLabeledScan(*scan, now); });
}

bool MapFusionStage::publishNext(Stamp now) {
  const auto output = next(now);
  if (output) {
    fused_.publish(output->fused);
    conflicts_.publish(output->conflicts);
    changes_.publish(output->changes);
  }
  return output.has_value();
}

}  // namespace datmo
