// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/vision/image_detector.h"

#include <algorithm>
#include <tuple>

namespace datmo {

namespace {

/// Most certain first; ties from left to right, so that the order is deterministic.
bool comesBefore(const ImageDetection& a, const ImageDetection& b) {
  const auto key = [](const ImageDetection& one) {
    return std::make_tuple(-one.score, one.box.min().x(), one.box.min().y(), one.object_class);
  };
  return key(a) < key(b);
}

}  // namespace

double overlap(const Eigen::AlignedBox2d& a, const Eigen::AlignedBox2d& b) {
  const Eigen::AlignedBox2d both = a.intersection(b);
  if (a.isEmpty() || b.isEmpty() || both.isEmpty()) {
    return 0.0;
  }
  const double either = a.volume() + b.volume() - both.volume();
  return either > 0.0 ? both.volume() / either : 0.0;
}

std::vector<ImageDetection> withoutDuplicates(std::vector<ImageDetection> detections,
                                              double max_overlap) {
  std::sort(detections.begin(), detections.end(), comesBefore);
  std::vector<ImageDetection> kept;
  for (const ImageDetection& one : detections) {
    const bool is_duplicate =
        std::any_of(kept.begin(), kept.end(), [&](const ImageDetection& surer) {
          return surer.object_class == one.object_class &&
                 overlap(surer.box, one.box) > max_overlap;
        });
    if (!is_duplicate) {
      kept.push_back(one);
    }
  }
  return kept;
}

}  // namespace datmo
