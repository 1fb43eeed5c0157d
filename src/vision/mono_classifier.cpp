// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/mono_classifier.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "image_check.h"
#include <opencv2/core.hpp>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/tracking/object_check.h"
#include "datmo_fusion/vision/image_region.h"

namespace datmo {

namespace {

constexpr char kSensor[] = "mono";

const std::array<ObjectClass, 3> kThesisClasses = {ObjectClass::kVehicle, ObjectClass::kCyclist,
                                                   ObjectClass::kPedestrian};

std::unique_ptr<ImageDetector> makeDetector(const MonoClassifierOptions& options) {
  if (options.detector == ImageDetectorKind::kDnn) {
    return std::make_unique<DnnDetector>(options.dnn);
  }
  return std::make_unique<HogDetector>(options.hog);
}

/// A detection of score 0 has a class, too.
constexpr double kMinScore = 1e-6;

/// m, horizontal, from the camera to the object's nearest point.
double rangeTo(const MountedCamera& camera, const Box2& box) {
  return std::max(kNearestDepth, box.distanceTo(camera.in_base.translation().head<2>()));
}

/// "Center of gravity" of an object's points (thesis 4.2.3), m; without points, that of its box.
Point2 centroidOf(const Object& object) {
  if (object.points.empty()) {
    return object.box.center.position();
  }
  const Point2 sum =
      std::accumulate(object.points.begin(), object.points.end(), Point2(Point2::Zero()));
  return sum / static_cast<double>(object.points.size());
}

/// The rectangle of one class around a position, across the line of sight, with the mean of the
/// class's length and width. None if nothing of it is in the image.
std::optional<ImageRegion> rectangleOf(const MountedCamera& camera, const Point2& position,
                                       ObjectClass object_class) {
  const ClassSize size = sizeOf(object_class);
  const Point2 to_object = position - camera.in_base.translation().head<2>();
  Object upright;
  upright.box = {Pose2(position, std::atan2(to_object.y(), to_object.x())), 0.0,
                 0.5 * (size.length + size.width)};
  upright.height = size.height;
  upright.position_covariance.setZero();
  return regionOf(camera, upright, size.height, std::numeric_limits<double>::min(), 0.0);
}

}  // namespace

struct MonoClassifier::InView {
  std::size_t index;  ///< in the scanner's list
  const Object& object;
  ImageRegion region;
};

MonoClassifierOptions::MonoClassifierOptions() {
  // Of 252 reports on objects of KITTI raw drive 0005, mostly on a cyclist, 4 were right
  // (`evaluate calibrate_classes`): it detects people, but cannot tell pedestrians from riders.
  hog_reliability.scores = {0.08, 0.43};
  hog_reliability.right = {0.034, 0.04};
}

void MonoClassifierOptions::visit(OptionVisitor& visitor) {
  visitor.choice({"method", "",
                  "association: the detector's detections are associated with the objects; thesis: "
                  "each object's rectangle is examined for each class (thesis 4.2.3)"},
                 method,
                 {{"association", MonoMethod::kAssociation}, {"thesis", MonoMethod::kThesis}});
  visitor.choice(
      {"detector", "",
       "hog: OpenCV's people detector, which needs no file; dnn: a neural network, which "
       "needs dnn/model"},
      detector, {{"hog", ImageDetectorKind::kHog}, {"dnn", ImageDetectorKind::kDnn}});
  visitor.toggle(
      {"calibrated", "",
       "off: the class and score of the detector, unchanged, for `evaluate calibrate_classes`"},
      calibrated);
  visitor.group("hog", [&] {
    hog.visit(visitor);
    visitor.group("reliability", [&] { hog_reliability.visit(visitor); });
  });
  visitor.group("dnn", [&] {
    dnn.visit(visitor);
    visitor.group("reliability", [&] { dnn_reliability.visit(visitor); });
  });
  visitor.group("range", [&] { range.visit(visitor); });
  visitor.group("association", [&] { association.visit(visitor); });
  visitor.number({"default_height", "m", "height of an object whose height is not measured"},
                 default_height, {0.1, 10.0});
  visitor.number(
      {"min_size", "m", "an object with a smaller measured size is assumed this long and wide"},
      min_size, {0.01, 10.0});
  visitor.number({"min_alone", "1",
                  "a detection from the image alone is an object if its class is at least this "
                  "probable; 1: none is"},
                 min_alone, {0.0, 1.0});
}

MonoClassifier::MonoClassifier(const Checked<MonoClassifierOptions>& options)
    : MonoClassifier(options, makeDetector(*options)) {}

MonoClassifier::MonoClassifier(const Checked<MonoClassifierOptions>& options,
                               std::unique_ptr<ImageDetector> detector)
    : options_(*options),
      reliability_(options->detector == ImageDetectorKind::kDnn ? options->dnn_reliability
                                                                : options->hog_reliability),
      detector_(std::move(detector)) {}

MonoClassifier::~MonoClassifier() = default;

MonoClassification MonoClassifier::classify(const cv::Mat& image, const MountedCamera& camera,
                                            const ObjectList& objects) {
  checkSize(image, camera);
  const std::vector<InView> seen = inView(camera, objects);
  MonoClassification result;
  if (isInformative()) {
    result = options_.method == MonoMethod::kThesis ? asInThesis(image, camera, seen)
                                                    : byAssociation(image, camera, seen);
  }
  result.alone.stamp = objects.stamp;
  result.in_view = seen.size();
  return result;
}

bool MonoClassifier::isInformative() const {
  return !options_.calibrated || reliability_.isInformative();
}

std::vector<MonoClassifier::InView> MonoClassifier::inView(const MountedCamera& camera,
                                                           const ObjectList& objects) const {
  std::vector<InView> seen;
  for (std::size_t i = 0; i < objects.objects.size(); ++i) {
    const Object& object = objects.objects[i];
    if (!isValid(object)) {
      continue;
    }
    if (const auto region = regionOf(camera, object, options_.default_height, options_.min_size,
                                     options_.region_sigmas)) {
      seen.push_back({i, object, *region});
    }
  }
  return seen;
}

MonoClassification MonoClassifier::byAssociation(const cv::Mat& image, const MountedCamera& camera,
                                                 const std::vector<InView>& seen) {
  std::vector<ImageRegion> regions;
  std::vector<ProjectedObject> projected;
  for (const InView& one : seen) {
    regions.push_back(one.region);
    projected.push_back({one.region, rangeTo(camera, one.object.box),
                         std::sqrt(0.5 * one.object.position_covariance.trace())});
  }
  const std::vector<ImageDetection> detections = detector_->detect(image, regions);
  const auto matches =
      associate(projected, detections, camera, options_.range, options_.association);
  MonoClassification result;
  result.detections = detections.size();
  std::vector<bool> is_matched(detections.size(), false);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (matches[i]) {
      is_matched[*matches[i]] = true;
      addClass(seen[i], detections[*matches[i]], result);
    }
  }
  for (std::size_t i = 0; i < detections.size(); ++i) {
    auto alone =
        is_matched[i] ? std::nullopt : objectOf(camera, detections[i], options_.range, detections);
    if (!alone) {
      continue;
    }
    alone->sensors = {kSensor};
    alone->class_probabilities = probabilities(detections[i]);
    const ObjectClass most_likely = alone->objectClass();
    if (most_likely != ObjectClass::kUnknown &&
        probabilityOf(most_likely, alone->class_probabilities) >= options_.min_alone) {
      result.alone.objects.push_back(std::move(*alone));
    }
  }
  return result;
}

