#include "datmo_fusion/ros/grid_slam_stage.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <boost/make_shared.hpp>

#include "datmo_fusion/ros/grid_conversion.h"
#include "datmo_fusion/ros/message_conversion.h"

namespace datmo {

namespace {

/// A second of a fast scanner: more than grid fusion waits for a slow sensor.
constexpr std::size_t kMostWaitingScans = 50;

/// tf takes no frame without a name, and none that is its own parent.
void checkNames(const GridSlamStageOptions& options) {
  const std::string& map = options.map_frame;
  const std::string& odom = options.odom_frame;
  const std::string& base = options.base_frame;
  if (map.empty() || odom.empty() || base.empty() || map == odom || odom == base || base == map) {
    throw OptionError("map_frame = '" + map + "', odom_frame = '" + odom + "', base_frame = '" +
                      base + "': expected three different names");
  }
}

}  // namespace

void GridSlamStageOptions::visit(OptionVisitor& visitor) {
  visitor.text({"map_frame", "", "frame of the map and the pose"}, map_frame, {});
  visitor.text({"odom_frame", "", "frame of the odometry"}, odom_frame, {});
  visitor.text({"base_frame", "", "frame of the vehicle"}, base_frame, {});
  visitor.toggle(
      {"odometry", "",
       "the vehicle has odometry; false: predict with constant velocity, and publish odom "
       "-> base_link too"},
      odometry);
  visitor.toggle({"odometry_pose", "",
                  "the odometry's poses tell the motion, as a robot's wheel encoders count it; "
                  "false: its speed and yaw rate do"},
                 odometry_pose);
  visitor.toggle({"fused_grid", "",
                  "the measurement is the grid that grid_fusion made of the scan and other sensors "
                  "(thesis 3.2.5); false: the scan alone"},
                 fused_grid);
  visitor.number({"map_period", "s", "least time between two maps, of the scans' stamps"},
                 map_period, {0.0, 3600.0});
  visitor.number({"most_tilt", "rad", "a scan plane tilted by more than this is warned of"},
                 most_tilt, {0.0, kPi / 2.0});
  visitor.group("input", [&] { input.visit(visitor); });
  visitor.group("scan", [&] { scan.visit(visitor); });
  slam.visit(visitor);
}

GridSlamStage::GridSlamStage(const GridSlamStageOptions& options, const TransformBuffer& transforms,
                             StageMonitor& monitor)
    : options_(options),
      transforms_(transforms),
      monitor_(monitor),
      slam_(options.slam),
      scan_stamps_(options.input.restart_after),
      odometry_stamps_(options.input.restart_after),
      grid_stamps_(options.input.restart_after) {
  checkOptions(options);
  checkNames(options);
}

void GridSlamStage::takeOdometry(const nav_msgs::Odometry& message) {
  if (!options_.odometry) {
    return;
  }
  try {
    checkFrames(message);
    OdometryPose odometry{toSample(message), fromMessage(message.pose.pose)};
    if (options_.odometry_pose) {
      odometry.sample.base_in_odom = odometry.base_in_odom;
    }
    checkStamp(odometry_stamps_, message.header.stamp);
    slam_.addOdometry(odometry.sample);
    keep(odometry);
  } catch (const InputError& error) {
    monitor_.dropped(error);
  }
}

void GridSlamStage::keep(const OdometryPose& odometry) {
  odometry_.push_back(odometry);
  while (secondsBetween(odometry_.front().sample.stamp, odometry.sample.stamp) > kOdometryMemory) {
    odometry_.pop_front();
  }
}

std::optional<Pose2> GridSlamStage::baseInOdom(Stamp stamp) const {
  const auto later = std::upper_bound(
      odometry_.begin(), odometry_.end(), stamp,
      [](Stamp at, const OdometryPose& odometry) { return at < odometry.sample.stamp; });
  const auto nearest = later == odometry_.begin() ? later : std::prev(later);
  if (nearest == odometry_.end()) {
    return std::nullopt;
  }
  const double seconds = secondsBetween(nearest->sample.stamp, stamp);
  if (std::abs(seconds) > options_.slam.odometry_hold) {
    return std::nullopt;
  }
  return nearest->base_in_odom * arc(nearest->sample.twist, seconds);
}

template <typename Message>
std::optional<GridSlamOutput> GridSlamStage::takeScan(const Message& message) {
  try {
    const Stopwatch watch;
    const ScannerMount mount =
        scannerMount(transforms_.core(), options_.base_frame, message.header.frame_id);
    const ConvertedScan converted = toScan(message, mount, options_.scan);
    checkStamp(scan_stamps_, message.header.stamp);
    warnOf(mount, converted);
    if (options_.fused_grid) {
      keep(converted.scan);
      return std::nullopt;
    }
    return finish(slam_.process(converted.scan), watch);
  } catch (const InputError& error) {
    monitor_.dropped(error);
    return std::nullopt;
  }
}

template std::optional<GridSlamOutput> GridSlamStage::takeScan(const sensor_msgs::LaserScan&);
template std::optional<GridSlamOutput> GridSlamStage::takeScan(
    const sensor_msgs::MultiEchoLaserScan&);

void GridSlamStage::keep(const Scan& scan) {
  last_field_ = {scan.stamp, scan.scanner_in_base, scan.field, {}};
  scans_.push_back(scan);
  if (scans_.size() > kMostWaitingScans) {
    scans_.pop_front();
    monitor_.dropped(InputError("no_fused_grid", "more than " + std::to_string(kMostWaitingScans) +
                                                     " scans wait for their fused grid: expected "
                                                     "one from grid_fusion, dropped the oldest"));
  }
}

std::optional<GridSlamOutput> GridSlamStage::takeGrid(const nav_msgs::OccupancyGrid& message) {
  try {
    if (!options_.fused_grid) {
      throw InputError("unexpected_grid", "a fused grid: expected none while fused_grid is false");
    }
    const Stopwatch watch;
    checkBaseFrame(message.header.frame_id);
    const SensorGrid grid = fromMessage(message);
    checkStamp(grid_stamps_, message.header.stamp);
    return finish(slam_.process(grid, scanAt(grid.stamp())), watch);
  } catch (const InputError& error) {
    monitor_.dropped(error);
    return std::nullopt;
  }
}

Scan GridSlamStage::scanAt(Stamp stamp) {
  while (!scans_.empty() && scans_.front().stamp < stamp) {
    scans_.pop_front();
    monitor_.dropped(
        InputError("scan_without_grid", "a scan without fused grid: expected one of its stamp"));
  }
  if (!scans_.empty() && scans_.front().stamp == stamp) {
    Scan scan = std::move(scans_.front());
    scans_.pop_front();
    return scan;
  }
  monitor_.warned(InputError("no_scan_for_grid",
                             "no scan of the fused grid's stamp: goes on with the grid alone"));
  Scan scan = last_field_;
  scan.stamp = stamp;
  return scan;
}

GridSlamOutput GridSlamStage::finish(const SlamResult& result, const Stopwatch& watch) {
  showMatch(result);
  GridSlamOutput output = outputOf(result);
  monitor_.processed({result.split.stamp, watch.seconds()});
  return output;
}

void GridSlamStage::checkBaseFrame(const std::string& frame) const {
  if (frame != options_.base_frame) {
    throw InputError("wrong_frame",
                     "fused grid in '" + frame + "': expected '" + options_.base_frame + "'");
  }
}

void GridSlamStage::checkFrames(const nav_msgs::Odometry& message) const {
  if (message.header.frame_id != options_.odom_frame ||
      message.child_frame_id != options_.base_frame) {
    throw InputError("wrong_frame", "odometry of '" + message.child_frame_id + "' in '" +
                                        message.header.frame_id + "': expected '" +
                                        options_.base_frame + "' in '" + options_.odom_frame + "'");
  }
}

void GridSlamStage::checkStamp(StampCheck& stamps, const ros::Time& stamp) {
  if (stamps.check(stamp) == Arrival::kRestart) {
    restart();
    stamps.check(stamp);
  }
}

void GridSlamStage::restart() {
  monitor_.warned(InputError("clock_restart", "the clock jumped back: starts with a new map"));
  slam_.reset();
  scan_stamps_ = StampCheck(options_.input.restart_after);
  odometry_stamps_ = StampCheck(options_.input.restart_after);
  grid_stamps_ = StampCheck(options_.input.restart_after);
  scans_.clear();
  odometry_.clear();
  last_map_.reset();
  degenerate_scans_ = 0;
}

void GridSlamStage::warnOf(const ScannerMount& mount, const ConvertedScan& converted) {
  if (converted.unusable_times) {
    monitor_.warned(*converted.unusable_times);
  }
  if (mount.tilt > options_.most_tilt) {
    monitor_.warned(InputError("tilted_scanner",
                               "scan plane tilted by " + std::to_string(toDegrees(mount.tilt)) +
                                   " degrees: expected at most " +
                                   std::to_string(toDegrees(options_.most_tilt))));
  }
  const BeamCounts& beams = converted.beams;
  if (beams.hits == 0 && beams.no_return == 0) {
    monitor_.warned(InputError("no_valid_beam", "scan with " + std::to_string(beams.dropped) +
                                                    " beams, none of them valid: goes on with the "
                                                    "predicted pose"));
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

GridSlamOutput GridSlamStage::outputOf(const SlamResult& result) {
  const Stamp stamp = result.split.stamp;
  GridSlamOutput output;
  output.split_scan = boost::make_shared<SplitScanMessage>(
      toMessage(result.split, options_.base_frame, options_.map_frame));
  output.pose = boost::make_shared<geometry_msgs::PoseWithCovarianceStamped>();
  output.pose->header.stamp = toTime(stamp);
  output.pose->header.frame_id = options_.map_frame;
  output.pose->pose = output.split_scan->pose;
  output.transforms = transformsTo(result.split.base_in_map.pose, stamp);
  return output;
}

std::vector<geometry_msgs::TransformStamped> GridSlamStage::transformsTo(const Pose2& base_in_map,
                                                                         Stamp stamp) {
  const auto odom_in_map = [&](const Pose2& pose) {
    return toTransform(pose, stamp, options_.map_frame, options_.odom_frame);
  };
  if (!options_.odometry) {
    return {odom_in_map({}),
            toTransform(base_in_map, stamp, options_.odom_frame, options_.base_frame)};
  }
  const std::optional<Pose2> base_in_odom = baseInOdom(stamp);
  if (!base_in_odom) {
    monitor_.warned(InputError("silent_odometry",
                               "no odometry at the scan's stamp: goes on with constant velocity "
                               "and without " +
                                   options_.map_frame + " -> " + options_.odom_frame +
                                   " (a vehicle without odometry: set odometry to false)"));
    return {};
  }
  return {odom_in_map(base_in_map * base_in_odom->inverse())};
}

nav_msgs::OccupancyGridPtr GridSlamStage::mapIfDue(Stamp stamp) {
  if (last_map_ && secondsBetween(*last_map_, stamp) < options_.map_period) {
    return nullptr;
  }
  last_map_ = stamp;
  return boost::make_shared<nav_msgs::OccupancyGrid>(
      toMessage(slam_.map(), stamp, options_.map_frame));
}

}  // namespace datmo
