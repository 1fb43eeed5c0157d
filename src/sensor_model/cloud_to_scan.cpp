// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/sensor_model/cloud_to_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "datmo_fusion/common/angle.h"

namespace datmo {

namespace {

constexpr float kNoReturn = std::numeric_limits<float>::infinity();
constexpr float kBlind = std::numeric_limits<float>::quiet_NaN();

/// rad; rounding tolerance for bearings: far less than any beam.
constexpr double kRounding = 1e-5;

bool isWholeTurn(double field_of_view) { return field_of_view > kTurn - kRounding; }

/// The beams of the scan, and the lookup of beams by bearing.
struct Beams {
  double first_bearing = 0.0;
  double spacing = 0.0;     ///< signed
  double half_width = 0.0;  ///< of each, in spacings
  int count = 0;

  double lastBearing() const { return first_bearing + spacing * (count - 1); }

  /// Beams from the first one to `bearing`, -0.5 or more.
  double stepsTo(float bearing) const {
    // Both bearings are within half a turn of 0, so at most one turn must be added; this is done
    // for each point of the cloud.
    const double steps = (bearing - first_bearing) / spacing;
    const double turn = kTurn / std::abs(spacing);
    return steps < -0.5 ? steps + turn : steps >= turn - 0.5 ? steps - turn : steps;
  }
};

/// In the lidar's direction of rotation, from the start of its turn if they are a full turn.
Beams layOut(const CloudToScanOptions& options, const std::optional<SweepTiming>& sweep) {
  const bool whole = isWholeTurn(options.field_of_view);
  const int steps = static_cast<int>(std::lround(options.field_of_view / options.beam_spacing));
  const double direction = sweep && sweep->clockwise ? -1.0 : 1.0;
  Beams beams;
  beams.count = whole ? steps : steps + 1;
  beams.spacing = direction * (whole ? kTurn / steps : options.beam_spacing);
  beams.half_width =
      options.beam_width > 0.0 ? 0.5 * options.beam_width / options.beam_spacing : 0.5;
  if (whole) {
    beams.first_bearing = sweep ? normalizeAngle(sweep->first_bearing + 0.5 * beams.spacing) : -kPi;
  } else {
    beams.first_bearing = -0.5 * beams.spacing * steps;
  }
  return beams;
}

/// Sets the scan's times; `sweep` may be none.
void setTimes(const std::optional<SweepTiming>& sweep, const Beams& beams, PlanarScan& scan) {
  if (!sweep) {
    return;
  }
  const double first = sweep->timeAt(beams.first_bearing);
  const double beam_time = sweep->duration * std::abs(beams.spacing) / kTurn;
  const double last = sweep->timeAt(beams.lastBearing());
  const double expected = first + beam_time * (beams.count - 1);
  scan.sweep_ends_inside = std::abs(last - expected) > 0.5 * sweep->duration;
  if (!scan.sweep_ends_inside) {
    scan.first_time = first;
    scan.beam_time = beam_time;
  }
}

/// Marks beams without points as seen if one with points is at most `max_gap` beams away: such gaps
/// lie between the lidar's own columns. `seen`: by beam; in a full turn gaps wrap around.
std::vector<bool> withoutGaps(std::vector<bool> seen, int max_gap, bool whole_turn) {
  const auto count = static_cast<int>(seen.size());
  const std::vector<bool> points = seen;
  const auto hasPoint = [&](int beam) {
    const int wrapped = (beam % count + count) % count;
    return (whole_turn || wrapped == beam) && points[static_cast<std::size_t>(wrapped)];
  };
  for (int beam = 0; beam < count; ++beam) {
    for (int gap = 1; gap <= max_gap && !seen[static_cast<std::size_t>(beam)]; ++gap) {
      seen[static_cast<std::size_t>(beam)] = hasPoint(beam - gap) || hasPoint(beam + gap);
    }
  }
  return seen;
}

/// The nearest point of each beam in the height band, and which beams have any points.
class Band {
 public:
  Band(const CloudToScanOptions& options, const Beams& beams, const RoadPlane& ground,
       const Point2& lidar)
      : options_(options),
        beams_(beams),
        ground_(ground),
        lidar_(lidar.cast<float>()),
        nearest_(static_cast<std::size_t>(beams.count), kNoReturn),
        seen_(nearest_.size(), false) {}

