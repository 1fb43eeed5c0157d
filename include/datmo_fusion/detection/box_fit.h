#pragma once

#include <vector>

#include "datmo_fusion/common/box2.h"

namespace datmo {

/// The rectangle that points on the near sides of an object fit best: search over headings by the
/// closeness criterion (Zhang, Xu, Dong, Dolan, Efficient L-shape fitting for vehicle detection
/// using laser scanners, 2017). It encloses all points; its heading is along the longer side, in
/// (-pi/2, pi/2]. One point: a rectangle of size 0 with heading 0. No points:
/// std::invalid_argument.
Box2 fitBox(const std::vector<Point2>& points);

}  // namespace datmo
