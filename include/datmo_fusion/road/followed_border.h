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

/// One line that is or may be a border of the road, with what is known of where it is one.
class FollowedBorder {
 public:
  enum class State {
    kTrial,      ///< it may be one
    kConfirmed,  ///< it is one, somewhere
    kRefuted     ///< it was none: kept for a time, so that it is not tried again at once
  };

  FollowedBorder(const FollowedBorderOptions& options, const FoundBorder& found);

  RoadSide side() const { return side_; }
  State state() const { return state_; }
  const BorderTrack& track() const { return track_; }
  const StationEvidence& evidence() const { return evidence_; }

  /// s since a scan last saw some of it.
  double unseenFor() const { return unseen_for_; }

  /// Takes the line on to the next scan, and finds where its beams end beside it.
  void advance(const BorderScan& scan);

  /// How far off (m) this line is from the end of a beam of the scan that it was advanced to;
  /// infinite where nothing says that it goes on there.
  double distanceOf(std::size_t beam) const;

  /// Whether a point (m, map frame) lies within a distance (m) of the line where something has been
  /// seen of it, or where it was tried if it is refuted.
  bool explains(const Point2& position, double distance) const;

  /// Updates the line with the scan; `is_nearest`, one for each beam: of all lines this
  /// one is nearest to the beam's end.
  void update(const BorderScan& scan, const std::vector<bool>& is_nearest);

  /// Whether it is of no use any more: all of it lies behind or across the path, it is too unsure,
  /// or it has been refuted for long.
  bool isOver(const Pose2& vehicle) const;

  /// The curve about its anchor, where it may be published or looked at.
  const CurveTable& table() const { return *table_; }

  /// m across; where it is more than max_sigma nothing is published.
  double sigmaAt(double along) const;

 private:
  /// Whether the line may go on there, `inside` (m) within the ends of where it may at all.
  /// Whether the end of a beam is evidence of a border: what passes by makes no new one.
  bool informsAbout(const BorderScan::Beam& beam) const;
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
  std::vector<ArcLengthInterval> reach_;  ///< m from the anchor, where the line may go on
  std::vector<CurvePoint> curve_points_;  ///< of the ends of the scan's beams
  std::vector<BorderHit> taken_;          ///< of one scan; a member to spare memory
  double age_ = 0.0;                      ///< s in the state
  double unseen_for_ = 0.0;
};

}  // namespace datmo
