// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/detection/cloud_object_detector.h"

#include <cmath>

#include "cloud_outline.h"
#include "side_model.h"
#include <pcl/filters/voxel_grid.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/square.h"
#include "datmo_fusion/detection/box_fit.h"

namespace datmo {

namespace {

/// Sensor name of the objects.
constexpr char kSensor[] = "cloud";

/// The points in the height band, at the cloud's stamp.
class Band {
 public:
  Band(const CloudObjectDetectorOptions& options, const RoadPlane& ground, const Point2& lidar)
      : options_(options), ground_(ground), lidar_(lidar) {}

  bool holds(const pcl::PointXYZ& point) const {
    const double height = ground_.heightOf(point.getVector3fMap().cast<double>());
    return height >= options_.min_height && height <= options_.max_height &&
           (Point2(point.x, point.y) - lidar_).norm() <= options_.max_range;
  }

 private:
  const CloudObjectDetectorOptions& options_;
  const RoadPlane& ground_;
  Point2 lidar_;
};

/// Transforms a point of the sweep to the stamp, by the vehicle's motion, assuming that it is
/// static. Its time is stored as intensity.
pcl::PointXYZI atStamp(const pcl::PointXYZ& point, float time, const std::optional<Twist2>& twist) {
  const Point2 seen(point.x, point.y);
  const Point2 moved = twist ? arc(*twist, static_cast<double>(time)) * seen : seen;
  pcl::PointXYZI result;
  result.x = static_cast<float>(moved.x());
  result.y = static_cast<float>(moved.y());
  result.z = point.z;
  result.intensity = time;
  return result;
}

/// Clusters of neighboring points, as indices. They are formed from the centroids of voxels, so
/// that dense points near the lidar cost no more than distant ones.
std::vector<std::vector<int>> clusters(const TimedPoints::ConstPtr& points,
                                       const CloudObjectDetectorOptions& options) {
  if (points->empty()) {
    return {};  // avoids PCL's console warning
  }
  pcl::VoxelGrid<pcl::PointXYZI> grid;
  const auto leaf = static_cast<float>(options.voxel_size);
  grid.setLeafSize(leaf, leaf, leaf);
  grid.setSaveLeafLayout(true);
  grid.setInputCloud(points);
  TimedPoints::Ptr voxels(new TimedPoints);
  grid.filter(*voxels);

  std::vector<pcl::PointIndices> groups;
  pcl::EuclideanClusterExtraction<pcl::PointXYZI> extraction;
  extraction.setSearchMethod(
      pcl::search::KdTree<pcl::PointXYZI>::Ptr(new pcl::search::KdTree<pcl::PointXYZI>));
  extraction.setClusterTolerance(options.cluster_distance);
  extraction.setInputCloud(voxels);
  extraction.extract(groups);

  std::vector<std::size_t> cluster_of_voxel(voxels->size());
  for (std::size_t cluster = 0; cluster < groups.size(); ++cluster) {
    for (const int voxel : groups[cluster].indices) {
      cluster_of_voxel[static_cast<std::size_t>(voxel)] = cluster;
    }
  }
  std::vector<std::vector<int>> found(groups.size());
  for (std::size_t i = 0; i < points->size(); ++i) {
    const int voxel = grid.getCentroidIndex((*points)[i]);
    found[cluster_of_voxel.at(static_cast<std::size_t>(voxel))].push_back(static_cast<int>(i));
  }
  return found;
}

/// Sets the box and its sides from the object's points.
void setBox(Object& object, const CloudOutline& outline, const Point2& lidar,
            const CloudObjectDetectorOptions& options) {
  const BoxFit fit = fitBox(object.points, lidar, {options.range_sigma});
  const auto seen_variance = [&fit](std::size_t points) {
    return square(fit.noise) / static_cast<double>(points);
  };
  const auto end_beyond = [&](const Point2& normal, double) -> std::optional<SurfaceEnd> {
    const bool is_first = normal.dot(object.points.front() - object.points.back()) > 0.0;
    const OutlineEnd& end = is_first ? outline.first : outline.last;
    // A single column has both ends.
    const bool hidden =
        object.points.size() == 1 ? outline.first.hidden || outline.last.hidden : end.hidden;
    if (hidden) {
      return std::nullopt;
    }
    // The side ends anywhere before the next column.
    return SurfaceEnd{0.5 * end.gap, kUniformVariance * square(end.gap)};
  };
  setSides(object, fit, {seen_variance, end_beyond});
}

}  // namespace

void CloudObjectDetectorOptions::visit(OptionVisitor& visitor) {
  visitor.number(
      {"min_height", "m", "points lower than this above the ground do not belong to an object",
       Tier::kPublic},
      min_height, {0.05, 2.0});
  visitor.number(
      {"max_height", "m", "nor do points higher than this: signs, branches, roofs", Tier::kPublic},
      max_height, {0.5, 10.0});
  visitor.number({"max_range", "m", "from the lidar; farther points are ignored", Tier::kPublic},
                 max_range, {5.0, 300.0});
  visitor.number({"voxel_size", "m", "edge of a voxel; the points in a voxel belong to one object"},
                 voxel_size, {0.1, 1.0});
  visitor.number({"cluster_distance", "m",
                  "voxels whose centroids are closer than this belong to one object; more than "
                  "voxel_size and than the gap between two rows of the lidar at max_range, less "
                  "than the gap between two objects"},
                 cluster_distance, {0.05, 3.0});
  visitor.integer({"min_points", "1", "minimum number of points of an object", Tier::kPublic},
                  min_points, {1, 1000});
  visitor.number(
      {"max_size", "m", "a longer cluster is not a road user but a wall or a hedge", Tier::kPublic},
      max_size, {1.0, 50.0});
  visitor.number({"column_spacing", "rad", "angle between two columns of the lidar (data sheet)"},
                 column_spacing, {degrees(0.02), degrees(5.0)});
  visitor.number({"row_spacing", "rad", "angle between two rows of the lidar (data sheet)"},
                 row_spacing, {degrees(0.02), degrees(5.0)});
  visitor.number(
      {"range_sigma", "m",
       "standard deviation of a point about the side of the box it lies on: bodies are round",
       Tier::kPublic},
      range_sigma, {0.001, 1.0});
  visitor.number({"position_sigma", "m",
                  "standard deviation of errors that shift all sides of an object together: mount, "
                  "time, the shape of bodies"},
                 position_sigma, {0.0, 1.0});
  visitor.number({"max_doubt", "1", "an unusual size lowers the log odds by at most this"},
                 max_doubt, {0.0, 20.0});
  visitor.group("vehicle", [&] { vehicle.visit(visitor); });
  visitor.group("ground", [&] { ground.visit(visitor); });
  visitor.group("classifier", [&] { classifier.visit(visitor); });
}

namespace {

/// Maximum number of voxels that a cloud may span, for at most 400 MB.
constexpr double kMaxVoxels = 1e8;

/// The ground may slope, and the height band with it.
double voxelsOf(const CloudObjectDetectorOptions& options) {
  const double across = 2.0 * options.max_range;
  const double up =
      options.max_height - options.min_height + 2.0 * options.ground.max_slope * across;
  return across / options.voxel_size * across / options.voxel_size * up / options.voxel_size;
}

}  // namespace

void CloudObjectDetectorOptions::check() const {
  if (min_height >= max_height) {
    throw OptionError("min_height = " + std::to_string(min_height) +
                      ": expected less than max_height = " + std::to_string(max_height));
  }
  if (voxelsOf(*this) > kMaxVoxels) {
    throw OptionError("voxel_size = " + std::to_string(voxel_size) +
                      ": expected more, so that the clouds out to max_range = " +
                      std::to_string(max_range) + " have at most 100 million voxels");
  }
  if (cluster_distance <= voxel_size) {
    throw OptionError("cluster_distance = " + std::to_string(cluster_distance) +
                      ": expected more than voxel_size = " + std::to_string(voxel_size));
  }
}

CloudObjectDetector::CloudObjectDetector(const Checked<CloudObjectDetectorOptions>& options)
    : options_(*options), classifier_(options->classifier) {}

CloudObjects CloudObjectDetector::detect(const LidarCloud& cloud, Stamp stamp,
                                         const std::optional<Twist2>& twist) const {
  CloudObjects result;
  result.list.stamp = stamp;
  const LidarPoints::Ptr points = toBase(cloud);
  const std::vector<int> outside = outsideOfVehicle(points, options_.vehicle);
  result.own_points = points->size() - outside.size();
  result.ground = findGround(*points, outside, options_.ground);
  const Point2 lidar = cloud.lidar_in_base.translation().head<2>();
  const Band band(options_, result.ground.plane, lidar);
  TimedPoints::Ptr standing(new TimedPoints);
  for (const int i : outside) {
    const auto index = static_cast<std::size_t>(i);
    if (band.holds((*points)[index])) {
      const float time = cloud.times.empty() ? 0.0F : cloud.times[index];
      standing->push_back(atStamp((*points)[index], time, twist));
    }
  }
  result.points = standing->size();
  const CloudColumns columns(*standing, lidar, options_.column_spacing);
  for (const std::vector<int>& cluster : clusters(standing, options_)) {
    if (cluster.size() < static_cast<std::size_t>(options_.min_points)) {
      continue;
    }
    const CloudOutline outline = columns.outlineOf(cluster, result.ground.plane);
    if (outline.size() > options_.max_size) {
      ++result.too_large;
      continue;
    }
    Object object;
    object.points = outline.points;
    object.sensors = {kSensor};
    object.height = outline.top;
    object.delay = outline.mean_time;
    object.position_covariance *= square(options_.position_sigma);
    setBox(object, outline, lidar, options_);
    const bool cut = outline.top > options_.max_height - options_.row_spacing * outline.range;
    classifier_.classify(outline.seenSize(options_.row_spacing, cut), options_.max_doubt, object);
    result.list.objects.push_back(std::move(object));
  }
  return result;
}

}  // namespace datmo
