#include "world.h"

#include <cmath>
#include <limits>

#include "datmo_fusion/ros/message_conversion.h"
#include "datmo_fusion/ros/stamp_check.h"

namespace datmo {

namespace {

constexpr double kSpeed = 5.0;          // m/s, along x, of both cars
constexpr double kDriftSpeed = 4.0;     // m/s
constexpr double kHalfWidth = 12.0;     // m, of the street
constexpr double kPillarSpacing = 6.0;  // m
constexpr double kScannerAhead = 3.6;   // m
constexpr int kBeams = 161;
constexpr float kMostRange = 60.0F;  // m

Stamp stampAt(double seconds) { return Stamp::fromSeconds(World::kStart + seconds); }

/// How far along the ray the side from `a` to `b` is; infinite if it is not hit.
double rangeTo(const Point2& a, const Point2& b, const Pose2& ray) {
  const Point2 from = ray.inverse() * a;
  const Point2 to = ray.inverse() * b;
  if ((from.y() < 0.0) == (to.y() < 0.0)) {
    return std::numeric_limits<double>::infinity();
  }
  const double x = from.x() + (to.x() - from.x()) * from.y() / (from.y() - to.y());
  return x > 0.0 ? x : std::numeric_limits<double>::infinity();
}

std::vector<Box2> standingThings() {
  std::vector<Box2> boxes;
  for (const double side : {-1.0, 1.0}) {
    boxes.push_back({{50.0, side * (kHalfWidth + 1.0), 0.0}, 300.0, 2.0});
    for (double x = -60.0; x < 160.0; x += kPillarSpacing) {
      boxes.push_back({{x + side, side * (kHalfWidth - 0.5), 0.0}, 1.0, 1.0});
    }
  }
  return boxes;
}

}  // namespace

Pose2 World::baseInMap(double seconds) const { return {kSpeed * seconds, 0.0, 0.0}; }

Box2 World::otherCar(double seconds) const {
  const double y = kHalfWidth - 4.0 - kDriftSpeed * seconds;
  return {{15.0 + kSpeed * seconds, y, std::atan2(-kDriftSpeed, kSpeed)}, 4.0, 1.8};
}

sensor_msgs::LaserScan World::scan(double seconds) const {
  std::vector<Box2> boxes = standingThings();
  boxes.push_back(otherCar(seconds));
  sensor_msgs::LaserScan message;
  message.header.stamp = toTime(stampAt(seconds));
  message.header.frame_id = "scanner";
  message.angle_min = static_cast<float>(degrees(-80.0));
  message.angle_max = static_cast<float>(degrees(80.0));
  message.angle_increment = static_cast<float>(degrees(1.0));
  message.range_min = 0.5F;
  message.range_max = kMostRange;
  const Pose2 scanner = baseInMap(seconds) * Pose2(kScannerAhead, 0.0, 0.0);
  for (int beam = 0; beam < kBeams; ++beam) {
    const auto range = static_cast<float>(rangeAlong(scanner, degrees(beam - 80.0), boxes));
    message.ranges.push_back(range < kMostRange ? range : std::numeric_limits<float>::infinity());
  }
  return message;
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
  return toTransform({kScannerAhead, 0.0, 0.0}, stampAt(0.0), "base_link", "scanner");
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
