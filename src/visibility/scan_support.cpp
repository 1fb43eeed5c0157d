// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/visibility/scan_support.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/visibility/box_silhouette.h"

namespace datmo {

namespace {

/// How far from an object's near side static points may end, in standard deviations of its
/// position: few, because static neighbors must not make it static.
constexpr double kStaticReach = 1.0;

/// How far behind an object a beam must end to have passed through it, in standard deviations of
/// its position.
constexpr double kThroughReach = 2.0;

/// m; how far behind its near side a beam may hit an object: its sides are not straight.
constexpr double kBodyDepth = 0.5;

/// Variance of an object's position along this direction (unit vector in its own frame), m^2,
/// including the sides seen from there.
double varianceAlong(const Object& object, const Point2& direction) {
  const Point2 in_base = object.box.center.rotate(direction);
  const auto side = [&](BoxSide one) {
    const double variance = object.side_variance[static_cast<std::size_t>(one)];
    return std::isfinite(variance) ? variance : 0.0;
  };
  const double x = side(direction.x() < 0.0 ? BoxSide::kFront : BoxSide::kRear);
  const double y = side(direction.y() < 0.0 ? BoxSide::kLeft : BoxSide::kRight);
  return in_base.dot(object.position_covariance * in_base) +
         direction.cwiseAbs2().dot(Point2(x, y));
}

/// Whether a point (box's frame, m) lies on the object, given the uncertainty of its position.
bool isAbout(const Point2& point, const Object& object, const BoxSilhouette& silhouette,
             const ScanSupportOptions& options) {
  Point2 excess = (point.cwiseAbs() - silhouette.half()).cwiseMax(0.0);
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    const bool behind = point[axis] * silhouette.sensor()[axis] < 0.0;
    const double unseen = std::max(0.0, kBodyDepth - 2.0 * silhouette.half()[axis]);
    excess[axis] = std::max(0.0, excess[axis] - (behind ? unseen : 0.0));
  }
  const double distance = excess.norm();
  if (distance == 0.0) {
    return true;
  }
  const Point2 outwards = excess.cwiseProduct(point.cwiseSign()) / distance;
  const double sigma = std::sqrt(varianceAlong(object, -outwards));
  return distance <= std::min(kStaticReach * sigma, options.max_static_reach);
}

/// Whether a beam continues beyond all of the object; `direction`: unit vector in the box's frame.
bool passesThrough(double range, const Point2& direction, double motion_std, const Object& object,
                   const BoxSilhouette& silhouette) {
  const LineCrossing through = silhouette.crossing(direction);
  const double variance = varianceAlong(object, direction) + motion_std * motion_std;
  return range >
         std::max(through.exit, through.entry + kBodyDepth) + kThroughReach * std::sqrt(variance);
}

}  // namespace

void ScanSupportOptions::visit(OptionVisitor& visitor) {
  visitor.number({"static_share", "1",
                  "an object that the scanner does not list is stationary if at least this share "
                  "of the beams at its position end there on static points"},
                 static_share, {0.01, 1.0});
  visitor.number({"max_static_reach", "m",
                  "greatest distance of such static points from the near side of the object"},
                 max_static_reach, {0.0, 20.0});
}

ScanSupport::ScanSupport(const LabeledScan& scan, const Checked<ScanSupportOptions>& options)
    : options_(*options),
      scanner_in_base_(scan.scanner_in_base),
      field_(scan.field),
      fan_(field_.first_bearing, field_.beam_spacing) {
  if (2.0 * kPi > kMaxBeams * std::abs(field_.beam_spacing)) {
    return;  // finer than any scanner: counting the beams toward an object would take too long
  }
  beams_.assign(field_.beams, {End::kNothing, field_.free_range});
  for (const std::uint32_t beam : scan.blind_beams) {
    if (beam < beams_.size()) {
      beams_[beam].range = 0.0;
    }
  }
  for (const ScanPoint& point : scan.points) {
    if (point.beam < beams_.size()) {
      const bool is_static = point.state == PointState::kStatic;
      beams_[point.beam] = {is_static ? End::kStaticHit : End::kHit, point.range};
    }
  }
}

const ScanSupport::Beam* ScanSupport::beam(double position) const {
  const auto index = fan_.nearest(position, beams_.size());
  return index ? &beams_[*index] : nullptr;
}

PositionEvidence ScanSupport::evidence(const Object& object, double motion_std) const {
  PositionEvidence result;
  const BoxSilhouette silhouette(object.box, scanner_in_base_.position());
  if (beams_.empty() || silhouette.holdsSensor()) {
    return result;
  }
  const double to_scanner = object.box.center.heading() - scanner_in_base_.heading();
  const double spacing = std::abs(field_.beam_spacing);
  const double width = silhouette.width();
  result.beams = width / spacing;
  // An object narrower than the beam spacing is hit by the nearest beam, if by any; a neighboring
  // point may still be part of it, given the uncertainty of its position.
  const double narrow = std::max(0.0, 0.5 * (spacing - width));
  const double aside =
      std::max(narrow, std::atan2(options_.max_static_reach, silhouette.distance()));
  const double edge =
      field_.beam_spacing > 0.0 ? silhouette.right() - aside : silhouette.left() + aside;
  const double first = std::ceil(fan_.positionAt(to_scanner + silhouette.bearing() + edge));
  const auto looks = static_cast<std::size_t>(1.0 + (width + 2.0 * aside) / spacing);
  double asked = 0.0;
  for (std::size_t i = 0; i < looks; ++i) {
    const double position = first + static_cast<double>(i);
    const Beam* seen = beam(position);
    const double bearing = fan_.bearingAt(position) - to_scanner;
    const double offset = angleBetween(silhouette.bearing(), bearing);
    const bool meets =
        offset >= silhouette.right() - narrow && offset <= silhouette.left() + narrow;
    const Point2 direction(std::cos(silhouette.bearing() + offset),
                           std::sin(silhouette.bearing() + offset));
    const bool stands =
        seen != nullptr && seen->end == End::kStaticHit &&
        isAbout(silhouette.sensor() + seen->range * direction, object, silhouette, options_);
    const bool through = seen != nullptr && !stands && meets &&
                         passesThrough(seen->range, direction, motion_std, object, silhouette);
    asked += meets || stands ? 1.0 : 0.0;
    result.static_share += stands ? 1.0 : 0.0;
    result.through_share += through ? 1.0 : 0.0;
  }
  result.static_share /= std::max(1.0, asked);
  result.through_share /= std::max(1.0, asked);
  return result;
}

}  // namespace datmo
