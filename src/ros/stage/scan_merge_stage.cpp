// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/scan_merge_stage.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <boost/make_shared.hpp>
#include <tf2_msgs/TFMessage.h>

#include "datmo_fusion/fusion/sync/relative_motion.h"
#include "datmo_fusion/ros/frames.h"
#include "datmo_fusion/ros/stage/stage_inputs.h"
#include "datmo_fusion/ros/transform_topics.h"
#include "datmo_fusion/slam/motion_compensation.h"

namespace datmo {

namespace {

constexpr char kOneScan[] = "scan";

}  // namespace

void MergedScannerOptions::visit(OptionVisitor& visitor) {
  visitor.toggle({"use", "", "the vehicle has this scanner"}, use);
  visitor.numbers({"blind_sectors", "rad",
                   "sectors of the scanner in which the vehicle itself is in view: pairs of the "
                   "bearings where a sector begins and ends, counterclockwise"},
                  blind_sectors, {-kTurn, kTurn});
}

std::vector<std::string> ScanMergeStageOptions::sourcesInUse() const {
  std::vector<std::string> names;
  for (const auto& [name, source] : sources) {
    if (source.use) {
      names.push_back(name);
    }
  }
  return names;
}

void ScanMergeStageOptions::visit(OptionVisitor& visitor) {
  visitor.number({"max_tilt", "rad", "a scan plane tilted by more than this causes a warning"},
                 max_tilt, {0.0, kQuarterTurn});
  visitor.text({"scan_frame", "",
                "frame of the merged scan; the stage publishes frames/base -> scan_frame: no other "
                "node may publish it"},
               scan_frame, {});
  visitor.group("input", [&] { input.visit(visitor); });
  visitor.group(
      "matching", [&] { matcher.visit(visitor); }, Tier::kExpert);
  visitor.group("scan", [&] { scan.visit(visitor); });
  merger.visit(visitor);
  visitor.each({"sources", "", "the scanners, whose scans are on scans/NAME"}, sources);
}

void ScanMergeStageOptions::check() const {
  for (const auto& [name, source] : sources) {
    if (source.blind_sectors.size() % 2 != 0) {
      throw OptionError("sources/" + name + "/blind_sectors has " +
                        std::to_string(source.blind_sectors.size()) +
                        " numbers: expected pairs of the bearings where a sector begins and ends");
    }
  }
}

SharedKeys ScanMergeStageOptions::sharedKeys() {
  return SharedKeys()
      .group<ScanConversionOptions>("scan/", "scanner/")
      .key("max_tilt", "scanner/max_tilt");
}

ScanMergeStage::ScanMergeStage(const Checked<ScanMergeStageOptions>& options,
                               const TransformBuffer& transforms, StageMonitor& monitor)
    : options_(*options),
      transforms_(transforms),
      monitor_(monitor),
      runner_(monitor, options->input, std::string("forgets all ") + kOneScan + "s",
              [this] { reset(); }),
      inputs_({options->frames.base, options->frames, options->motion, options->input,
               options->matcher, options->sourcesInUse(), kOneScan},
              runner_),
      matcher_(options->matcher, options->sourcesInUse(), Serving::kOnce),
      merger_(options->merger) {
  checkSourceNames(options->sourcesInUse(), kOneScan, {});
  if (options->scan_frame.empty() || options->scan_frame == options->frames.base) {
    throw OptionError("scan_frame = '" + options->scan_frame +
                      "': expected a name other than that of the vehicle's frame, '" +
                      options->frames.base + "'");
  }
  options_.scan_frame = options->frames.prefix + options->scan_frame;
}

void ScanMergeStage::reset() {
  inputs_.reset();
  matcher_.reset();
  frozen_.clear();
}

void ScanMergeStage::handleScan(const std::string& source, const sensor_msgs::LaserScan& message,
                                Stamp now) {
  runner_.serve("scans/" + source, message, [&] {
    const ScannerMount mount =
        scannerMount(transforms_.core(), options_.frames.base, message.header.frame_id);
    ConvertedScan converted = toScan(message, mount, options_.scan);
    std_msgs::Header header = message.header;
    header.frame_id = options_.frames.base;
    inputs_.check(source, header, now);
    checkFrozen(source, message);
    for (const InputError& fault :
         faultsOf(mount, converted, options_.max_tilt, source + " contributes nothing")) {
      monitor_.warned(fault);
    }
    if (source == options_.matcher.reference) {
      height_ = sensorMount(transforms_.core(), options_.frames.base, message.header.frame_id)
                    .translation()
                    .z();
    }
    const auto& sectors = options_.sources.at(source).blind_sectors;
    const Stamp stamp = converted.scan.stamp;
    matcher_.add(source, stamp,
                 std::make_shared<Scan>(withoutSectors(std::move(converted.scan), sectors)));
  });
}

void ScanMergeStage::checkFrozen(const std::string& source, const sensor_msgs::LaserScan& message) {
  const auto motion = [this](Stamp from, Stamp to) { return inputs_.motion(from, to); };
  if (frozen_[source].update(toStamp(message.header.stamp), measuredBytes(message), motion)) {
    throw InputError("frozen_scan", "scans of " + source +
                                        " that stay the same bit for bit while the vehicle moves: "
                                        "expected new ones; continues without them");
  }
}

Scan ScanMergeStage::compensated(const Scan& scan) const {
  const double duration = sweepDuration(scan);
  const auto motion =
      duration > 0.0 ? inputs_.motion(scan.stamp, scan.stamp + duration) : std::nullopt;
  return motion ? compensateMotion(scan, twistOf(*motion, duration)) : scan;
}

std::vector<Scan> ScanMergeStage::movedScans(const Matched& matched,
                                             std::vector<MissingSource>& missing) const {
  const auto motion = [this](Stamp from, Stamp to) { return inputs_.motion(from, to); };
  std::vector<Scan> scans;
  for (const SourceSample<Scan>& one : matched.samples) {
    if (const auto base = baseAt(one.stamp, matched.stamp(), motion)) {
      scans.push_back(scanAt(compensated(*one.payload), matched.stamp(), *base));
    } else {
      missing.push_back({one.source, WhyMissing::kNoMotion});
    }
  }
  return scans;
}

sensor_msgs::LaserScanPtr ScanMergeStage::next(Stamp now) {
  return runner_.serve([&] {
    const std::optional<Matched> matched = inputs_.nextOf(matcher_, now);
    return matched ? merge(*matched) : nullptr;
  });
}

sensor_msgs::LaserScanPtr ScanMergeStage::merge(const Matched& matched) {
  std::vector<MissingSource> missing = matched.missing;
  const std::vector<Scan> scans = movedScans(matched, missing);
  inputs_.report(matched.stamp(), missing);
  auto message = boost::make_shared<sensor_msgs::LaserScan>();
  message->header.stamp = toTime(matched.stamp());
  message->header.frame_id = options_.scan_frame;
  message->ranges = merger_.ranges(scans);
  message->angle_min = static_cast<float>(-kPi);
  message->angle_increment = static_cast<float>(merger_.beamSpacing());
  message->angle_max = static_cast<float>(kPi - merger_.beamSpacing());
  message->range_max = static_cast<float>(options_.merger.max_range);
  monitor_.figure("scans merged", static_cast<double>(scans.size()));
  monitor_.figure("beams not measured", static_cast<double>(std::count_if(
                                            message->ranges.begin(), message->ranges.end(),
                                            [](float range) { return std::isnan(range); })));
  inputs_.reportUnserved(matcher_);
  runner_.processed(matched.stamp());
  return message;
}

std::optional<geometry_msgs::TransformStamped> ScanMergeStage::takeMount() {
  if (published_height_ == height_) {
    return std::nullopt;
  }
  published_height_ = height_;
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = options_.frames.base;
  transform.child_frame_id = options_.scan_frame;
  transform.transform.translation.z = height_;
  transform.transform.rotation.w = 1.0;
  return transform;
}

void ScanMergeStage::connect(StagePorts& ports) {
  mounts_ = ports.out<tf2_msgs::TFMessage>(kStaticTransformTopic, true);
  scans_ = ports.out<sensor_msgs::LaserScan>("scan");
  connectMotion(ports, options_.motion, *this);
  for (const std::string& source : options_.sourcesInUse()) {
    const std::string topic = "scans/" + source;
    const auto take = [this, source](const auto& scan, Stamp now) {
      handleScan(source, *scan, now);
    };
    ports.in<sensor_msgs::LaserScan>(
        topic, withClockCheck<sensor_msgs::LaserScan>(ports, topic, monitor_, take));
  }
}

bool ScanMergeStage::publishNext(Stamp now) {
  const sensor_msgs::LaserScanPtr scan = next(now);
  if (!scan) {
    return false;
  }
  if (auto transform = takeMount()) {
    transform->header.stamp = scan->header.stamp;
    const auto mount = boost::make_shared<tf2_msgs::TFMessage>();
    mount->transforms = {*transform};
    mounts_.publish(mount);
  }
  scans_.publish(scan);
  return true;
}

}  // namespace datmo