MonoClassification MonoClassifier::asInThesis(const cv::Mat& image, const MountedCamera& camera,
                                              const std::vector<InView>& seen) {
  struct Rectangle {
    std::size_t object;
    ObjectClass object_class;
    ImageRegion region;
  };
  std::vector<Rectangle> rectangles;
  std::vector<ImageRegion> regions;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (const ObjectClass object_class : kThesisClasses) {
      if (const auto region = rectangleOf(camera, centroidOf(seen[i].object), object_class)) {
        rectangles.push_back({i, object_class, *region});
        regions.push_back(*region);
      }
    }
  }
  const std::vector<ImageDetection> detections = detector_->detect(image, regions);
  std::vector<const ImageDetection*> best(seen.size(), nullptr);
  for (const Rectangle& rectangle : rectangles) {
    const ImageDetection*& surest = best[rectangle.object];
    for (const ImageDetection& one : detections) {
      if (one.object_class == rectangle.object_class &&
          overlap(one.box, rectangle.region.box) > options_.thesis_overlap &&
          (surest == nullptr || one.score > surest->score)) {
        surest = &one;
      }
    }
  }
  MonoClassification result;
  result.detections = detections.size();
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (best[i] != nullptr) {
      addClass(seen[i], *best[i], result);
    }
  }
  return result;
}

void MonoClassifier::addClass(const InView& one, const ImageDetection& detection,
                              MonoClassification& result) const {
  const ClassProbabilities found = probabilities(detection);
  if (mostLikelyClass(found) != ObjectClass::kUnknown) {
    result.classes.push_back({one.index, found});
  }
}

ClassProbabilities MonoClassifier::probabilities(const ImageDetection& detection) const {
  if (options_.calibrated) {
    return reliability_.probabilities(detection.object_class, detection.score);
  }
  return reportedClass(detection.object_class, std::clamp(detection.score, kMinScore, 1.0));
}

}  // namespace datmo
