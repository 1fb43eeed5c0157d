#include "datmo_fusion/road/road_border_detector.h"

namespace datmo {

void RoadBorderDetectorOptions::visit(OptionVisitor& visitor) {
  visitor.text({"method", "",
                "tracked: borders followed as clothoids over time (Kirchner and Heinrich 1998); "
                "thesis: the best window of each scan by itself (thesis 3.5)"},
               method, {"tracked", "thesis"});
}

RoadBorderDetector::RoadBorderDetector(const RoadBorderDetectorOptions& options)
    : options_(options) {
  checkOptions(options);
}

const RoadModel& RoadBorderDetector::update(const SplitScan& scan) {
  road_.stamp = scan.stamp;
  return road_;
}

void RoadBorderDetector::reset() { road_ = {}; }

}  // namespace datmo
