// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/followed_border.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "datmo_fusion/common/cross.h"
#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// Minimum smoothed hits of a cell (thesis eq. 3.5.1) for a hit to correct a border: passing movers
/// leave fewer.
constexpr int kVouchingHits = 3;

/// Length of observed stations that confirms a line as a border, m.
constexpr double kConfirmedLength = 6.0;

/// A line is corrected up to this far beyond its observed part; at most `growth`, m.
constexpr double kFittedGrowth = 3.0;

/// A beam that ends this far beyond the line looks into a street: house fronts are closer, m.
constexpr double kStreetDepth = 8.0;

/// A beam that crosses a line closer to the scanner may pass over something low: a curb, m.
constexpr double kPassageFrom = 8.0;

/// Time in which a candidate line must be confirmed, s.
constexpr double kTrialTime = 1.0;

/// Time for which a refuted line is not tried again, s.
constexpr double kRefutedTime = 2.0;

/// Standard deviation of objects along a border from its line, m.
constexpr double kRoughness = 0.15;

/// rad; a line at a larger angle to the vehicle's heading is not a border of its road.
constexpr double kAcross = degrees(60.0);

/// m ahead or behind; this close to the vehicle no bend moves a border to the other side.
constexpr double kBeside = 10.0;

double clampTo(const ArcLengthInterval& interval, double arc_length) {
  return std::clamp(arc_length, interval.first, interval.last);
}

/// The arc length in the sections that is nearest to this one.
double nearestOf(const std::vector<ArcLengthInterval>& pieces, double arc_length) {
  double nearest = arc_length;
  double min = std::numeric_limits<double>::infinity();
  for (const ArcLengthInterval& piece : pieces) {
    const double candidate = clampTo(piece, arc_length);
    if (std::abs(candidate - arc_length) < min) {
      min = std::abs(candidate - arc_length);
      nearest = candidate;
    }
  }
  return nearest;
}

}  // namespace

void FollowedBorderOptions::visit(OptionVisitor& visitor) {
  visitor.group("track", [&] { track.visit(visitor); });
  visitor.group("evidence", [&] { evidence.visit(visitor); });
  visitor.number({"range_sigma", "m", "noise of a measured range"}, range_sigma, {0.0, 2.0});
  visitor.number(
      {"tolerance", "m", "distance from the line within which a beam that ends has hit the border"},
      tolerance, {0.05, 5.0});
  visitor.number({"correlation", "1",
                  "number of scans of a moving vehicle that see the same unevenness of a border: "
                  "their hits count as those of one scan"},
                 correlation, {1.0, 100.0});
  visitor.number({"ahead", "m", "how far ahead of the vehicle borders are tracked"}, ahead,
                 {5.0, 200.0});
  visitor.number({"behind", "m", "how far behind the vehicle they are kept"}, behind, {0.0, 200.0});
  visitor.number({"max_sigma", "m",
                  "lateral standard deviation above which a part of a line is not published, and "
                  "above which a whole line is dropped"},
                 max_sigma, {0.1, 10.0});
  visitor.number(
      {"growth", "m",
       "distance beyond the observed pieces of a line within which hits may belong to it"},
      growth, {0.0, 50.0});
}

FollowedBorder::FollowedBorder(const FollowedBorderOptions& options, const FoundBorder& found)
    : options_(options),
      side_(found.side),
      track_(options.track, found.line, found.covariance),
      evidence_(options.evidence),
      found_length_(found.length) {
  table_.emplace(track_.curve(), -options_.behind, options_.ahead);
  findReach();
}

double FollowedBorder::sigmaAt(double along) const {
  return std::sqrt(std::max(0.0, track_.varianceAt(along)));
}

bool FollowedBorder::informsAbout(const BorderScan::Beam& beam) const {
  return beam.lasting || state_ == State::kConfirmed;
}

void FollowedBorder::advance(const BorderScan& scan) {
  if (state_ == State::kRefuted) {
    return;
  }
  moveAnchor(scan);
  findReach();
  curve_points_.clear();
  for (const BorderScan::Beam& beam : scan.beams) {
    curve_points_.push_back(table_->locate(beam.end));
  }
}

void FollowedBorder::findReach() {
  reach_.clear();
  for (const ArcLengthInterval& piece : evidence_.pieces()) {
    reach_.push_back({piece.first - track_.arcLength() - options_.growth,
                      piece.last - track_.arcLength() + options_.growth});
  }
  if (state_ == State::kTrial) {
    const double margin = std::max(0.0, options_.growth - kFittedGrowth);
    reach_.push_back({-track_.arcLength() - margin, found_length_ - track_.arcLength() + margin});
  }
}

bool FollowedBorder::reaches(double along, double inside) const {
  return std::any_of(reach_.begin(), reach_.end(), [&](const ArcLengthInterval& piece) {
    return along >= piece.first + inside && along <= piece.last - inside;
  });
}

double FollowedBorder::distanceOf(std::size_t beam) const {
  const bool here = state_ != State::kRefuted && reaches(curve_points_[beam].along);
  return here ? std::abs(curve_points_[beam].aside) : std::numeric_limits<double>::infinity();
}