  /// `point`: base_link, m.
  void add(const pcl::PointXYZ& point) {
    const float x = point.x - lidar_.x();
    const float y = point.y - lidar_.y();
    const double steps = beams_.stepsTo(std::atan2(y, x));
    // Rounds, because no step is below -0.5; std::lround would be a call for each of 130,000
    // points.
    const auto beam =
        static_cast<std::size_t>(steps + 0.5);  // NOLINT(bugprone-incorrect-roundings)
    if (beam >= seen_.size()) {
      return;
    }
    seen_[beam] = true;
    if (std::abs(steps - static_cast<double>(beam)) > beams_.half_width) {
      return;
    }
    const double height = ground_.heightOf({point.x, point.y, point.z});
    const float range = std::sqrt(x * x + y * y);
    if (height >= options_.min_height && height <= options_.max_height &&
        range >= options_.min_range && range <= options_.max_range) {
      ++points_;
      nearest_[beam] = std::min(nearest_[beam], range);
    }
  }

  void finish(PlanarScan& scan) const {
    const int max_gap = static_cast<int>(options_.blind_width / std::abs(beams_.spacing));
    const auto seen = withoutGaps(seen_, max_gap, isWholeTurn(options_.field_of_view));
    scan.band_points = points_;
    scan.ranges = nearest_;
    for (std::size_t beam = 0; beam < seen.size(); ++beam) {
      if (!seen[beam]) {
        scan.ranges[beam] = kBlind;
        ++scan.blind_beams;
      }
    }
  }

 private:
  const CloudToScanOptions& options_;
  const Beams& beams_;
  const RoadPlane& ground_;
  Eigen::Vector2f lidar_;
  std::vector<float> nearest_;
  std::vector<bool> seen_;
  std::size_t points_ = 0;
};

}  // namespace

void CloudToScanOptions::visit(OptionVisitor& visitor) {
  visitor.number({"min_height", "m",
                  "lower end of the band above the ground in which points are obstacles: above "
                  "curbs and above the errors of the ground plane",
                  Tier::kPublic},
                 min_height, {-0.5, 5.0});
  visitor.number({"max_height", "m",
                  "upper end of the band: high enough for two rows of the lidar on distant "
                  "objects, below signs and branches",
                  Tier::kPublic},
                 max_height, {-0.5, 5.0});
  visitor.number({"min_range", "m", "nearer points are ignored", Tier::kPublic}, min_range,
                 {0.0, 100.0});
  visitor.number({"max_range", "m", "farther points are ignored", Tier::kPublic}, max_range,
                 {0.1, 500.0});
  visitor.number({"beam_spacing", "rad", "angle from one beam to the next", Tier::kPublic},
                 beam_spacing, {degrees(0.02), degrees(10.0)});
  visitor.number({"beam_width", "rad", "angle that one beam covers; 0: all up to its neighbors"},
                 beam_width, {0.0, degrees(10.0)});
  visitor.number(
      {"field_of_view", "rad", "angle from the first beam to the last, half of it to either side",
       Tier::kPublic},
      field_of_view, {degrees(1.0), kTurn + kRounding});
  visitor.number({"blind_width", "rad",
                  "a beam has no measurement (NaN) if the cloud has no points at all within this "
                  "angle to either side: behind the vehicle's own roof, out of the lidar's view"},
                 blind_width, {0.0, kPi});
  visitor.group("vehicle", [&] { vehicle.visit(visitor); });
  visitor.group("ground", [&] { ground.visit(visitor); });
  visitor.group("sweep", [&] { sweep.visit(visitor); });
}

void CloudToScanOptions::check() const {
  if (min_height >= max_height) {
    throw OptionError("min_height = " + std::to_string(min_height) +
                      ": expected less than max_height = " + std::to_string(max_height));
  }
  if (min_range >= max_range) {
    throw OptionError("min_range = " + std::to_string(min_range) +
                      ": expected less than max_range = " + std::to_string(max_range));
  }
  if (beam_width > beam_spacing) {
    throw OptionError("beam_width = " + std::to_string(beam_width) +
                      ": expected at most beam_spacing = " + std::to_string(beam_spacing));
  }
}

CloudToScan::CloudToScan(const Checked<CloudToScanOptions>& options) : options_(*options) {}

PlanarScan CloudToScan::scan(const LidarCloud& cloud) const {
  const LidarPoints::Ptr points = toBase(cloud);
  const std::vector<int> outside = outsideOfVehicle(points, options_.vehicle);
  const Point2 lidar = cloud.lidar_in_base.translation().head<2>();
  const auto sweep =
      cloud.times.empty() ? options_.sweep.timing() : sweepOf(*points, cloud.times, lidar);
  const Beams beams = layOut(options_, sweep);
  PlanarScan scan;
  scan.first_bearing = beams.first_bearing;
  scan.beam_spacing = beams.spacing;
  setTimes(sweep, beams, scan);
  scan.own_points = points->size() - outside.size();
  scan.ground = findGround(*points, outside, options_.ground);
  Band band(options_, beams, scan.ground.plane, lidar);
  for (const int index : outside) {
    band.add((*points)[static_cast<std::size_t>(index)]);
  }
  band.finish(scan);
  return scan;
}

}  // namespace datmo
