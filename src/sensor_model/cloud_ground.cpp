// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/cloud_ground.h"

#include <cmath>
#include <mutex>

#include <pcl/ModelCoefficients.h>
#include <pcl/PointIndices.h>
#include <pcl/console/print.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/segmentation/sac_segmentation.h>

namespace datmo {

namespace {

/// RANSAC samples: with a third of the points on the ground, 120 find it with a probability of
/// 0.99.
constexpr int kMaxIterations = 200;

/// Maximum number of points that are used: several for each voxel.
constexpr std::size_t kMaxGroundSamples = 20000;

/// The points that may be on the ground, subsampled.
LidarPoints::Ptr candidates(const LidarPoints& points, const std::vector<int>& indices,
                            const CloudGroundOptions& options) {
  const std::size_t stride = indices.size() / kMaxGroundSamples + 1;
  LidarPoints::Ptr chosen(new LidarPoints);
  chosen->reserve(indices.size() / stride + 1);
  for (std::size_t i = 0; i < indices.size(); i += stride) {
    const pcl::PointXYZ& point = points[static_cast<std::size_t>(indices[i])];
    const double distance = std::hypot(point.x, point.y);
    const double max_height = options.max_height + options.tolerance + options.max_slope * distance;
    if (distance <= options.max_distance && std::abs(point.y) <= options.half_width &&
        std::abs(point.z) <= max_height) {
      chosen->push_back(point);
    }
  }
  return chosen;
}

/// Centroids of voxels; these are flat, so that objects on the ground do not mix with it.
LidarPoints::Ptr voxels(const LidarPoints::Ptr& points, const CloudGroundOptions& options) {
  const auto size = static_cast<float>(options.voxel_size);
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setInputCloud(points);
  grid.setLeafSize(size, size, static_cast<float>(2.0 * options.tolerance));
  LidarPoints::Ptr centroids(new LidarPoints);
  grid.filter(*centroids);
  return centroids;
}

/// Suppresses PCL's console output during its lifetime: that there is no plane is not an error. The
/// level is that of the process: the first user saves it, the last one restores it.
class QuietPcl {
 public:
  QuietPcl() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (users_++ == 0) {
      level_ = pcl::console::getVerbosityLevel();
      pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
    }
  }
  ~QuietPcl() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (--users_ == 0) {
      pcl::console::setVerbosityLevel(level_);
    }
  }
  QuietPcl(const QuietPcl&) = delete;
  QuietPcl& operator=(const QuietPcl&) = delete;

 private:
  static inline std::mutex mutex_;
  static inline int users_ = 0;
  static inline pcl::console::VERBOSITY_LEVEL level_ = pcl::console::L_INFO;
};

/// a x + b y + c z + d = 0 solved for z.
RoadPlane planeOf(const pcl::ModelCoefficients& coefficients) {
  const std::vector<float>& values = coefficients.values;
  const double up = values[2];
  return {-values[3] / up, -values[0] / up, -values[1] / up};
}

/// With comparisons in this order, a plane with NaN is not credible.
bool isCredible(const RoadPlane& plane, const CloudGroundOptions& options) {
  return std::abs(plane.height) <= options.max_height &&
         std::hypot(plane.slope_x, plane.slope_y) <= options.max_slope;
}

}  // namespace

void CloudGroundOptions::visit(OptionVisitor& visitor) {
  visitor.toggle(
      {"estimate", "",
       "estimate the ground plane in each cloud; false: it is flat, z = 0 of the base frame"},
      estimate);
  visitor.number({"max_distance", "m", "how far from the vehicle the ground is searched for"},
                 max_distance, {2.0, 100.0});
  visitor.number({"half_width", "m", "how far to either side of the vehicle"}, half_width,
                 {1.0, 100.0});
  visitor.number({"voxel_size", "m", "one point for each square of this side supports the plane"},
                 voxel_size, {0.05, 2.0});
  visitor.number(
      {"tolerance", "m",
       "points farther from the plane do not belong to the ground: less than a curb's height"},
      tolerance, {0.01, 0.5});
  visitor.integer({"min_voxels", "1", "minimum number of squares of ground that support a plane"},
                  min_voxels, {3, 10000});
  visitor.number(
      {"max_slope", "m/m", "a plane steeper than this relative to the vehicle is not the ground"},
      max_slope, {0.001, 0.5});
  visitor.number(
      {"max_height", "m", "nor is one farther from z = 0 of the base frame at its origin"},
      max_height, {0.0, 2.0});
}

CloudGround findGround(const LidarPoints& points, const std::vector<int>& indices,
                       const CloudGroundOptions& options) {
  const LidarPoints::Ptr ground =
      options.estimate ? voxels(candidates(points, indices, options), options) : nullptr;
  if (!ground || ground->size() < static_cast<std::size_t>(options.min_voxels)) {
    return {};
  }
  pcl::SACSegmentation<pcl::PointXYZ> search;
  search.setModelType(pcl::SACMODEL_PERPENDICULAR_PLANE);
  search.setMethodType(pcl::SAC_RANSAC);
  search.setAxis(Eigen::Vector3f::UnitZ());
  search.setEpsAngle(std::atan(options.max_slope));
  search.setDistanceThreshold(options.tolerance);
  search.setMaxIterations(kMaxIterations);
  search.setOptimizeCoefficients(true);
  search.setInputCloud(ground);
  pcl::PointIndices inliers;
  pcl::ModelCoefficients coefficients;
  const QuietPcl quiet;
  search.segment(inliers, coefficients);
  if (inliers.indices.size() < static_cast<std::size_t>(options.min_voxels)) {
    return {};
  }
  const RoadPlane plane = planeOf(coefficients);
  return isCredible(plane, options) ? CloudGround{plane, true, inliers.indices.size()}
                                    : CloudGround();
}

}  // namespace datmo
