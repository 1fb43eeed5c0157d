// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/lidar_grid_stage.h"

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/convert/grid_conversion.h"
#include "datmo_fusion/ros/stage/stage_inputs.h"

namespace datmo {

void LidarGridStageOptions::visit(OptionVisitor& visitor) {
  visitor.number({"max_tilt", "rad", "a scan plane tilted by more than this causes a warning"},
                 max_tilt, {0.0, kQuarterTurn});
  visitor.group("input", [&] { input.visit(visitor); });
  visitor.group("scan", [&] { scan.visit(visitor); });
  grid.visit(visitor);
}

SharedKeys LidarGridStageOptions::sharedKeys() {
  return SharedKeys()
      .group<ScanConversionOptions>("scan/", "scanner/")
      .key("max_tilt", "scanner/max_tilt")
      .group<BeamEndOptions>("", "scanner/")
      .key("beam_width", "scanner/beam_width");
}

LidarGridStage::LidarGridStage(const Checked<LidarGridStageOptions>& options,
                               const TransformBuffer& transforms, StageMonitor& monitor)
    : options_(*options),
      transforms_(transforms),
      monitor_(monitor),
      model_(options->grid),
      runner_(monitor, options->input, "forgets the vehicle's motion",
              [this] {
                motion_.reset();
                frozen_.reset();
              }),
      motion_(options->motion, options->frames, runner_) {}

template <typename Message>
nav_msgs::OccupancyGridPtr LidarGridStage::handleScan(const Message& message) {
  return runner_.serve("scan", message, [&] {
    const ScannerMount mount =
        scannerMount(transforms_.core(), options_.frames.base, message.header.frame_id);
    const ConvertedScan converted = toScan(message, mount, options_.scan);
    runner_.check("scan", message.header.stamp);
    const auto motion = [this](Stamp from, Stamp to) { return motion_.between(from, to); };
    checkNotFrozen(frozen_.update(converted.scan.stamp, measuredBytes(message), motion), monitor_);
    warnOf(mount, converted);
    auto grid = boost::make_shared<nav_msgs::OccupancyGrid>(
        toMessage(model_.grid(motion_.compensated(converted.scan)), options_.frames.base));
    runner_.processed(converted.scan.stamp);
    return grid;
  });
}

template nav_msgs::OccupancyGridPtr LidarGridStage::handleScan(const sensor_msgs::LaserScan&);
template nav_msgs::OccupancyGridPtr LidarGridStage::handleScan(
    const sensor_msgs::MultiEchoLaserScan&);

void LidarGridStage::warnOf(const ScannerMount& mount, const ConvertedScan& converted) {
  for (const InputError& fault :
       faultsOf(mount, converted, options_.max_tilt, "its grid is all unknown")) {
    monitor_.warned(fault);
  }
  monitor_.figure("beams with a hit", static_cast<double>(converted.beams.hits));
}

void LidarGridStage::connect(StagePorts& ports) {
  const auto grid = ports.out<nav_msgs::OccupancyGrid>("grids/lidar");
  connectMotion(ports, options_.motion, *this);
  const auto handle_scan = [this, grid](const auto& scan, Stamp /*now*/) {
    grid.publish(handleScan(*scan));
  };
  connectScan(ports, monitor_, handle_scan);
}

}  // namespace datmo
