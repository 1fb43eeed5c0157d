// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/vision/class_reliability.h"
#include "datmo_fusion/vision/detection_association.h"
#include "datmo_fusion/vision/dnn_detector.h"
#include "datmo_fusion/vision/hog_detector.h"
#include "datmo_fusion/vision/image_range.h"

namespace datmo {

/// How objects and detections are combined (MonoClassifier).
enum class MonoMethod { kAssociation, kThesis };

/// OpenCV's people detector (HogDetector), or a neural network (DnnDetector).
enum class ImageDetectorKind { kHog, kDnn };

struct MonoClassifierOptions {
  MonoMethod method = MonoMethod::kAssociation;
  ImageDetectorKind detector = ImageDetectorKind::kHog;
  bool calibrated = true;
  HogDetectorOptions hog;
  DnnDetectorOptions dnn;
  ClassReliabilityOptions hog_reliability;
  ClassReliabilityOptions dnn_reliability;
  ImageRangeOptions range;
  DetectionAssociationOptions association;
  double default_height = 1.6;  ///< m
  double min_size = 0.4;        ///< m
  /// 0 to 10: standard deviations of an object's position for which its region leaves room
  double region_sigmas = 2.0;
  double min_alone = 0.6;  ///< 1
  /// 0 to 1: method thesis: a detection belongs to a rectangle if their intersection over union is
  /// larger
  double thesis_overlap = 0.4;

  MonoClassifierOptions();
  void visit(OptionVisitor& visitor);
};

/// The class of one of the scanner's objects.
struct ClassifiedObject {
  std::size_t index;  ///< in the given list
  ClassProbabilities probabilities;
};

/// Result for one image.
struct MonoClassification {
  std::vector<ClassifiedObject> classes;  ///< of the scanner's objects, by ascending index
  /// From the image alone; base frame, the exposure's stamp; no views: the search is not exhaustive
  ObjectList alone;
  std::size_t in_view = 0;     ///< scanner objects within the image
  std::size_t detections = 0;  ///< number of the detector's detections
};

/// Classifies the scanner's objects with an image (thesis 4.2.3).
///
/// association: detections in the image (ImageDetector) are associated with the objects
/// (associate), and the remaining ones become objects of their own (objectOf) if their class
/// probability is at least `min_alone`. The thesis instead places a rectangle of each class around
/// each object (`method: thesis`): the class whose rectangle contains the most certain detection is
/// chosen, and objects that the scanner does not see are ignored.
///
/// Objects from the image alone have the sensor "mono".
///
/// Not thread safe. Deterministic.
class MonoClassifier {
 public:
  /// Throws OptionError and ModelError.
  explicit MonoClassifier(const Checked<MonoClassifierOptions>& options);

  /// Uses the caller's detector; its reliability is that of the chosen one in `options`. Throws
  /// OptionError.
  MonoClassifier(const Checked<MonoClassifierOptions>& options,
                 std::unique_ptr<ImageDetector> detector);
  ~MonoClassifier();

  /// `image`: as for ImageDetector, of the camera's size (else std::invalid_argument); `objects`:
  /// base frame at the exposure, its stamp; invalid ones are ignored.
  MonoClassification classify(const cv::Mat& image, const MountedCamera& camera,
                              const ObjectList& objects);

  /// false: by its reliability the detector is no better than chance; then it is not run and
  /// nothing is found.
  bool isInformative() const;

 private:
  struct InView;

  std::vector<InView> inView(const MountedCamera& camera, const ObjectList& objects) const;
  MonoClassification byAssociation(const cv::Mat& image, const MountedCamera& camera,
                                   const std::vector<InView>& seen);
  MonoClassification asInThesis(const cv::Mat& image, const MountedCamera& camera,
                                const std::vector<InView>& seen);
  /// Adds the class, if the detection indicates one.
  void addClass(const InView& one, const ImageDetection& detection,
                MonoClassification& result) const;
  /// Class probabilities of the detected object.
  ClassProbabilities probabilities(const ImageDetection& detection) const;

  MonoClassifierOptions options_;
  ClassReliability reliability_;
  std::unique_ptr<ImageDetector> detector_;
};

}  // namespace datmo
