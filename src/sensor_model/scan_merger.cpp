// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/scan_merger.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "datmo_fusion/common/angle.h"

namespace datmo {

namespace {

constexpr float kNothingThere = std::numeric_limits<float>::infinity();
constexpr float kNotMeasured = std::numeric_limits<float>::quiet_NaN();

/// Sets a range if none was measured there, or a farther one.
void put(float range, float& slot) {
  if (std::isnan(slot) || range < slot) {
    slot = range;
  }
}

/// Angle from one bearing counterclockwise to another, rad, 0 to a full turn.
double leftTurn(double from, double to) {
  const double turn = normalizeAngle(to - from);
  return turn < 0.0 ? turn + kTurn : turn;
}

bool isIn(double bearing, double from, double to) {
  return leftTurn(from, bearing) <= leftTurn(from, to);
}

/// Range (m) from the origin, in a direction, to the line through two points.
double rangeToLine(const Point2& a, const Point2& b, double bearing) {
  const Point2 across(-(b - a).y(), (b - a).x());
  const Point2 direction(std::cos(bearing), std::sin(bearing));
  return across.dot(a) / across.dot(direction);
}

/// Whether the scan's last beam and its first one are neighbors, as in a scan all around.
bool closesTurn(const Scan& scan) {
  const ScanField& field = scan.field;
  const double missing = kTurn - field.beams * std::abs(field.beam_spacing);
  return scan.rays.size() > 1 && scan.rays.front().beam == 0 &&
         scan.rays.back().beam + 1 == field.beams &&
         std::abs(missing) < std::abs(field.beam_spacing);
}

}  // namespace

void ScanMergerOptions::visit(OptionVisitor& visitor) {
  visitor.number(
      {"beam_spacing", "rad", "spacing of the merged scan's beams; about that of the scanners"},
      beam_spacing, {0.001, 0.1});
  visitor.number({"max_range", "m", "range of the merged scan"}, max_range, {1.0, 500.0});
  visitor.number(
      {"surface_gap", "m",
       "end points of neighboring beams that are closer to each other lie on one surface"},
      surface_gap, {0.0, 10.0});
}

Scan withoutSectors(Scan scan, const std::vector<double>& sectors) {
  const auto is_blind = [&sectors](const Ray& ray) {
    for (std::size_t i = 0; i + 1 < sectors.size(); i += 2) {
      if (isIn(ray.bearing, sectors[i], sectors[i + 1])) {
        return true;
      }
    }
    return false;
  };
  scan.rays.erase(std::remove_if(scan.rays.begin(), scan.rays.end(), is_blind), scan.rays.end());
  return scan;
}

ScanMerger::ScanMerger(const Checked<ScanMergerOptions>& options)
    : options_(*options), beams_(static_cast<std::size_t>(kTurn / options->beam_spacing)) {}

double ScanMerger::beamSpacing() const { return kTurn / static_cast<double>(beams_); }

std::size_t ScanMerger::beamAt(const Point2& point) const {
  const double beam = std::round((std::atan2(point.y(), point.x()) + kPi) / beamSpacing());
  return static_cast<std::size_t>(beam) % beams_;
}

std::vector<float> ScanMerger::ranges(const std::vector<Scan>& scans) const {
  std::vector<float> ranges(beams_, kNotMeasured);
  for (const Scan& scan : scans) {
    for (std::size_t i = 0; i < scan.rays.size(); ++i) {
      addEnd(scan.rays[i], ranges);
      if (i + 1 < scan.rays.size() && scan.rays[i + 1].beam == scan.rays[i].beam + 1) {
        fillBetween(scan.rays[i], scan.rays[i + 1], ranges);
      }
    }
    if (closesTurn(scan)) {
      fillBetween(scan.rays.back(), scan.rays.front(), ranges);
    }
  }
  return ranges;
}

void ScanMerger::addEnd(const Ray& ray, std::vector<float>& ranges) const {
  const double range = ray.end.norm();
  const bool is_hit = ray.hit && range <= options_.max_range;
  put(is_hit ? static_cast<float>(range) : kNothingThere, ranges[beamAt(ray.end)]);
}

void ScanMerger::fillBetween(const Ray& ray, const Ray& next, std::vector<float>& ranges) const {
  const bool is_surface =
      ray.hit && next.hit && (next.end - ray.end).norm() <= options_.surface_gap;
  if (!is_surface && (ray.hit || next.hit)) {
    return;
  }
  const double turn =
      normalizeAngle(std::atan2(next.end.y(), next.end.x()) - std::atan2(ray.end.y(), ray.end.x()));
  const Ray& right = turn < 0.0 ? next : ray;
  const Ray& left = turn < 0.0 ? ray : next;
  const std::size_t end = beamAt(left.end);
  const std::size_t first = beamAt(right.end);
  for (std::size_t beam = first == end ? end : (first + 1) % beams_; beam != end;
       beam = (beam + 1) % beams_) {
    const double bearing = -kPi + static_cast<double>(beam) * beamSpacing();
    const double range = is_surface ? rangeToLine(right.end, left.end, bearing) : 0.0;
    const bool is_hit = is_surface && range > 0.0 && range <= options_.max_range;
    put(is_hit ? static_cast<float>(range) : kNothingThere, ranges[beam]);
  }
}

}  // namespace datmo
