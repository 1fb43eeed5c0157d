// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/detection/moving_object_detector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "side_model.h"

#include "datmo_fusion/common/square.h"
#include "datmo_fusion/detection/box_fit.h"
#include "datmo_fusion/detection/segment_end.h"

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

/// Mean time of a segment's points, s after the scan's stamp.
double meanTime(const std::vector<ScanPoint>& points, const Segment& segment, double beam_time) {
  const double beams = std::accumulate(
      segment.begin(), segment.end(), 0.0,
      [&](double sum, std::size_t i) { return sum + static_cast<double>(points[i].beam); });
  return beam_time * beams / static_cast<double>(segment.size());
}

}  // namespace

void MovingObjectDetectorOptions::visit(OptionVisitor& visitor) {
  visitor.group("segmentation", [&] { segmentation.visit(visitor); });
  visitor.number({"moving_share", "1",
                  "an object is moving if more than this share of its points lies where the map is "
                  "free (thesis 3.3.1: 0, any point)",
                  Tier::kLive},
                 moving_share, {0.0, 1.0});
  visitor.number(
      {"max_size", "m", "longer segments are not objects but walls or hedges", Tier::kLive},
      max_size, {0.5, 100.0});
  visitor.integer({"min_points", "1", "minimum number of points of an object", Tier::kLive},
                  min_points, {1, 1000});
  visitor.number({"range_sigma", "m", "standard deviation of the scanner's range", Tier::kPublic},
                 range_sigma, {0.001, 5.0});
  visitor.number({"position_sigma", "m",
                  "standard deviation of the box as a whole along each axis, in addition to that "
                  "of its sides: bodies are not rectangles, and scans take time",
                  Tier::kPublic},
                 position_sigma, {0.001, 5.0});
}

MovingObjectDetector::MovingObjectDetector(const Checked<MovingObjectDetectorOptions>& options)
    : options_(*options) {}

ObjectList MovingObjectDetector::detect(const LabeledScan& scan) const {
  ObjectList list{scan.stamp, {}, {}};
  for (const Segment& whole : segmentPoints(scan.points, options_.segmentation)) {
    const std::vector<ScanPoint> points = notStatic(scan.points, whole);
    const bool touches_static = points.size() < whole.size();
    for (const Segment& segment : segmentPoints(points, options_.segmentation)) {
      if (segment.size() < static_cast<std::size_t>(options_.min_points)) {
        continue;
      }
      Object object = makeObject(points, segment, scan);
      if (object.box.length > options_.max_size) {
        continue;
      }
      if (touches_static && object.dynamic_state == DynamicState::kUnknown) {
        // A wall comes into view piece by piece: what is connected to it belongs to it.
        object.dynamic_state = DynamicState::kStatic;
      }
      list.objects.push_back(std::move(object));
    }
  }
  return list;
}

Object MovingObjectDetector::makeObject(const std::vector<ScanPoint>& points,
                                        const Segment& segment, const LabeledScan& scan) const {
  Object object;
  for (const std::size_t i : segment) {
    object.points.push_back(points[i].position);
  }
  setBox(object, points[segment.front()], points[segment.back()], scan);
  object.position_covariance.setIdentity();
  object.position_covariance *= square(options_.position_sigma);
  object.moving_fraction = movingFraction(points, segment);
  object.dynamic_state = object.moving_fraction > options_.moving_share ? DynamicState::kMoving
                                                                        : DynamicState::kUnknown;
  object.delay = meanTime(points, segment, scan.field.beam_time);
  object.sensors = {kSensor};
  return object;
}

/// Sets the box and its sides from the object's points, from the first to the last beam.
void MovingObjectDetector::setBox(Object& object, const ScanPoint& first, const ScanPoint& last,
                                  const LabeledScan& scan) const {
  const BoxFit fit = fitBox(object.points, scan.scanner_in_base.position(), {options_.range_sigma});
  const SegmentEnds ends(scan, options_.range_sigma, options_.segmentation.max_gap);
  const auto seen_variance = [&fit](std::size_t points) {
    return square(fit.noise) / static_cast<double>(points);
  };
  const auto end_beyond = [&](const Point2& normal, double heading_std) {
    const ScanPoint& outermost = normal.dot(first.position - last.position) > 0.0 ? first : last;
    return ends.beyond(outermost, normal, heading_std);
  };
  setSides(object, fit, {seen_variance, end_beyond});
}

}  // namespace datmo
