// SPDX-License-Identifier: BSD-3-Clause
#include "simulator/sloped_ray.h"

namespace datmo::simulator {

std::optional<RayEnd> endOf(const SlopedRay& line, const std::vector<Passage>& passages) {
  std::optional<RayEnd> nearest;
  double reach = line.reach;
  const auto add = [&](const RayEnd& end) {
    if (end.range <= reach) {
      nearest = end;
      reach = end.range;
    }
  };
  if (line.fall > 0.0) {
    add({line.height / line.fall, 0.0, nullptr});
  }
  for (const Passage& passage : passages) {
    if (passage.span.enter > reach) {
      break;
    }
    const double height = line.height - line.fall * passage.span.enter;
    const double top = passage.solid->height;
    if (height <= top) {
      add({passage.span.enter, height, passage.solid});
    } else if (line.height - line.fall * passage.span.leave < top) {
      add({(line.height - top) / line.fall, top, passage.solid});
    }
  }
  return nearest;
}

}  // namespace datmo::simulator
