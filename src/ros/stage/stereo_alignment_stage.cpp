// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/stage/stereo_alignment_stage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "datmo_fusion/ros/convert/alignment_conversion.h"
#include "datmo_fusion/ros/stage/stage_inputs.h"
#include "datmo_fusion/slam/motion_compensation.h"

namespace datmo {

namespace {

/// Half a second of a fast scanner: longer than the latency of a cloud.
constexpr std::size_t kMaxScans = 25;

/// s, averaging period of the vehicle's twist.
constexpr double kTwistTime = 0.1;

struct TermName {
  AlignmentTerm term;
  const char* name;
  const char* unit;
  const char* cause;
};

constexpr std::array<TermName, kAlignmentTerms> kTerms = {{
    {AlignmentTerm::kDisparity, "disparities too large by", "px", "its calibration is off"},
    {AlignmentTerm::kSurface, "surfaces behind the scanner's by", "m",
     "scanner and camera do not see the same heights"},
    {AlignmentTerm::kForward, "mounted farther back by", "m", "tf has the wrong mount"},
    {AlignmentTerm::kHeading, "turned to the left by", "rad", "tf has the wrong mount"},
    {AlignmentTerm::kTime, "older than its stamps by", "s", "its clock or driver is off"},
}};

}  // namespace

void StereoAlignmentStageOptions::visit(OptionVisitor& visitor) {
  StereoInputOptions::visit(visitor);
  visitor.group("scan", [&] { scan.visit(visitor); });
  alignment.visit(visitor);
  visitor.group("pairs", [&] { pairs.visit(visitor); });
  visitor.number(
      {"max_interval", "s", "maximum time between a cloud and the scan that it is compared with"},
      max_interval, {0.0, 1.0});
}

SharedKeys StereoAlignmentStageOptions::sharedKeys() {
  return StereoInputOptions::cameraKeys()
      .group<ScanConversionOptions>("scan/", "scanner/")
      .key("pairs/range_sigma", "scanner/range_sigma");
}

StereoAlignmentStage::StereoAlignmentStage(const Checked<StereoAlignmentStageOptions>& options,
                                           const TransformBuffer& transforms, StageMonitor& monitor)
    : options_(*options),
      transforms_(transforms),
      monitor_(monitor),
      runner_(monitor, options->input, "forgets the last scans", [this] { reset(); }),
      motion_(options->motion, options->frames, runner_),
      input_(*options, transforms),
      finder_(options->pairs),
      filter_(options->alignment) {}

void StereoAlignmentStage::reset() {
  motion_.reset();
  scans_.clear();
  frozen_.reset();
  filter_.forgetTime();
}

void StereoAlignmentStage::handleOdometry(const nav_msgs::Odometry& message) {
  runner_.serve([&] { motion_.update(message); });
}

void StereoAlignmentStage::handlePose(const geometry_msgs::PoseWithCovarianceStamped& message) {
  runner_.serve([&] { motion_.update(message); });
}

template <typename Message>
void StereoAlignmentStage::handleScan(const Message& message) {
  runner_.serve("scan", message, [&] {
    const ScannerMount mount =
        scannerMount(transforms_.core(), options_.frames.base, message.header.frame_id);
    const ConvertedScan converted = toScan(message, mount, options_.scan);
    runner_.check("scan", message.header.stamp);
    scans_.push_back(converted.scan);
    if (scans_.size() > kMaxScans) {
      scans_.pop_front();
    }
  });
}

template void StereoAlignmentStage::handleScan(const sensor_msgs::LaserScan&);
template void StereoAlignmentStage::handleScan(const sensor_msgs::MultiEchoLaserScan&);

void StereoAlignmentStage::handleCameraInfo(const sensor_msgs::CameraInfo& message) {
  runner_.serve([&] { input_.update(message); });
}

StereoAlignmentMessagePtr StereoAlignmentStage::handleCloud(
    const sensor_msgs::PointCloud2& message) {
  return runner_.serve("points2", message, [&]() -> StereoAlignmentMessagePtr {
    if (!input_.isAligned()) {
      runner_.processed(toStamp(message.header.stamp));
      return nullptr;
    }
    CloudPoints points(message);
    const StereoCloud cloud = input_.cloudOf(message.header, points);
    runner_.check("points2", message.header.stamp);
    const auto motion = [this](Stamp from, Stamp to) { return motion_.between(from, to); };
    if (frozen_.update(cloud.stamp, message.data, motion)) {
      filter_.handleFrozen(cloud.stamp);
      monitor_.warned(InputError("frozen_camera",
                                 "the stereo camera repeats the cloud of its last image although "
                                 "the vehicle moves: its objects and grid are ignored"));
      runner_.processed(cloud.stamp);
      return toMessage(filter_.alignment(), options_.frames.base);
    }
    const std::optional<std::vector<Ray>> rays = raysAt(cloud.stamp);
    return rays ? compare(cloud, *rays) : nullptr;
  });
}

StereoAlignmentMessagePtr StereoAlignmentStage::compare(const StereoCloud& cloud,
                                                        const std::vector<Ray>& rays) {
  const Twist2 twist = twistAt(cloud.stamp);
  try {
    const std::vector<SurfacePair> pairs = finder_.find(cloud, rays, filter_.alignment(), twist);
    filter_.update(cloud.stamp, pairs, cloud.camera.noise.disparity_at_meter, twist);
  } catch (const std::invalid_argument& error) {
    throw InputError("bad_camera", error.what());
  }
  show();
  runner_.processed(cloud.stamp);
  return toMessage(filter_.alignment(), options_.frames.base);
}

std::optional<std::vector<Ray>> StereoAlignmentStage::raysAt(Stamp stamp) const {
  const auto distance = [stamp](const Scan& scan) {
    return std::abs(secondsBetween(scan.stamp, stamp));
  };
  const auto nearest =
      std::min_element(scans_.begin(), scans_.end(),
                       [&](const Scan& a, const Scan& b) { return distance(a) < distance(b); });
  if (nearest == scans_.end() || distance(*nearest) > options_.max_interval) {
    return std::nullopt;
  }
  Scan scan = compensated(*nearest);
  const bool earlier = scan.stamp <= stamp;
  const std::optional<Pose2> moved =
      earlier ? motion_.between(scan.stamp, stamp) : motion_.between(stamp, scan.stamp);
  if (!moved) {
    return std::nullopt;
  }
  const Pose2 scan_base = earlier ? moved->inverse() : *moved;
  for (Ray& ray : scan.rays) {
    ray.origin = scan_base * ray.origin;
    ray.end = scan_base * ray.end;
  }
  return std::move(scan.rays);
}

Scan StereoAlignmentStage::compensated(const Scan& scan) const {
  const double duration = sweepDuration(scan);
  if (duration == 0.0) {
    return scan;
  }
  const auto motion = motion_.between(scan.stamp, scan.stamp + duration);
  return motion ? compensateMotion(scan, twistOf(*motion, duration)) : scan;
}

Twist2 StereoAlignmentStage::twistAt(Stamp stamp) const {
  const auto motion = motion_.between(stamp + -kTwistTime, stamp);
  return motion ? twistOf(*motion, kTwistTime) : Twist2();
}

void StereoAlignmentStage::show() {
  const StereoAlignment& alignment = filter_.alignment();
  monitor_.figure("surfaces compared", static_cast<double>(alignment.surfaces));
  monitor_.figure("surfaces that do not agree", static_cast<double>(alignment.refused));
  monitor_.figure("share of the last surfaces that agreed", alignment.agreement);
  if (alignment.usable != std::exchange(was_usable_, alignment.usable) && !alignment.usable) {
    monitor_.warned(InputError(
        "camera_disagrees",
        "scanner and stereo camera disagree: " + std::to_string(alignment.agreement) +
            " of the surfaces agree (expected: at least " +
            std::to_string(options_.alignment.min_agreement) +
            "), or its mount or clock is wrong; its clouds are ignored until they agree"));
  }
  for (const TermName& each : kTerms) {
    const std::string what = std::string(each.name) + " [" + each.unit + "]";
    const double value = alignment[each.term];
    const double sigma = alignment.sigma(each.term);
    monitor_.figure(what, value);
    monitor_.figure(what + ", sigma", sigma);
    if (!filter_.isFault(each.term)) {
      faults_.erase(each.term);
    } else if (faults_.insert(each.term).second) {
      monitor_.warned(InputError("misaligned_camera",
                                 "stereo camera against the scanner: " + std::string(each.name) +
                                     " " + std::to_string(value) + " +- " + std::to_string(sigma) +
                                     " " + each.unit + ": expected less than " +
                                     std::to_string(filter_.maxNormal(each.term)) + "; " +
                                     each.cause + ", or the scanner's is"));
    }
  }
}

void StereoAlignmentStage::connect(StagePorts& ports) {
  connectMotion(ports, options_.motion, *this);
  const auto handle_scan = [this](const auto& scan, Stamp /*now*/) { handleScan(*scan); };
  connectScan(ports, monitor_, handle_scan);
  connectStereo(ports, *this, ports.out<StereoAlignmentMessage>("stereo/alignment"));
}

}  // namespace datmo
