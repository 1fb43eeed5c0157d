#include "datmo_fusion/detection/moving_object_detector.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/uniform.h"
#include "datmo_fusion/detection/box_fit.h"

namespace datmo {

namespace {

constexpr char kSensor[] = "lidar";

/// The points of one segment of the scan that the map does not know as static.
std::vector<ScanPoint> notStatic(const std::vector<ScanPoint>& points, const Segment& segment) {
  std::vector<ScanPoint> result;
  for (const std::size_t i : segment) {
    if (points[i].state != PointState::kStatic) {
      result.push_back(points[i]);
    }
  }
  return result;
}

double movingFraction(const std::vector<ScanPoint>& points, const Segment& segment) {
  const auto moving = std::count_if(segment.begin(), segment.end(), [&](std::size_t i) {
    return points[i].state == PointState::kMoving;
  });
  return static_cast<double>(moving) / static_cast<double>(segment.size());
}

/// Along and across a direction, to x and y.
Eigen::Matrix2d alongAcross(double direction, double along_variance, double across_variance) {
  const Eigen::Matrix2d turn = Pose2(0.0, 0.0, direction).rotation();
  return turn * Point2(along_variance, across_variance).asDiagonal() * turn.transpose();
}

/// Mean angle between the scan's beams, rad; 0 for fewer than two points.
double beamSpacing(const std::vector<ScanPoint>& points) {
  if (points.size() < 2 || points.back().beam == points.front().beam) {
    return 0.0;
  }
  double angle = 0.0;  // point by point: the whole scan may span more than half a turn
  for (std::size_t i = 1; i < points.size(); ++i) {
    angle += std::abs(angleBetween(points[i - 1].bearing, points[i].bearing));
  }
  return angle / static_cast<double>(points.back().beam - points.front().beam);
}

}  // namespace

void MovingObjectDetectorOptions::visit(OptionVisitor& visitor) {
  visitor.group("segmentation", [&] { segmentation.visit(visitor); });
  visitor.number({"moving_share", "1",
                  "an object is moving if more than this share of its points lies where the map is "
                  "free (thesis 3.3.1: 0, any point)"},
                 moving_share, {0.0, 1.0});
  visitor.number({"largest_size", "m", "longer things are no objects: walls, hedges"}, largest_size,
                 {0.5, 100.0});
  visitor.integer({"least_points", "1", "points that make an object"}, least_points, {1, 1000});
  visitor.number({"range_sigma", "m", "standard deviation of the scanner's range"}, range_sigma,
                 {0.001, 5.0});
  visitor.number(
      {"extent_sigma", "m",
       "standard deviation of the seen part's centre about the object's, along each axis"},
      extent_sigma, {0.0, 5.0});
}

MovingObjectDetector::MovingObjectDetector(const MovingObjectDetectorOptions& options)
    : options_(options) {
  checkOptions(options);
}

ObjectList MovingObjectDetector::detect(const SplitScan& scan) const {
  ObjectList list{scan.stamp, {}};
  const double spacing = beamSpacing(scan.points);
  for (const Segment& whole : segmentPoints(scan.points, options_.segmentation)) {
    const std::vector<ScanPoint> points = notStatic(scan.points, whole);
    const bool touches_static = points.size() < whole.size();
    for (const Segment& segment : segmentPoints(points, options_.segmentation)) {
      if (segment.size() < static_cast<std::size_t>(options_.least_points)) {
        continue;
      }
      Object object = makeObject(points, segment, scan.scanner_in_base, spacing);
      if (object.box.length > options_.largest_size) {
        continue;
      }
      if (touches_static && object.dynamic_state == DynamicState::kUnknown) {
        // A wall comes into view piece by piece: what joins on to it belongs to it.
        object.dynamic_state = DynamicState::kStatic;
      }
      list.objects.push_back(std::move(object));
    }
  }
  return list;
}

Object MovingObjectDetector::makeObject(const std::vector<ScanPoint>& points,
                                        const Segment& segment, const Pose2& scanner,
                                        double beam_spacing) const {
  Object object;
  for (const std::size_t i : segment) {
    object.points.push_back(points[i].position);
  }
  object.box = fitBox(object.points);
  object.moving_fraction = movingFraction(points, segment);
  object.dynamic_state = object.moving_fraction > options_.moving_share ? DynamicState::kMoving
                                                                        : DynamicState::kUnknown;
  object.sensors = {kSensor};
  const Point2 line_of_sight = object.box.centre.position() - scanner.position();
  const double range = line_of_sight.norm();
  const double across = range * beam_spacing;
  const double extent = options_.extent_sigma * options_.extent_sigma;
  object.position_covariance = alongAcross(std::atan2(line_of_sight.y(), line_of_sight.x()),
                                           options_.range_sigma * options_.range_sigma + extent,
                                           across * across * kUniformVariance + extent);
  if (object.box.length > 0.0) {
    // Either end of the longer side may be off by a beam.
    const double end_sigma = std::hypot(options_.range_sigma, across) / object.box.length;
    object.heading_variance = std::min(object.heading_variance, end_sigma * end_sigma);
  }
  return object;
}

}  // namespace datmo
