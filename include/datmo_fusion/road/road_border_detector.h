// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/grid/hit_grid.h"
#include "datmo_fusion/road/border_publishing.h"
#include "datmo_fusion/road/border_search.h"
#include "datmo_fusion/road/border_track_set.h"
#include "datmo_fusion/road/branch_search.h"
#include "datmo_fusion/road/intersection_detector.h"
#include "datmo_fusion/road/passage_grid.h"
#include "datmo_fusion/road/presence_history.h"
#include "datmo_fusion/road/road_model.h"
#include "datmo_fusion/road/road_opening.h"
#include "datmo_fusion/road/scan_novelty.h"
#include "datmo_fusion/road/side_streets.h"

namespace datmo {

/// Borders tracked over time, or detected in each scan independently (thesis 3.5).
enum class RoadBorderMethod { kTracked, kThesis };

struct RoadBorderDetectorOptions {
  RoadBorderDetectorOptions();

  RoadBorderMethod method = RoadBorderMethod::kTracked;
  HitGridOptions hit_grid;
  ScanNoveltyOptions novelty;
  BorderSearchOptions search;
  BorderTrackSetOptions tracks;
  PresenceHistoryOptions presence;
  PassageGridOptions passages;
  BranchSearchOptions branches;
  IntersectionDetectorOptions intersection;
  RoadOpeningOptions openings;
  SideStreetOptions side_streets;
  BorderPublishingOptions published;
  double max_gap = 2.0;    ///< s
  double max_step = 10.0;  ///< m

  void visit(OptionVisitor& visitor);
  void check() const;
};

/// Detects and tracks the road's borders in scans of a planar scanner, and detects intersections by
/// the streets that lead away (in the thesis, 3.5: by the absence of borders).
class RoadBorderDetector {
 public:
  /// Throws OptionError.
  explicit RoadBorderDetector(const Checked<RoadBorderDetectorOptions>& options);

  /// Changes what is published from the next scan on, without a reset. Throws OptionError.
  void setPublished(const Checked<BorderPublishingOptions>& options);

  /// Processes a scan and returns the road around the vehicle as known then. Stamps must rise.
  /// After a gap or a jump of the pose the state is reset first.
  const RoadModel& update(const LabeledScan& scan);

  /// Forgets everything, as after construction.
  void reset();

 private:
  /// Time since the last scan, s; none if the state is not valid for this scan.
  std::optional<double> secondsSinceLast(const LabeledScan& scan) const;
  void search(const Pose2& scanner);
  void follow(const LabeledScan& scan, double seconds);
  void lookForIntersection();

  RoadBorderDetectorOptions options_;
  HitGrid hits_;
  ScanNovelty novelty_;
  BorderSearch search_;
  BorderTrackSet tracks_;
  PresenceHistory presence_;
  PassageGrid passages_;
  BranchSearch branch_search_;
  IntersectionDetector intersection_;
  SideStreets side_streets_;
  RoadModel road_;
  std::optional<Pose2> vehicle_;  ///< map frame, at the last scan
};

}  // namespace datmo
