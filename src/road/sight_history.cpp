#include "datmo_fusion/road/sight_history.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "datmo_fusion/common/angle.h"

namespace datmo {

void SightHistoryOptions::visit(OptionVisitor& visitor) {
  visitor.number({"memory", "s", "how far back what scans saw of a place is known"}, memory,
                 {0.1, 60.0});
  visitor.integer({"most_scans", "1", "and how many scans at the most"}, most_scans, {1, 10000});
  visitor.number({"tolerance", "m", "a beam that ends nearer to a place has hit it"}, tolerance,
                 {0.05, 5.0});
  visitor.number({"lit_share", "1",
                  "part of the angle between two beams that a beam lights: a place beside that is "
                  "not seen free"},
                 lit_share, {0.05, 1.0});
}

SightHistory::SightHistory(const SightHistoryOptions& options) : options_(options) {
  checkOptions(options);
}

void SightHistory::add(const SplitScan& scan) {
  Scan seen;
  seen.stamp = scan.stamp;
  seen.map_in_scanner = (scan.base_in_map.pose * scan.scanner_in_base).inverse();
  seen.field = scan.field;
  seen.beams.assign(scan.field.beams, {static_cast<float>(scan.field.free_range), false});
  for (const std::uint32_t beam : scan.blind_beams) {
    if (beam < seen.beams.size()) {
      seen.beams[beam] = {};
    }
  }
  for (const ScanPoint& point : scan.points) {
    if (point.beam < seen.beams.size()) {
      seen.beams[point.beam] = {static_cast<float>(point.range), true};
    }
  }
  scans_.push_front(std::move(seen));
  while (scans_.size() > static_cast<std::size_t>(options_.most_scans) ||
         age(scans_.size() - 1) > options_.memory) {
    scans_.pop_back();
  }
}

double SightHistory::age(std::size_t back) const {
  return secondsBetween(scans_[back].stamp, scans_.front().stamp);
}

Sight SightHistory::look(std::size_t back, const Point2& place) const {
  const Scan& scan = scans_[back];
  return lookWith(scan, scan.map_in_scanner * place);
}

Sight SightHistory::lookWith(const Scan& scan, const Point2& seen) const {
  const double range = seen.norm();
  const double spacing = std::abs(scan.field.beam_spacing);
  if (scan.beams.empty() || spacing == 0.0 || range <= scan.field.least_range) {
    return Sight::kNothing;
  }
  const double bearing = std::atan2(seen.y(), seen.x());
  double index = normalizeAngle(bearing - scan.field.first_bearing) / scan.field.beam_spacing;
  if (index < -0.5) {
    index += 2.0 * kPi / spacing;  // the other way round
  }
  const double reach_beams = std::min(options_.tolerance / (spacing * range), 1e6);
  const auto last = static_cast<double>(scan.beams.size() - 1);
  const double from = std::max(0.0, std::ceil(index - reach_beams));
  const double to = std::min(last, std::floor(index + reach_beams));
  for (double i = from; i <= to; i += 1.0) {
    const Beam& beam = scan.beams[static_cast<std::size_t>(i)];
    const double beside = (i - index) * spacing;
    const double squared = range * range + static_cast<double>(beam.reach) * beam.reach -
                           2.0 * range * beam.reach * std::cos(beside);
    if (beam.hit && squared <= options_.tolerance * options_.tolerance) {
      return Sight::kHit;
    }
  }
  const double nearest = std::round(index);
  if (nearest < 0.0 || nearest > last || std::abs(nearest - index) > 0.5 * options_.lit_share) {
    return Sight::kNothing;
  }
  const Beam& beam = scan.beams[static_cast<std::size_t>(nearest)];
  return beam.reach > range + options_.tolerance ? Sight::kFree : Sight::kNothing;
}

}  // namespace datmo
