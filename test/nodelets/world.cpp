// SPDX-License-Identifier: BSD-3-Clause
#include "world.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/convert/point_field.h"
#include "datmo_fusion/ros/stage/stamp_check.h"

namespace datmo {

namespace {

constexpr double kSpeed = 5.0;          // m/s, along x, of both cars
constexpr double kDriftSpeed = 4.0;     // m/s
constexpr double kHalfWidth = 12.0;     // m, of the street
constexpr double kPillarSpacing = 6.0;  // m
constexpr double kScannerAhead = 3.6;   // m
constexpr Sweep kSweep{-80.0, 1.0, 161, 0.0};
constexpr float kMaxRange = 60.0F;  // m

constexpr double kHeightOfThings = 2.0;  // m
constexpr double kScannerHeight = 0.5;   // m

// The camera.
constexpr double kCameraAhead = 1.8;    // m
constexpr double kCameraHeight = 1.2;   // m
constexpr double kFocalLength = 400.0;  // px
constexpr double kBaseline = 0.3;       // m
constexpr int kColumns = 512;
constexpr int kRows = 384;

/// Returns the distance along the ray to the segment from `a` to `b`; infinite if it is not hit.
double rangeTo(const Point2& a, const Point2& b, const Pose2& ray) {
  const Point2 from = ray.inverse() * a;
  const Point2 to = ray.inverse() * b;
  if ((from.y() < 0.0) == (to.y() < 0.0)) {
    return std::numeric_limits<double>::infinity();
  }
  const double x = from.x() + (to.x() - from.x()) * from.y() / (from.y() - to.y());
  return x > 0.0 ? x : std::numeric_limits<double>::infinity();
}

/// Three numbers per point.
sensor_msgs::PointCloud2 cloudOf(const std::vector<float>& numbers, Stamp stamp) {
  sensor_msgs::PointCloud2 message;
  message.header.stamp = toTime(stamp);
  message.header.frame_id = "camera";
  message.fields = floatFields({"x", "y", "z"});
  message.point_step = 12;
  message.height = 1;
  message.width = static_cast<std::uint32_t>(numbers.size() / 3);
  message.row_step = message.width * message.point_step;
  message.data.resize(message.row_step);
  std::memcpy(message.data.data(), numbers.data(), message.data.size());
  return message;
}

/// A wall on each side around `middle` (m, along x), and pillars from one x to another.
std::vector<Box2> standingThings(double middle, double from, double to) {
  std::vector<Box2> boxes;
  for (const double side : {-1.0, 1.0}) {
    boxes.push_back({{middle, side * (kHalfWidth + 1.0), 0.0}, 300.0, 2.0});
    for (double x = from; x < to; x += kPillarSpacing) {
      boxes.push_back({{x + side, side * (kHalfWidth - 0.5), 0.0}, 1.0, 1.0});
    }
  }
  return boxes;
}

}  // namespace

Pose2 World::baseInMap(double seconds) const { return {kSpeed * seconds, 0.0, 0.0}; }

Box2 World::otherCar(double seconds) const {
  constexpr double kLeftmost = kHalfWidth - 4.0;  // m
  const double phase = kDriftSpeed / kLeftmost * seconds;
  const bool is_endless = length_ == Length::kEndless;
  const double y = is_endless ? kLeftmost * std::cos(phase) : kLeftmost - kDriftSpeed * seconds;
  const double drift = is_endless ? -kDriftSpeed * std::sin(phase) : -kDriftSpeed;
  return {{15.0 + kSpeed * seconds, y, std::atan2(drift, kSpeed)}, 4.0, 1.8};
}

std::vector<Box2> World::thingsAt(double seconds) const {
  const double x = kPillarSpacing * std::floor(kSpeed * seconds / kPillarSpacing);
  constexpr double kAround = 11.0 * kPillarSpacing;  // more than is visible
  std::vector<Box2> boxes = length_ == Length::kEndless
                                ? standingThings(x, x - kAround, x + kAround + kPillarSpacing)
                                : standingThings(50.0, -60.0, 160.0);
  boxes.push_back(otherCar(seconds));  // the only one that moves
  return boxes;
}

sensor_msgs::LaserScan World::scan(double seconds) const {
  sensor_msgs::LaserScan message;
  message.header.stamp = toTime(stampAt(seconds));
  message.header.frame_id = "scanner";
  message.angle_min = static_cast<float>(degrees(kSweep.first_bearing));
  message.angle_max = static_cast<float>(degrees(-kSweep.first_bearing));
  message.angle_increment = static_cast<float>(degrees(kSweep.beam_spacing));
  message.range_min = 0.5F;
  message.range_max = kMaxRange;
  message.ranges = ranges(seconds, kSweep);
  return message;
}

std::vector<float> World::ranges(double seconds, const Sweep& sweep) const {
  std::vector<Box2> boxes = thingsAt(seconds);
  std::vector<float> found;
  for (int beam = 0; beam < sweep.beams; ++beam) {
    const double now = seconds + sweep.beam_time * beam;
    const double bearing = degrees(sweep.first_bearing + sweep.beam_spacing * beam);
    const Pose2 scanner = baseInMap(now) * Pose2(kScannerAhead, 0.0, 0.0);
    boxes.back() = otherCar(now);
    const auto range = static_cast<float>(rangeAlong(scanner, bearing, boxes));
    found.push_back(range < kMaxRange ? range : std::numeric_limits<float>::infinity());
  }
  return found;
}

nav_msgs::Odometry World::odometry(double seconds) const {
  nav_msgs::Odometry message;
  message.header.stamp = toTime(stampAt(seconds));
  message.header.frame_id = "odom";
  message.child_frame_id = "base_link";
  message.pose.pose = toMessage(baseInMap(seconds));
  message.twist.twist.linear.x = kSpeed;
  return message;
}

geometry_msgs::TransformStamped World::baseInOdom(double seconds) const {
  return toTransform(baseInMap(seconds), stampAt(seconds), "odom", "base_link");
}

geometry_msgs::TransformStamped World::scannerInBase() const {
  auto mount = toTransform({kScannerAhead, 0.0, 0.0}, stampAt(0.0), "base_link", "scanner");
  mount.transform.translation.z = kScannerHeight;
  return mount;
}

geometry_msgs::TransformStamped World::cameraInBase() const {
  auto mount = toTransform({kCameraAhead, 0.0, 0.0}, stampAt(0.0), "base_link", "camera");
  mount.transform.translation.z = kCameraHeight;
  mount.transform.rotation.x = -0.5;  // x to the right, y down, z ahead
  mount.transform.rotation.y = 0.5;
  mount.transform.rotation.z = -0.5;
  mount.transform.rotation.w = 0.5;
  return mount;
}

sensor_msgs::CameraInfo World::rightCameraInfo() {
  sensor_msgs::CameraInfo info;
  info.header.frame_id = "camera";
  info.width = kColumns;
  info.height = kRows;
  info.P = {kFocalLength,
            0.0,
            0.5 * (kColumns - 1),
            -kFocalLength * kBaseline,
            0.0,
            kFocalLength,
            0.5 * (kRows - 1),
            0.0,
            0.0,
            0.0,
            1.0,
            0.0};
  return info;
}

sensor_msgs::PointCloud2 World::cloud(double seconds, int pixel_step) const {
  const std::vector<Box2> boxes = thingsAt(seconds);
  const Pose2 camera = baseInMap(seconds) * Pose2(kCameraAhead, 0.0, 0.0);
  std::vector<float> numbers;
  for (int column = 0; column < kColumns; column += pixel_step) {
    const double right = (column - 0.5 * (kColumns - 1)) / kFocalLength;
    const double bearing = -std::atan(right);
    const double thing = rangeAlong(camera, bearing, boxes) * std::cos(bearing);
    for (int row = 0; row < kRows; row += pixel_step) {
      const double down = (row - 0.5 * (kRows - 1)) / kFocalLength;
      const double road = down > 0.0 ? kCameraHeight / down : 1e9;
      const double depth = std::min(road, thing);
      if (depth < kMaxRange && kCameraHeight - down * depth < kHeightOfThings) {
        for (const double number : {right * depth, down * depth, depth}) {
          numbers.push_back(static_cast<float>(number));
        }
      }
    }
  }
  return cloudOf(numbers, stampAt(seconds));
}

double World::rangeAlong(const Pose2& scanner, double bearing,
                         const std::vector<Box2>& boxes) const {
  const Pose2 ray = scanner * Pose2(0.0, 0.0, bearing);
  double nearest = std::numeric_limits<double>::infinity();
  for (const Box2& box : boxes) {
    const auto corners = box.corners();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      nearest = std::min(nearest, rangeTo(corners.at(i), corners.at((i + 1) % 4), ray));
    }
  }
  return nearest;
}

}  // namespace datmo
