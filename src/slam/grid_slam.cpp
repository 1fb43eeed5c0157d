#include "datmo_fusion/slam/grid_slam.h"

#include <vector>

namespace datmo_fusion {

namespace {

/// Odometry this old (s) serves no scan any more.
constexpr double kOdometryMemory = 10.0;

std::vector<Point2> endPoints(const Scan& scan) {
  std::vector<Point2> points;
  points.reserve(scan.rays.size());
  for (const Ray& ray : scan.rays) {
    if (ray.hit) {
      points.push_back(ray.end);
    }
  }
  return points;
}

/// State of each ray, in order; kUnknown for beams without a hit.
std::vector<PointState> judge(const Scan& scan, const OccupancyMap& map, const Pose2& base_in_map) {
  std::vector<PointState> states;
  states.reserve(scan.rays.size());
  for (const Ray& ray : scan.rays) {
    states.push_back(ray.hit ? map.judge(base_in_map * ray.end) : PointState::kUnknown);
  }
  return states;
}

SplitScan split(const Scan& scan, const std::vector<PointState>& states,
                const PoseWithCovariance& base_in_map) {
  SplitScan result{scan.stamp, base_in_map, scan.scanner_in_base, {}};
  for (std::size_t i = 0; i < scan.rays.size(); ++i) {
    const Ray& ray = scan.rays[i];
    if (ray.hit) {
      result.points.push_back({ray.end, ray.range, ray.bearing, ray.beam, states[i]});
    }
  }
  return result;
}

}  // namespace

void GridSlamOptions::visit(OptionVisitor& visitor) {
  visitor.group("map", [&] { map.visit(visitor); });
  visitor.group("motion", [&] { motion.visit(visitor); });
  visitor.group("matcher", [&] { matcher.visit(visitor); });
  visitor.number(
      {"odometry_hold", "s",
       "how long the last odometry serves when no newer one comes; after that the pose is "
       "predicted with the last estimated velocity"},
      odometry_hold, {0.0, 10.0});
  visitor.integer({"seed", "1", "of the random numbers with which poses are drawn"}, seed,
                  {0, 2147483647});
}

GridSlam::GridSlam(const GridSlamOptions& options)
    : options_(options),
      motion_model_(options.motion),
      matcher_(options.matcher),
      map_(options.map),
      odometry_(options.odometry_hold, kOdometryMemory),
      random_(static_cast<std::uint64_t>(options.seed)) {
  checkOptions(options);
}

PoseWithCovariance GridSlam::predict(Stamp stamp, bool& odometry_used) const {
  if (!stamp_) {
    return base_in_map_;
  }
  const double seconds = secondsBetween(*stamp_, stamp);
  const auto measured = odometry_.motion(*stamp_, stamp);
  odometry_used = measured.has_value();
  const Pose2 motion = measured ? *measured : arc(velocity_, seconds);
  const Pose2 pose = base_in_map_.pose * motion;
  // The heading's error turns the motion; the motion's own noise comes on top.
  Eigen::Matrix3d transport = Eigen::Matrix3d::Identity();
  transport(0, 2) = base_in_map_.pose.y() - pose.y();
  transport(1, 2) = pose.x() - base_in_map_.pose.x();
  Eigen::Matrix3d to_map = Eigen::Matrix3d::Identity();
  to_map.topLeftCorner<2, 2>() = pose.rotation();
  const Eigen::Matrix3d noise = motion_model_.covariance(twistOf(motion, seconds), seconds);
  return {pose, transport * base_in_map_.covariance * transport.transpose() +
                    to_map * noise * to_map.transpose()};
}

SlamResult GridSlam::process(const Scan& scan) {
  SlamResult result;
  PoseWithCovariance pose = predict(scan.stamp, result.odometry_used);
  map_.centreOn(pose.pose.position());
  if (stamp_) {
    const MatchResult match = matcher_.match(map_, endPoints(scan), pose, random_);
    result.match = match.quality;
    velocity_ =
        twistOf(base_in_map_.pose.inverse() * match.pose.pose, secondsBetween(*stamp_, scan.stamp));
    pose = match.pose;
  }
  const std::vector<PointState> states = judge(scan, map_, pose.pose);
  map_.update(scan, states, pose.pose);
  base_in_map_ = pose;
  stamp_ = scan.stamp;
  result.split = split(scan, states, pose);
  return result;
}

void GridSlam::reset() {
  map_.clear();
  odometry_.clear();
  random_ = Random(static_cast<std::uint64_t>(options_.seed));
  base_in_map_ = {};
  velocity_ = {};
  stamp_.reset();
}

}  // namespace datmo_fusion
