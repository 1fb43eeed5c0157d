// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "datmo_fusion/road/border_scan.h"
#include "datmo_fusion/road/border_search.h"
#include "datmo_fusion/road/border_track.h"
#include "datmo_fusion/road/station_evidence.h"

namespace datmo {

struct FollowedBorderOptions {
  BorderTrackOptions track;
  StationEvidenceOptions evidence;
  double range_sigma = 0.2;  ///< m
  double tolerance = 0.5;    ///< m
  double correlation = 4.0;  ///< 1
  double ahead = 45.0;       ///< m
  double behind = 20.0;      ///< m
  double max_sigma = 1.0;    ///< m
  double growth = 8.0;       ///< m

  void visit(OptionVisitor& visitor);
};

/// A line that is or may be a border of the road, with the evidence along it.
class FollowedBorder {
 public:
  enum class State {
    kTrial,      ///< candidate
    kConfirmed,  ///< it is a border along some of its length
    kRefuted     ///< rejected: kept for a while so that it is not tried again at once
  };

  FollowedBorder(const FollowedBorderOptions& options, const FoundBorder& found);

  RoadSide side() const { return side_; }
  State state() const { return state_; }
  const BorderTrack& track() const { return track_; }
  const StationEvidence& evidence() const { return evidence_; }

  /// s since a scan last observed some of it.
  double unseenFor() const { return unseen_for_; }

  /// Advances the line to the next scan, and finds the positions of its beams' ends relative to it.
  void advance(const BorderScan& scan);

  /// Distance (m) from this line to the end of a beam of the current scan; infinite where there is
  /// no evidence that the line continues.
  double distanceOf(std::size_t beam) const;

  /// Whether a point (m, map frame) lies within a distance (m) of the line where it has been
  /// observed, or, if it is refuted, where it was tried.
  bool explains(const Point2& position, double distance) const;

  /// Updates the line with the scan; `is_nearest`, one for each beam: this line is the nearest of
  /// all to the beam's end.
  void update(const BorderScan& scan, const std::vector<bool>& is_nearest);

  /// Whether the line can be deleted: all of it lies behind or across the path, it is too
  /// uncertain, or it was refuted long ago.
  bool isOver(const Pose2& vehicle) const;

  /// The curve about its anchor, within the range for publishing and association.
  const CurveTable& table() const { return *table_; }

  /// Lateral standard deviation, m; where it exceeds max_sigma nothing is published.
  double sigmaAt(double along) const;

 private:
  /// Whether the end of a beam is evidence of a border: a passing mover creates no new one.
  bool informsAbout(const BorderScan::Beam& beam) const;
  /// Whether the line may continue there, at least `inside` (m) within the ends of its reach.
  bool reaches(double along, double inside = 0.0) const;
  void findReach();
  void moveAnchor(const BorderScan& scan);
  void correct(const BorderScan& scan, const std::vector<bool>& is_nearest);
  void weigh(const BorderScan& scan, const std::vector<bool>& is_nearest);
  void judge(double seconds);

  FollowedBorderOptions options_;
  RoadSide side_;
  State state_ = State::kTrial;
  BorderTrack track_;
  StationEvidence evidence_;
  double found_length_;  ///< m
  std::optional<CurveTable> table_;
  std::vector<ArcLengthInterval> reach_;  ///< m from the anchor, where the line may continue
  std::vector<CurvePoint> curve_points_;  ///< of the beams' ends of the scan
  std::vector<BorderHit> taken_;          ///< of one scan; a member to avoid reallocation
  double age_ = 0.0;  ///< s since the state (trial, confirmed, refuted) was entered
  double unseen_for_ = 0.0;
};

}  // namespace datmo
