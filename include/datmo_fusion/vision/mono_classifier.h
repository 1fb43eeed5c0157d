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

/// How objects and what the detector reports come together (MonoClassifier).
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
  double region_sigmas = 2.0;   ///< 1
  double min_alone = 0.6;       ///< 1
  double thesis_overlap = 0.4;  ///< 1

  MonoClassifierOptions();
  void visit(OptionVisitor& visitor);
};

/// What one image led to.
struct MonoClassification {
  ObjectList list;          ///< base frame, the exposure's stamp; no views: not all is looked for
  std::size_t in_view = 0;  ///< objects of the scanner that are in the image
  std::size_t detections = 0;  ///< of the detector
  std::size_t classified = 0;  ///< of the scanner's objects, those in the list
  std::size_t alone = 0;       ///< of the list, those that the image alone has
};

/// Objects of the scanner and an image -> what they are (thesis 4.2.3).
///
/// association: a detector looks at the image (ImageDetector), what it sees is associated with the
/// objects (associate), and what is left over becomes an object by itself (objectOf) if its class
/// is as probable as `min_alone`. The thesis asks for a rectangle of each class around each object
/// instead (`method: thesis`): the class whose rectangle has the surest detection in it is taken,
/// and what the scanner does not see is not there.
///
/// An object in the list is the scanner's, with its sensors, and with a class and its probability.
/// Its position says next to nothing, and its sides nothing: they are the scanner's own, which must
/// not count twice. What the image alone has is of sensor "mono".
///
/// Not thread safe. Same input, same output.
class MonoClassifier {
 public:
  /// Throws OptionError and ModelError.
  explicit MonoClassifier(const Checked<MonoClassifierOptions>& options);

  /// With a detector of the caller's, whose scores are as reliable as `options` say of the chosen
  /// one. Throws OptionError.
  MonoClassifier(const Checked<MonoClassifierOptions>& options,
                 std::unique_ptr<ImageDetector> detector);
  ~MonoClassifier();

  /// `image`: as ImageDetector takes it, of the camera's size (else std::invalid_argument);
  /// `objects`: base frame at the exposure, its stamp; those that are not valid are left out.
  MonoClassification classify(const cv::Mat& image, const MountedCamera& camera,
                              const ObjectList& objects);

  /// false: what the detector reports is right no more often than by chance, by its reliability;
  /// then it does not look, and nothing is found.
  bool tellsAnything() const;

 private:
  struct InView;

  std::vector<InView> inView(const MountedCamera& camera, const ObjectList& objects) const;
  MonoClassification byAssociation(const cv::Mat& image, const MountedCamera& camera,
                                   const std::vector<InView>& seen);
  MonoClassification asInThesis(const cv::Mat& image, const MountedCamera& camera,
                                const std::vector<InView>& seen);
  void addClassified(const Object& object, const ImageDetection& detection,
                     MonoClassification& result) const;
  /// Class and probability of an object.
  void classify(const ImageDetection& detection, Object& object) const;

  MonoClassifierOptions options_;
  ClassReliability reliability_;
  std::unique_ptr<ImageDetector> detector_;
};

}  // namespace datmo
