// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "datmo_fusion/common/object.h"

namespace datmo {

/// Draws a pictogram of a road user's class, a person, a cyclist, a car or a pole, in a square of a
/// bgr8 image (thesis 4.2.5); nothing for an unknown class. `frame`: px, at least 5 x 5.
void drawClassIcon(ObjectClass object_class, const cv::Rect& frame, const cv::Scalar& color,
                   cv::Mat& canvas);

}  // namespace datmo
