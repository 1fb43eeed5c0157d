// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/visibility/scan_history.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/cross.h"
#include "datmo_fusion/common/perpendicular.h"
#include "datmo_fusion/common/square.h"
#include "datmo_fusion/visibility/beam_fan.h"

namespace datmo {

namespace {

/// rad; tolerance of an end point's bearing: noise, pitch and roll of the body, pose error.
constexpr double kBearingTolerance = 0.005;

}  // namespace

void ScanHistoryOptions::visit(OptionVisitor& visitor) {
  visitor.number({"memory", "s", "how far back scans are kept"}, memory, {0.1, 60.0});
  visitor.integer({"max_scans", "1", "and at most how many scans"}, max_scans, {1, 10000});
  visitor.number({"tolerance", "m",
                  "a beam that ends closer to the line through a point than this has hit it: twice "
                  "the standard deviation of the range"},
                 tolerance, {0.05, 5.0});
  visitor.number({"lit_share", "1",
                  "share of the angle between two beams that a beam covers: a point outside of it "
                  "is not seen as free"},
                 lit_share, {0.05, 1.0});
  visitor.number({"min_incidence", "rad", "smallest angle of incidence of a beam on a line"},
                 min_incidence, {0.001, 1.0});
}

ScanHistory::ScanHistory(const Checked<ScanHistoryOptions>& options) : options_(*options) {}

void ScanHistory::add(const LabeledScan& scan) {
  Scan seen;
  seen.stamp = scan.stamp;
  const Pose2 scanner_in_map = scan.base_in_map.pose * scan.scanner_in_base;
  seen.scanner = scanner_in_map.position();
  seen.map_in_scanner = scanner_in_map.inverse();
  seen.field = scan.field;
  seen.beams.assign(scan.field.beams, {static_cast<float>(scan.field.free_range), false});
  for (const std::uint32_t beam : scan.blind_beams) {
    if (beam < seen.beams.size()) {
      seen.beams[beam] = {};
    }
  }
  seen.ends.reserve(scan.points.size());
  for (const ScanPoint& point : scan.points) {
    seen.ends.push_back(scan.base_in_map.pose * point.position);
    if (point.beam < seen.beams.size()) {
      seen.beams[point.beam] = {static_cast<float>(point.range), true};
    }
  }
  scans_.push_front(std::move(seen));
  while (scans_.size() > static_cast<std::size_t>(options_.max_scans) ||
         age(scans_.size() - 1) > options_.memory) {
    scans_.pop_back();
  }
}

double ScanHistory::age(std::size_t back) const {
  return secondsBetween(scans_[back].stamp, scans_.front().stamp);
}

/// The beam that covers a point (m, scanner's frame), and its bearing; null if there is none.
const ScanHistory::Beam* ScanHistory::beamToward(const Scan& scan, const Point2& seen,
                                                 double& bearing) const {
  const ScanField& field = scan.field;
  if (scan.beams.empty() || field.beam_spacing == 0.0 || seen.norm() <= field.min_range) {
    return nullptr;
  }
  const BeamFan fan(field.first_bearing, field.beam_spacing);
  const double position = fan.positionAt(std::atan2(seen.y(), seen.x()));
  const auto nearest = fan.nearest(position, scan.beams.size());
  // Written so that NaN, from a point at infinity, is excluded.
  if (!nearest ||
      !(std::abs(static_cast<double>(*nearest) - position) <= 0.5 * options_.lit_share)) {
    return nullptr;
  }
  bearing = fan.bearingAt(static_cast<double>(*nearest));
  return &scan.beams[*nearest];
}

std::optional<std::size_t> ScanHistory::beamIndex(std::size_t back, const Point2& position) const {
  const Scan& scan = scans_[back];
  double bearing = 0.0;
  const Beam* beam = beamToward(scan, scan.map_in_scanner * position, bearing);
  return beam ? std::make_optional(static_cast<std::size_t>(beam - scan.beams.data()))
              : std::nullopt;
}

bool ScanHistory::endsAt(std::size_t back, const Point2& position) const {
  const std::vector<Point2>& ends = scans_[back].ends;
  return std::any_of(ends.begin(), ends.end(), [&](const Point2& end) {
    return (end - position).squaredNorm() <= square(options_.tolerance);
  });
}

BeamCrossing ScanHistory::look(std::size_t back, const ReflectionPoint& location) const {
  const Scan& scan = scans_[back];
  const Point2 seen = scan.map_in_scanner * location.position;
  double bearing = 0.0;
  const Beam* beam = beamToward(scan, seen, bearing);
  if (beam == nullptr) {
    return {};
  }
  const Point2 along_beam(std::cos(bearing), std::sin(bearing));
  const Point2 direction = location.direction.isZero()
                               ? perpendicular(along_beam)
                               : scan.map_in_scanner.rotate(location.direction);
  const double incidence = cross(along_beam, direction);
  if (std::abs(incidence) < std::sin(options_.min_incidence)) {
    return {};
  }
  const double crossing = cross(seen, direction) / incidence;
  if (crossing <= 0.0) {
    return {};  // the beam beside the point diverges from the line
  }
  // At grazing incidence a small bearing error moves the intersection far.
  const double tolerance = options_.tolerance + kBearingTolerance * crossing / std::abs(incidence);
  const bool ends = beam->hit && std::abs(beam->reach - crossing) <= tolerance;
  if (!ends && beam->reach <= crossing + tolerance) {
    return {};
  }
  const Pose2 scanner_in_map = scan.map_in_scanner.inverse();
  return {ends ? BeamOutcome::kHit : BeamOutcome::kFree,
          scanner_in_map * Point2(crossing * along_beam), scanner_in_map.rotate(along_beam),
          tolerance};
}

}  // namespace datmo
