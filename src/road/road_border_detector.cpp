// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/road/road_border_detector.h"

#include <algorithm>
#include <utility>

#include "datmo_fusion/road/border_scan.h"

namespace datmo {

namespace {

/// A found border as a published one, with the uncertainty of its fitted line.
RoadBorder borderOf(const FoundBorder& found, double spacing) {
  RoadBorder border;
  border.side = found.side;
  border.probability = 1.0;
  border.points = pointsOf(found, spacing);
  return border;
}

/// Whether a border runs from behind the vehicle to ahead of it.
bool hasBorderBeside(const std::vector<RoadBorder>& borders, const Pose2& vehicle) {
  const Pose2 map_in_base = vehicle.inverse();
  return std::any_of(borders.begin(), borders.end(), [&](const RoadBorder& border) {
    return (map_in_base * border.points.front().position).x() <= 0.0 &&
           (map_in_base * border.points.back().position).x() >= 0.0;
  });
}

}  // namespace

RoadBorderDetectorOptions::RoadBorderDetectorOptions() {
  // Less than in the thesis: false borders are refuted by the beams that pass through them.
  hit_grid.cut_share = 0.05;
}

void RoadBorderDetectorOptions::visit(OptionVisitor& visitor) {
  visitor.choice({"method", "",
                  "tracked: borders tracked as clothoids over time (Kirchner and Heinrich 1998); "
                  "thesis: the best window of each scan by itself (thesis 3.5)"},
                 method,
                 {{"tracked", RoadBorderMethod::kTracked}, {"thesis", RoadBorderMethod::kThesis}});
  visitor.group("hit_grid", [&] { hit_grid.visit(visitor); });
  visitor.group("novelty", [&] { novelty.visit(visitor); });
  visitor.group("search", [&] { search.visit(visitor); });
  visitor.group("tracks", [&] { tracks.visit(visitor); });
  visitor.group("presence", [&] { presence.visit(visitor); });
  visitor.group("passages", [&] { passages.visit(visitor); });
  visitor.group("branches", [&] { branches.visit(visitor); });
  visitor.group("intersection", [&] { intersection.visit(visitor); });
  visitor.group("openings", [&] { openings.visit(visitor); });
  visitor.group("side_streets", [&] { side_streets.visit(visitor); });
  visitor.group("published", [&] { published.visit(visitor); });
  visitor.number(
      {"max_gap", "s", "time between two scans; after a longer gap all state is forgotten"},
      max_gap, {0.01, 1000.0});
  visitor.number({"max_step", "m",
                  "distance of the vehicle between two scans; after a longer one, a jump of the "
                  "map, all state is forgotten"},
                 max_step, {0.1, 1000.0});
}

void RoadBorderDetectorOptions::check() const {
  const StationEvidenceOptions& evidence = tracks.border.evidence;
  if (evidence.hit_probability <= evidence.clutter) {
    throw OptionError(
        "tracks/border/evidence/hit_probability = " + std::to_string(evidence.hit_probability) +
        ": expected more than clutter (" + std::to_string(evidence.clutter) + ")");
  }
  const double min_window = 2.0 * (branches.length + branches.max_shift);
  const double window = std::min(passages.window.length, passages.window.width);
  if (window < min_window) {
    throw OptionError("passages/window: length and width " + std::to_string(window) +
                      " m: expected " + std::to_string(min_window) +
                      " m or more, for streets of branches/length on both sides");
  }
}

RoadBorderDetector::RoadBorderDetector(const Checked<RoadBorderDetectorOptions>& options)
    : options_(*options),
      hits_(options->hit_grid),
      novelty_(options->novelty),
      search_(options->search),
      tracks_(options->tracks),
      presence_(options->presence),
      passages_(options->passages),
      branch_search_(options->branches),
      intersection_(options->intersection),
      side_streets_(options->side_streets) {}

void RoadBorderDetector::setPublished(const Checked<BorderPublishingOptions>& options) {
  options_.published = *options;
}

std::optional<double> RoadBorderDetector::secondsSinceLast(const LabeledScan& scan) const {
  if (!vehicle_) {
    return std::nullopt;
  }
  const double seconds = secondsBetween(road_.stamp, scan.stamp);
  const double step = (scan.base_in_map.pose.position() - vehicle_->position()).norm();
  const bool belongs = seconds >= 0.0 && seconds <= options_.max_gap && step <= options_.max_step;
  return belongs ? std::make_optional(seconds) : std::nullopt;
}

const RoadModel& RoadBorderDetector::update(const LabeledScan& scan) {
  const std::optional<double> seconds = secondsSinceLast(scan);
  if (!seconds) {
    reset();
  }
  road_.stamp = scan.stamp;
  vehicle_ = scan.base_in_map.pose;
  hits_.update(scan);
  if (options_.method == RoadBorderMethod::kThesis) {
    search(*vehicle_ * scan.scanner_in_base);
  } else {
    follow(scan, seconds.value_or(0.0));
  }
  return road_;
}

void RoadBorderDetector::search(const Pose2& scanner) {
  road_.borders.clear();
  for (const RoadSide side : {RoadSide::kLeft, RoadSide::kRight}) {
    if (const auto found = search_.search(hits_, scanner, side)) {
      road_.borders.push_back(borderOf(*found, options_.published.spacing));
    }
  }
  road_.at_intersection = road_.borders.empty();
  road_.intersection_probability = road_.at_intersection ? 1.0 : 0.0;
}

void RoadBorderDetector::follow(const LabeledScan& scan, double seconds) {
  BorderScan seen = borderScan(scan, hits_, seconds);
  seen.novelty = novelty_.update(seen.scanner.position(), seconds);
  passages_.update(seen);
  tracks_.update(seen, hits_, search_);
  road_.borders = publishedBorders(tracks_.borders(), *vehicle_, options_.published);
  presence_.update(tracks_.borders(), *vehicle_, seconds);
  lookForIntersection();
  side_streets_.update(
      hits_, openingsOf(presence_.presence(), road_.borders, *vehicle_, options_.openings),
      scan.stamp);
  for (RoadBorder& border : side_streets_.borders(scan.stamp)) {
    road_.borders.push_back(std::move(border));
  }
  road_.intersection_probability = intersection_.probability();
  road_.at_intersection = intersection_.atIntersection();
}

void RoadBorderDetector::lookForIntersection() {
  const double arc_length = presence_.presence().arc_length;
  if (intersection_.isDue(arc_length)) {
    // Independent of the users' settings for publishing them.
    const auto borders = publishedBorders(tracks_.borders(), *vehicle_, BorderPublishingOptions());
    const auto branches = branch_search_.search(passages_, vehicle_->position());
    intersection_.update(
        {arc_length, hasBorderBeside(borders, *vehicle_), static_cast<int>(branches.size())});
  }
}

void RoadBorderDetector::reset() {
  hits_.reset();
  novelty_.reset();
  tracks_.clear();
  presence_.reset();
  passages_.reset();
  intersection_.reset();
  side_streets_.reset();
  road_ = {};
  vehicle_.reset();
}

}  // namespace datmo
