// SPDX-License-Identifier: BSD-3-Clause
// What GridSlam does about odometry that is wrong.
#include <cmath>
#include <vector>

#include "datmo_fusion/slam/grid_slam.h"

namespace datmo {

namespace {

/// Standard deviations by which one pose has to be better: one in 100.
constexpr double kSurely = 2.33;

/// Whether the scan's end points lie on what stands still in the map more often from one pose than
/// from the other (McNemar's test). What moves along with the vehicle has no say: a platoon would
/// keep it where it is.
bool fitsBetter(const OccupancyMap& map, const Scan& scan, const Pose2& than, const Pose2& pose) {
  int only_here = 0;
  int only_there = 0;
  for (const Ray& ray : scan.rays) {
    if (ray.hit) {
      const bool here = map.judge(pose * ray.end) == PointState::kStatic;
      const bool there = map.judge(than * ray.end) == PointState::kStatic;
      only_here += here && !there ? 1 : 0;
      only_there += there && !here ? 1 : 0;
    }
  }
  return only_here - only_there > kSurely * std::sqrt(only_here + only_there);
}

/// Every second one.
std::vector<EndPoint> thinned(const std::vector<EndPoint>& points) {
  std::vector<EndPoint> kept;
  kept.reserve(points.size() / 2 + 1);
  for (std::size_t i = 0; i < points.size(); i += 2) {
    kept.push_back(points[i]);
  }
  return kept;
}

}  // namespace

Scan GridSlam::checkOdometry(const Measurement& measurement, const PoseFilter& before,
                             double seconds, const Scan& scan, SlamResult& result) {
  const Stamp stamp = measurement.scan.stamp;
  const auto motion = odometry_.motion(stamp + -seconds, stamp, before.errors());
  if (!motion) {
    trust_.interrupt();
    return scan;
  }
  trust_.observeFrom(stamp + -seconds, before);
  trust_.predict(*motion, seconds);
  const Scan by_scans = compensated(measurement.scan, trust_.byScans().velocity());
  const std::vector<EndPoint> points = endPointsOf(measurement, by_scans);
  const Prediction prediction{trust_.byScans().pose(), false};
  // As long as nobody goes by it, a coarser match does, at a quarter of the cost.
  const MatchResult match =
      trust_.isTrusted() ? trust_matcher_.match(map_, thinned(points), prediction, trust_random_)
                         : matcher_.match(map_, points, prediction, trust_random_);
  trust_.byScans().correct(match.pose);
  trust_.judge(stamp, [&] {
    return fitsBetter(map_, by_scans, filter_.pose().pose, trust_.byScans().pose().pose);
  });
  result.odometry_contradiction = trust_.contradiction();
  result.odometry_trusted = trust_.isTrusted();
  Scan used = scan;
  if (!result.odometry_trusted) {
    filter_ = trust_.byScans();
    result.match = match.quality;
    result.odometry_used = false;
    used = compensated(measurement.scan, filter_.velocity());
  }
  trust_.endWindow(stamp);
  return used;
}

}  // namespace datmo
