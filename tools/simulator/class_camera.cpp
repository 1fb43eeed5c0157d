// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/class_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "simulator/ground_truth.h"

#include "datmo_fusion/common/square.h"

namespace datmo::simulator {

namespace {

constexpr std::array<ObjectClass, 3> kReported = {ObjectClass::kPedestrian, ObjectClass::kCyclist,
                                                  ObjectClass::kVehicle};
constexpr std::size_t kClasses = kReported.size();

/// Of a row or column of the confusion matrix; kClasses: none.
std::size_t indexOf(ObjectClass object_class) {
  return static_cast<std::size_t>(std::find(kReported.begin(), kReported.end(), object_class) -
                                  kReported.begin());
}

}  // namespace

void ClassCameraOptions::visit(OptionVisitor& visitor) {
  visitor.toggle(
      {"enabled", "",
       "the vehicle has a camera whose detector reports classes, on /objects/mono; there "
       "are no images"},
      enabled);
  visitor.number({"mount_x", "m", "ahead of the rear axle; assumed"}, mount_x, {-10.0, 10.0});
  visitor.number({"mount_y", "m", "left of the vehicle's middle"}, mount_y, {-3.0, 3.0});
  visitor.number({"mount_height", "m", "above the road; assumed"}, mount_height, {0.05, 5.0});
  visitor.number({"field_of_view", "rad", "as KITTI's cameras"}, field_of_view, {0.1, kPi});
  visitor.number({"range", "m", "nothing is reported farther away"}, range, {1.0, 500.0});
  visitor.number({"rate", "Hz", "of the images"}, rate, {0.1, 100.0});
  visitor.number({"latency", "s", "from an exposure, the stamp, to its report; assumed"}, latency,
                 {0.0, 2.0});
  visitor.number({"min_visible_share", "1", "of an object's width, for it to be reported"},
                 min_visible_share, {0.0, 1.0});
  visitor.number({"bearing_sigma", "rad", "standard deviation of the bearing; assumed"},
                 bearing_sigma, {0.0001, 0.5});
  visitor.number({"range_share", "1", "standard deviation of the range by size, of the range"},
                 range_share, {0.001, 1.0});
  visitor.numbers({"confusion", "1",
                   "confusion matrix, row by row: for a pedestrian, a cyclist and a vehicle the "
                   "shares of images that report it as each of these; the others do not report it. "
                   "About what YOLO-Fastest reaches on KITTI's drive 0005"},
                  confusion, {0.0, 1.0});
}

void ClassCameraOptions::check() const {
  if (confusion.size() != kClasses * kClasses) {
    throw OptionError("confusion has " + std::to_string(confusion.size()) +
                      " shares: expected 9, for each of three classes as each of three");
  }
  for (std::size_t row = 0; row < kClasses; ++row) {
    double sum = 0.0;
    for (std::size_t column = 0; column < kClasses; ++column) {
      sum += confusion[row * kClasses + column];
    }
    if (sum > 1.0 + 1e-9) {
      throw OptionError("confusion: shares of row " + std::to_string(row + 1) + " are " +
                        std::to_string(sum) + " in all: expected at most 1");
    }
  }
}

Viewpoint ClassCamera::viewpoint() const {
  return {"mono", Pose2(options_.mount_x, options_.mount_y, 0.0), options_.mount_height,
          options_.field_of_view, options_.range};
}

ObjectClass ClassCamera::drawnReport(ObjectClass object_class) {
  const std::size_t row = indexOf(object_class);
  double left = random_.uniform();
  for (std::size_t column = 0; row < kClasses && column < kClasses; ++column) {
    left -= options_.confusion[row * kClasses + column];
    if (left < 0.0) {
      return kReported[column];
    }
  }
  return ObjectClass::kUnknown;
}

ClassProbabilities ClassCamera::probabilitiesOf(ObjectClass reported) const {
  const std::size_t column = indexOf(reported);
  double sum = 0.0;
  for (std::size_t row = 0; row < kClasses; ++row) {
    sum += options_.confusion[row * kClasses + column];
  }
  ClassProbabilities result{};
  for (std::size_t row = 0; row < kClasses; ++row) {
    result[static_cast<std::size_t>(kReported[row])] =
        options_.confusion[row * kClasses + column] / sum;
  }
  return result;
}

bool ClassCamera::isNear(const ObjectState& object, const Pose2& base) const {
  const Point2 camera = base * Point2(options_.mount_x, options_.mount_y);
  return (object.center.position() - camera).norm() - object.box().halfDiagonal() <= options_.range;
}

Object ClassCamera::seen(const ObjectState& object, const Pose2& base, ObjectClass reported) {
  const Pose2 center = base.inverse() * object.center;
  const Point2 camera(options_.mount_x, options_.mount_y);
  const Point2 to_center = center.position() - camera;
  const double range = to_center.norm();
  const Point2 ahead = to_center / range;
  const Point2 aside(-ahead.y(), ahead.x());
  const double depth_sigma = options_.range_share * range;
  const double side_sigma = options_.bearing_sigma * range;
  Object result;
  const Point2 position =
      center.position() + random_.normal(depth_sigma) * ahead + random_.normal(side_sigma) * aside;
  result.box = {Pose2(position, center.heading()), object.kind.length, object.kind.width};
  result.position_covariance = square(depth_sigma) * ahead * ahead.transpose() +
                               square(side_sigma) * aside * aside.transpose();
  result.side_variance.fill(kHiddenSide);
  result.class_probabilities = probabilitiesOf(reported);
  result.sensors = {viewpoint().sensor};
  return result;
}

ObjectList ClassCamera::measure(const World& world, double time) {
  const WorldState state = world.at(time);
  ObjectList list;
  for (const ObjectState& object : state.objects) {
    // Drawn before the visibility is tested, so that whether one object is visible does not change
    // the draws of the others.
    const ObjectClass reported = drawnReport(object.kind.object_class);
    if (reported != ObjectClass::kUnknown && isNear(object, state.base) &&
        lookAt(object, viewpoint(), world, state).visible >= options_.min_visible_share) {
      list.objects.push_back(seen(object, state.base, reported));
    }
  }
  return list;
}

}  // namespace datmo::simulator
