// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/grid_slam_stage.h"

#include <boost/make_shared.hpp>
#include <tf2_msgs/TFMessage.h>

#include "datmo_fusion/common/option_texts.h"
#include "datmo_fusion/ros/convert/grid_conversion.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/stage/stage_inputs.h"
#include "datmo_fusion/ros/transform_topics.h"

namespace datmo {

namespace {

/// The hold of the odometry is set once, for all stages.
GridSlamOptions slamOptions(const GridSlamStageOptions& options) {
  GridSlamOptions slam = options.slam;
  slam.odometry_hold = options.motion.hold;
  return slam;
}

/// The options that must be the same to continue from a checkpoint: all except where it is.
std::map<std::string, std::string> continuedOptions(GridSlamStageOptions options) {
  options.checkpoint = {};
  std::map<std::string, std::string> texts = optionTexts(options);
  for (const auto& [section, shared] : {std::make_pair("frames/", optionTexts(options.frames)),
                                        std::make_pair("motion/", optionTexts(options.motion))}) {
    for (const auto& [key, text] : shared) {
      texts[section + key] = text;
    }
  }
  return texts;
}

std::size_t cellsOf(const GridWindowOptions& options) {
  const GridWindow window = options.window();
  return rowMajorSize(window.columns, window.rows);
}

}  // namespace

void GridSlamStageOptions::visit(OptionVisitor& visitor) {
  visitor.toggle({"fused_grid", "",
                  "the measurement is the grid that grid_fusion made of the scan and other sensors "
                  "(thesis 3.2.5); false: the scan alone"},
                 fused_grid);
  visitor.number(
      {"map_period", "s", "minimum time between two maps, by the scans' stamps", Tier::kPublic},
      map_period, {0.0, 3600.0});
  visitor.number({"max_tilt", "rad", "a scan plane tilted by more than this causes a warning"},
                 max_tilt, {0.0, kPi / 2.0});
  visitor.number({"odometry_wait", "s",
                  "longest time that a scan waits for the last odometry before it when they arrive "
                  "over a network (perception.launch); 0: it does not wait"},
                 odometry_wait, {0.0, 1.0});
  visitor.group("input", [&] { input.visit(visitor); });
  visitor.group("scan", [&] { scan.visit(visitor); });
  visitor.group("prior_map", [&] { prior_map.visit(visitor); });
  visitor.group("checkpoint", [&] { checkpoint.visit(visitor); });
  slam.visit(visitor);
}

void GridSlamStageOptions::check() const {
  checkOptions(motion);
  checkFrames(frames);
}

SharedKeys GridSlamStageOptions::sharedKeys() {
  return SharedKeys()
      .group<ScanConversionOptions>("scan/", "scanner/")
      .key("max_tilt", "scanner/max_tilt")
      .group<BeamEndOptions>("map/", "scanner/")
      .key("matcher/point_sigma", "scanner/range_sigma")
      .group<OdometryNoiseOptions>("motion/", "motion/");
}

GridSlamStage::GridSlamStage(const Checked<GridSlamStageOptions>& options,
                             const TransformBuffer& transforms, StageMonitor& monitor,
                             const StepClock& clock)
    : options_(*options),
      transforms_(transforms),
      monitor_(monitor),
      slam_(slamOptions(*options)),
      extent_(options->slam.map.window),
      runner_(monitor, options->input, "starts with a new map", [this] { reset(); }),
      odometry_(options->motion, options->frames, "odometry", runner_),
      odometry_poses_(options->motion.hold),
      odometry_wait_(slam_.odometry(), options->odometry_wait, options->motion.hold),
      scans_(monitor) {
  readPriorMap();
  if (clock != nullptr && !options_.checkpoint.file.empty()) {
    checkpoints_ =
        std::make_unique<CheckpointKeeper>(options_.checkpoint, continuedOptions(options_),
                                           cellsOf(options_.slam.map.window), monitor_);
  }
}

GridSlamStage::~GridSlamStage() {
  if (checkpoints_) {
    checkpoints_->finish(slam_);
  }
}

std::optional<Stamp> GridSlamStage::handleOdometry(const nav_msgs::Odometry& message) {
  if (!options_.motion.fromOdometry() && !options_.motion.fromSensors()) {
    return std::nullopt;
  }
  return runner_.serve("odometry", message, [&]() -> std::optional<Stamp> {
    OdometrySample sample = odometry_.read(message);
    const Pose2 base_in_odom = fromMessage(message.pose.pose);
    sample.speed_measured = options_.motion.hasSpeed();
    slam_.addOdometry(sample);
    odometry_poses_.add(sample.stamp, sample.twist, base_in_odom);
    return sample.stamp;
  });
}

template <typename Message>
std::optional<GridSlamOutput> GridSlamStage::handleScan(const Message& message) {
  return runner_.serve("scan", message, [&]() -> std::optional<GridSlamOutput> {
    const ScannerMount mount =
        scannerMount(transforms_.core(), options_.frames.base, message.header.frame_id);
    const ConvertedScan converted = toScan(message, mount, options_.scan);
    runner_.check("scan", message.header.stamp);
    const auto motion = [this](Stamp from, Stamp to) { return motionBetween(from, to); };
    checkNotFrozen(frozen_.update(converted.scan.stamp, measuredBytes(message), motion), monitor_);
    warnOf(mount, converted);
    if (options_.fused_grid) {
      scans_.add(converted.scan);
      return std::nullopt;
    }
    continueAt(converted.scan.stamp);
    return finish(slam_.process(converted.scan));
  });
}

template std::optional<GridSlamOutput> GridSlamStage::handleScan(const sensor_msgs::LaserScan&);
template std::optional<GridSlamOutput> GridSlamStage::handleScan(
    const sensor_msgs::MultiEchoLaserScan&);

std::optional<GridSlamOutput> GridSlamStage::handleGrid(const nav_msgs::OccupancyGrid& message) {
  return runner_.serve([&]() -> std::optional<GridSlamOutput> {
    if (!options_.fused_grid) {
      throw InputError("unexpected_grid", "a fused grid: expected none while fused_grid is false");
    }
    checkBaseFrame(message.header.frame_id);
    const SensorGrid grid = fromMessage(message);
    runner_.check("grid", message.header.stamp);
    continueAt(grid.stamp());
    return finish(slam_.process(grid, scans_.take(grid.stamp())));
  });
}

GridSlamOutput GridSlamStage::finish(const SlamResult& result) {
  showMatch(result);
  GridSlamOutput output = outputOf(result);
  showLocalization(*output.localization);
  runner_.processed(result.labeled_scan.stamp);
  return output;
}

void GridSlamStage::checkBaseFrame(const std::string& frame) const {
  if (frame != options_.frames.base) {
    throw InputError("wrong_frame",
                     "fused grid in '" + frame + "': expected '" + options_.frames.base + "'");
  }
}

void GridSlamStage::reset() {
  slam_.reset();
  odometry_wait_.clear();
  scans_.clear();
  odometry_.reset();
  odometry_poses_.clear();
  frozen_.reset();
  held_.clear();
  last_map_.reset();
  degenerate_scans_ = 0;
  maps_started_ = 0;
  forgotten_tiles_ = 0;
  if (checkpoints_) {
    checkpoints_->reset();
  }
}

std::optional<Pose2> GridSlamStage::motionBetween(Stamp from, Stamp to) const {
  const std::optional<Pose2> before = odometry_poses_.at(from);
  const std::optional<Pose2> after = odometry_poses_.at(to);
  return before && after ? std::make_optional(before->inverse() * *after) : std::nullopt;
}

GridSlamOutput GridSlamStage::outputOf(const SlamResult& result) {
  const Stamp stamp = result.labeled_scan.stamp;
  GridSlamOutput output;
  output.labeled_scan = boost::make_shared<LabeledScanMessage>(
      toMessage(result.labeled_scan, options_.frames.base, options_.frames.map));
  output.local_pose = boost::make_shared<geometry_msgs::PoseWithCovarianceStamped>();
  output.local_pose->header.stamp = toTime(stamp);
  output.local_pose->header.frame_id = options_.frames.map;
  output.local_pose->pose = output.labeled_scan->pose;
  PoseWithCovariance since_start = result.labeled_scan.base_in_map;
  since_start.covariance += result.drift;
  output.pose = boost::make_shared<geometry_msgs::PoseWithCovarianceStamped>(*output.local_pose);
  output.pose->pose = toMessage(since_start);
  output.localization = localizationOf(result);
  output.transforms = transformsTo(result.labeled_scan.base_in_map.pose, stamp);
  for (const geometry_msgs::TransformStamped& transform : output.transforms) {
    monitor_.announce(transform.child_frame_id, transform.header.frame_id + " -> " +
                                                    transform.child_frame_id + " is published");
  }
  return output;
}

std::vector<geometry_msgs::TransformStamped> GridSlamStage::transformsTo(const Pose2& base_in_map,
                                                                         Stamp stamp) {
  const auto odom_in_map = [&](const Pose2& pose) {
    return toTransform(pose, stamp, options_.frames.map, options_.frames.odom);
  };
  if (!options_.motion.fromOdometry()) {
    return {odom_in_map({}),
            toTransform(base_in_map, stamp, options_.frames.odom, options_.frames.base)};
  }
  const std::optional<Pose2> base_in_odom = odometry_poses_.at(stamp);
  if (!base_in_odom) {
    held_.drop();
    monitor_.warned(InputError(
        "silent_odometry",
        "no odometry at the scan's stamp: continues with constant velocity and without " +
            options_.frames.map + " -> " + options_.frames.odom +
            " (without odometry, set motion: {source: none} in the yaml file)"));
    return {};
  }
  const geometry_msgs::TransformStamped transform =
      odom_in_map(base_in_map * base_in_odom->inverse());
  held_.set(transform);
  return {transform};
}

void GridSlamStage::connect(StagePorts& ports) {
  const auto transforms = ports.out<tf2_msgs::TFMessage>(kTransformTopic);
  const auto pose = ports.out<geometry_msgs::PoseWithCovarianceStamped>("pose");
  const auto local_pose = ports.out<geometry_msgs::PoseWithCovarianceStamped>("pose/local");
  const auto localization = ports.out<LocalizationState>("localization");
  const auto labeled_scan = ports.out<LabeledScanMessage>("labeled_scan");
  const auto map = ports.out<nav_msgs::OccupancyGrid>("map", true);
  ports.service<datmo_fusion::SaveMap>("save_map",
                                       [this](const auto& request) { return answer(request); });
  const auto publish = [=](const std::optional<GridSlamOutput>& output, Stamp now) {
    if (!output) {
      return;
    }
    held_.served(now);
    const auto message = boost::make_shared<tf2_msgs::TFMessage>();
    message->transforms = output->transforms;
    transforms.publish(message);
    pose.publish(output->pose);
    local_pose.publish(output->local_pose);
    localization.publish(output->localization);
    labeled_scan.publish(output->labeled_scan);
    map.publish(mapIfDue(toStamp(output->labeled_scan->header.stamp)));
    keepCheckpoint();
  };
  if (options_.motion.fromOdometry() || options_.motion.fromSensors()) {
    const auto handle_odometry = [this, transforms](const auto& odometry, Stamp now) {
      if (const auto stamp = handleOdometry(*odometry)) {
        transforms.publish(heldAt(*stamp, now));
      }
    };
    ports.in<nav_msgs::Odometry>(
        options_.motion.odometryTopic(),
        withClockCheck<nav_msgs::Odometry>(ports, "odometry", monitor_, handle_odometry));
  }
  const auto handle_scan = [this, publish](const auto& scan, Stamp now) {
    odometry_wait_.add(toStamp(scan->header.stamp), now,
                       [this, publish, scan, now] { publish(handleScan(*scan), now); });
    publishNext(now);
  };
  connectScan(ports, monitor_, handle_scan);
  if (options_.fused_grid) {
    ports.in<nav_msgs::OccupancyGrid>("grids/fused", [this, publish](const auto& grid, Stamp now) {
      publish(handleGrid(*grid), now);
    });
  }
}

}  // namespace datmo
