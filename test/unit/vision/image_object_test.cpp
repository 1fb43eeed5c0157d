// SPDX-License-Identifier: BSD-3-Clause
// Detections from the image alone, over many rectangles: bodies of all sizes and headings, seen by
// a pitching camera, with edge errors as in ImageRangeOptions.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "vision/image_samples.h"
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/cross.h"
#include "datmo_fusion/common/perpendicular.h"
#include "datmo_fusion/common/random.h"
#include "datmo_fusion/common/square.h"
#include "datmo_fusion/detection/object_classifier.h"
#include "datmo_fusion/visibility/box_silhouette.h"
#include "datmo_fusion/vision/image_range.h"

namespace datmo::image_object_test {
namespace {

using test::detectionOf;
using test::levelCamera;

constexpr int kBodies = 1000;
constexpr double kGate95 = 5.991;  ///< chi-square with two degrees of freedom

struct Body {
  Box2 box;
  double height;
};

/// By the shares in the mixture of vehicle sizes for the image.
const KindSize& kindOf(ObjectClass object_class, Random& random) {
  static const ObjectClassifierOptions kinds;
  if (object_class != ObjectClass::kVehicle) {
    return object_class == ObjectClass::kPedestrian ? kinds.pedestrian : kinds.cyclist;
  }
  const double all = kinds.car.share + kinds.van.share + kinds.truck.share;
  const double drawn = random.uniform(0.0, all);
  return drawn < kinds.car.share           ? kinds.car
         : drawn < all - kinds.truck.share ? kinds.van
                                           : kinds.truck;
}

Body bodyAt(double distance, ObjectClass object_class, Random& random) {
  const KindSize& kind = kindOf(object_class, random);
  const auto drawn = [&](double mean, double sigma) {
    return std::max(0.2, mean + random.normal(sigma));
  };
  const double bearing = random.uniform(-0.4, 0.4);
  const Pose2 pose(distance * Point2(std::cos(bearing), std::sin(bearing)),
                   random.uniform(-kPi, kPi));
  return {{pose, drawn(kind.length, kind.length_sigma), drawn(kind.width, kind.width_sigma)},
          drawn(kind.height, kind.height_sigma)};
}

/// As reported by a detector that does not know of the camera's pitch.
ImageDetection reportOf(const Body& body, ObjectClass object_class, Random& random) {
  const ImageRangeOptions options;
  MountedCamera pitched = levelCamera();
  pitched.in_base.rotate(
      Eigen::AngleAxisd(random.normal(options.pitch_sigma), Eigen::Vector3d::UnitX()));
  const Eigen::AlignedBox2d seen = boxInImage(pitched, body.box, body.height);
  const auto off = [&](double extent) {
    return random.normal(std::hypot(options.edge_sigma, options.edge_share * extent));
  };
  const double width = seen.sizes().x();
  const double height = seen.sizes().y();
  return detectionOf(object_class, seen.min().x() + off(width), seen.min().y() + off(height),
                     seen.max().x() + off(width), seen.max().y() + off(height));
}

/// rad, bearings of the right and the left end of a box from the vehicle.
Eigen::Vector2d edgesOf(const Box2& box) {
  const BoxSilhouette silhouette(box, Point2::Zero());
  const double middle = silhouette.bearing() + box.center.heading();
  return {normalizeAngle(middle + silhouette.right()), normalizeAngle(middle + silhouette.left())};
}

/// The side of a box that the vehicle sees at the middle of the box's bearings.
struct NearSide {
  double range = std::numeric_limits<double>::infinity();  ///< m, there
  double bearing = 0.0;                                    ///< rad, between those of its ends
};

NearSide nearSideOf(const Box2& box) {
  const double middle = edgesOf(box).mean();
  const Point2 ray(std::cos(middle), std::sin(middle));
  const std::array<Point2, 4> corners = box.corners();
  NearSide nearest;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point2& from = corners[i];
    const Point2& to = corners[(i + 1) % corners.size()];
    const double range = cross(from, to - from) / cross(ray, to - from);
    if (cross(ray, from) * cross(ray, to) <= 0.0 && range < nearest.range) {
      nearest = {range, 0.5 * (std::atan2(from.y(), from.x()) + std::atan2(to.y(), to.x()))};
    }
  }
  return nearest;
}

/// NEES of the near side's range and of its middle, along the line of sight and across it.
double neesOf(const Object& object, const Body& body) {
  const NearSide truth = nearSideOf(body.box);
  const Point2 center = object.box.center.position();
  const Point2 ahead = center.normalized();
  const Point2 aside = perpendicular(ahead);
  const auto& [front, rear, left, right] = object.side_variance;
  EXPECT_EQ(front, kHiddenSide) << "nobody sees the far side";
  const double along = center.norm() - 0.5 * object.box.length - truth.range;
  const double across = center.norm() * (std::atan2(center.y(), center.x()) - truth.bearing);
  const Eigen::Matrix2d& covariance = object.position_covariance;
  return square(along) / (ahead.dot(covariance * ahead) + rear) +
         square(across) / (aside.dot(covariance * aside) + 0.25 * (left + right));
}

TEST(ImageObject, ItsNearSideIsConsistentWithItsCovariance) {
  Random random(5);
  ImageRangeOptions options;
  options.max_range = 500.0;  // so that none is dropped for its apparent range
  for (const ObjectClass object_class :
       {ObjectClass::kPedestrian, ObjectClass::kCyclist, ObjectClass::kVehicle}) {
    for (const double distance : {12.0, 18.0, 27.0}) {
      double sum = 0.0;
      int inside = 0;
      int reported = 0;  // noise may leave none of it
      for (int i = 0; i < kBodies; ++i) {
        const Body body = bodyAt(distance, object_class, random);
        const auto object = objectOf(levelCamera(), reportOf(body, object_class, random), options);
        if (object) {
          const double own = neesOf(*object, body);
          sum += own;
          inside += own < kGate95 ? 1 : 0;
          ++reported;
        }
      }
      ASSERT_GT(reported, 0.99 * kBodies);
      const double nees = sum / reported;
      const auto what = std::string(nameOf(object_class)) + " at " + std::to_string(distance);
      EXPECT_GT(nees, 1.3) << what;
      EXPECT_LT(nees, 2.3) << what << ": no surer than reported";
      EXPECT_GT(inside, 0.94 * kBodies) << what;
    }
  }
}

TEST(ImageObject, IsAtItsBearingWithItsCovarianceAlongTheLineOfSight) {
  const auto object =
      objectOf(levelCamera(), detectionOf(ObjectClass::kPedestrian, 740.0, 195.0, 760.0, 237.5),
               ImageRangeOptions());
  ASSERT_TRUE(object);
  const Point2 position = object->box.center.position();
  EXPECT_NEAR(std::atan2(position.y(), position.x()), -std::atan(0.5), 1e-9) << "to the right";
  const Point2 ahead = position.normalized();
  const Point2 aside = perpendicular(ahead);
  const double along = ahead.dot(object->position_covariance * ahead);
  const double across = aside.dot(object->position_covariance * aside);
  EXPECT_GT(along, 10.0 * across);
  EXPECT_GT(across, 0.0);
}

TEST(ImageObject, HasItsApparentWidthAtAnyHeading) {
  for (const double heading : {0.0, 0.25 * kPi, 0.5 * kPi}) {
    const Body car{{Pose2(15.0, 3.0, heading), 4.2, 1.75}, 1.45};
    const Eigen::AlignedBox2d seen = boxInImage(levelCamera(), car.box, car.height);
    const auto object =
        objectOf(levelCamera(), {seen, ObjectClass::kVehicle, 0.9}, ImageRangeOptions());
    ASSERT_TRUE(object);
    const Eigen::Vector2d true_edges = edgesOf(car.box);
    const Eigen::Vector2d edges = edgesOf(object->box);
    EXPECT_NEAR(edges.x(), true_edges.x(), 0.02) << heading;
    EXPECT_NEAR(edges.y(), true_edges.y(), 0.02) << heading;
  }
}

TEST(ImageObject, OfAnEdgeThatTheImageCutsTheSideIsHidden) {
  const ImageDetection cut = detectionOf(ObjectClass::kVehicle, 0.0, 190.0, 150.0, 275.0);
  const auto object = objectOf(levelCamera(), cut, ImageRangeOptions());
  ASSERT_TRUE(object);
  EXPECT_EQ(object->side_variance[static_cast<std::size_t>(BoxSide::kLeft)], kHiddenSide);
  EXPECT_LT(object->side_variance[static_cast<std::size_t>(BoxSide::kRight)], 10.0);
}

TEST(ImageObject, BehindSomethingNearerASideIsHidden) {
  const ImageDetection far = detectionOf(ObjectClass::kVehicle, 400.0, 195.0, 480.0, 240.0);
  const ImageDetection near = detectionOf(ObjectClass::kVehicle, 475.0, 190.0, 700.0, 290.0);
  const std::vector<ImageDetection> both = {far, near};
  const auto behind = objectOf(levelCamera(), far, ImageRangeOptions(), both);
  ASSERT_TRUE(behind);
  EXPECT_EQ(behind->side_variance[static_cast<std::size_t>(BoxSide::kRight)], kHiddenSide);
  EXPECT_LT(behind->side_variance[static_cast<std::size_t>(BoxSide::kLeft)], 10.0);
  const auto before = objectOf(levelCamera(), near, ImageRangeOptions(), both);
  ASSERT_TRUE(before);
  EXPECT_LT(before->side_variance[static_cast<std::size_t>(BoxSide::kLeft)], 10.0);
  ImageDetection legless = far;
  legless.box.translate(Eigen::Vector2d(100.0, 0.0));
  EXPECT_FALSE(objectOf(levelCamera(), legless, ImageRangeOptions(), both)) << "no foot, no range";
}

}  // namespace
}  // namespace datmo::image_object_test
