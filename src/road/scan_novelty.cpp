// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/scan_novelty.h"

#include <cmath>

namespace datmo {

void ScanNoveltyOptions::visit(OptionVisitor& visitor) {
  visitor.number({"correlation_length", "m",
                  "distance that the scanner moves until the correlation of two scans falls to "
                  "1/e: the unevenness of curbs and parked cars"},
                 correlation_length, {0.01, 10.0});
  visitor.number(
      {"correlation_time", "s",
       "the same for the time between two scans from one position: the surroundings change"},
      correlation_time, {0.1, 1000.0});
}

double ScanNovelty::update(const Point2& scanner, double seconds) {
  const std::optional<Point2> before = last_;
  last_ = scanner;
  if (!before) {
    return 1.0;
  }
  const double apart = (scanner - *before).norm() / options_.correlation_length +
                       seconds / options_.correlation_time;
  return -std::expm1(-2.0 * apart);
}

}  // namespace datmo