bool FollowedBorder::explains(const Point2& position, double distance) const {
  const CurvePoint beside = table_->locate(position);
  return std::abs(beside.aside) <= distance && reaches(beside.along);
}

void FollowedBorder::update(const BorderScan& scan, const std::vector<bool>& is_nearest) {
  if (state_ != State::kRefuted) {
    correct(scan, is_nearest);
    table_.emplace(track_.curve(), -options_.behind, options_.ahead);
    weigh(scan, is_nearest);
  }
  judge(scan.seconds);
}

void FollowedBorder::moveAnchor(const BorderScan& scan) {
  const double foot = track_.arcLength() + table_->locate(scan.scanner.position()).along;
  // Where nothing was observed the line is only an extrapolation.
  const double arc_length = std::max(nearestOf(evidence_.pieces(), foot), foot - options_.behind);
  const double step = std::clamp(arc_length - track_.arcLength(), table_->first(), table_->last());
  track_.advance(step, scan.seconds);
  table_.emplace(track_.curve(), -options_.behind, options_.ahead);
  evidence_.keepWithin({foot - options_.behind, foot + options_.ahead});
}

void FollowedBorder::correct(const BorderScan& scan, const std::vector<bool>& is_nearest) {
  taken_.clear();
  const double unfitted = std::max(0.0, options_.growth - kFittedGrowth);
  for (std::size_t i = 0; i < scan.beams.size(); ++i) {
    const BorderScan::Beam& beam = scan.beams[i];
    const CurvePoint& position = curve_points_[i];
    if (!beam.hit || !beam.lasting || beam.hits_there < kVouchingHits || !is_nearest[i] ||
        std::abs(position.aside) > options_.tolerance || !reaches(position.along, unfitted)) {
      continue;
    }
    const Point2 line = table_->at(position.along).rotate(Point2(1.0, 0.0));
    const Point2 ray = (beam.end - scan.scanner.position()).normalized();
    const double across = cross(line, ray);
    const double variance = square(options_.range_sigma * across) + square(kRoughness);
    taken_.push_back({position, options_.correlation * variance});
  }
  track_.correct(taken_, scan.novelty);
}

void FollowedBorder::weigh(const BorderScan& scan, const std::vector<bool>& is_nearest) {
  const double outward = outwardOf(side_, 1.0);
  const Point2 from = scan.scanner.position();
  const double from_outward = outward * table_->locate(from).aside;
  bool seen = false;
  for (std::size_t i = 0; i < scan.beams.size(); ++i) {
    const BorderScan::Beam& beam = scan.beams[i];
    const CurvePoint& end = curve_points_[i];
    const double end_outward = outward * end.aside;
    if (beam.hit && std::abs(end_outward) <= options_.tolerance) {
      if (is_nearest[i] && informsAbout(beam) && sigmaAt(end.along) <= options_.max_sigma) {
        evidence_.addHit(track_.arcLength() + end.along);
        evidence_.addDepth(track_.arcLength() + end.along, false);
        seen = true;
      }
    } else if (end_outward > options_.tolerance && from_outward < 0.0) {
      const double share = from_outward / (from_outward - end_outward);
      const Point2 crossing = from + share * (beam.end - from);
      const double along = table_->locate(crossing).along;
      if (sigmaAt(along) <= options_.max_sigma) {
        if ((crossing - from).norm() >= kPassageFrom) {
          evidence_.addPassage(track_.arcLength() + along);
        }
        const bool deep = end_outward > kStreetDepth;
        // Where a beam passed through, what it hits far along the line at a shallow angle is not
        // its border.
        if (deep || std::abs(end.along - along) < options_.growth) {
          evidence_.addDepth(track_.arcLength() + along, deep);
        }
      }
    }
  }
  evidence_.endScan();
  unseen_for_ = seen ? 0.0 : unseen_for_ + scan.seconds;
}

void FollowedBorder::judge(double seconds) {
  age_ += seconds;
  State next = state_;
  if (state_ == State::kTrial) {
    if (evidence_.seenStations() >= kConfirmedLength) {
      next = State::kConfirmed;
    } else if (age_ > kTrialTime) {
      next = State::kRefuted;
    }
  } else if (state_ == State::kConfirmed && evidence_.seenStations() == 0) {
    next = State::kRefuted;
  }
  if (next != state_) {
    state_ = next;
    age_ = 0.0;
  }
}

bool FollowedBorder::isOver(const Pose2& vehicle) const {
  if (state_ == State::kRefuted) {
    return age_ > kRefutedTime;
  }
  const CurvePoint position = table_->locate(vehicle.position());
  const double nearest =
      nearestOf(evidence_.pieces(), track_.arcLength() + position.along) - track_.arcLength();
  if (track_.varianceAt(nearest) > square(options_.max_sigma)) {
    return true;
  }
  const Pose2 seen = vehicle.inverse() * table_->at(nearest);
  const bool behind = seen.x() < -options_.behind;
  const bool across = std::abs(seen.heading()) > kAcross;
  const double outward = outwardOf(side_, seen.y());
  const bool crossed = outward < 0.0 && std::abs(seen.x()) < kBeside;
  return behind || across || crossed;
}

}  // namespace datmo
