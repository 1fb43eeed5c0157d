// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/visibility/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "datmo_fusion/visibility/box_silhouette.h"

namespace datmo {

namespace {

/// Beam spacing of a fan that represents a field of view: a pedestrian at 60 m covers two beams.
constexpr double kFanSpacing = degrees(0.25);

/// More beams than this do not increase the probability that one returns.
constexpr double kManyBeams = 50.0;

}  // namespace

/// A box as seen from the sensor.
class Visibility::Outline : public BoxSilhouette {
 public:
  Outline(const Box2& box, const Pose2& sensor)
      : BoxSilhouette(box, sensor.position()),
        to_sensor_(box.center.heading() - sensor.heading()) {}

  /// Calls `use(bearing, crossing)` for the lines through the centers of this many equal parts of
  /// the width; bearing in rad, about the sensor.
  template <typename Use>
  void forEachLook(std::size_t parts, const Use& use) const;

 private:
  double to_sensor_;  ///< rad, from bearings in the box's frame to those about the sensor
};

template <typename Use>
void Visibility::Outline::forEachLook(std::size_t parts, const Use& use) const {
  const double step = width() / static_cast<double>(parts);
  const double c = std::cos(step);
  const double s = std::sin(step);
  double toward = bearing() + right() + 0.5 * step;
  Point2 direction(std::cos(toward), std::sin(toward));
  for (std::size_t part = 0; part < parts; ++part) {
    use(toward + to_sensor_, crossing(direction));
    toward += step;
    direction =
        Point2(c * direction.x() - s * direction.y(), s * direction.x() + c * direction.y());
  }
}

void VisibilityOptions::visit(OptionVisitor& visitor) {
  visitor.number({"beam_detection", "1",
                  "probability that a beam that meets an object returns; it falls from the scan's "
                  "free_range to 0 at the scanner's reach"},
                 beam_detection, {0.01, 0.999});
  visitor.number({"max_probability", "1",
                  "probability that an object that many beams meet is detected: segmentation may "
                  "still join it to something else"},
                 max_probability, {0.1, 0.999});
  visitor.number(
      {"min_probability", "1",
       "probability that an object that no beam can reach is detected: the view may be wrong"},
      min_probability, {0.0, 0.1});
  visitor.number({"unknown_probability", "1",
                  "probability that an object is detected when the sensor's view is unknown"},
                 unknown_probability, {0.1, 0.999});
  visitor.number({"blocking_distance", "m",
                  "a beam that ends in front of an object by more than this is blocked; by less, "
                  "it may have hit the object itself, which is not exactly where it is expected"},
                 blocking_distance, {0.0, 10.0});
}

Visibility::Visibility(const Checked<VisibilityOptions>& options) : options_(*options) {}

Visibility::Visibility(const LabeledScan& scan, const VisibilityOptions& options)
    : Visibility(options) {
  const ScanField& field = scan.field;
  ViewFan fan{scan.scanner_in_base,
              field.first_bearing,
              field.beam_spacing,
              field.min_range,
              field.free_range > 0.0 ? field.free_range : field.range,
              field.range,
              true,
              std::vector<double>(field.beams, field.range)};
  for (const std::uint32_t beam : scan.blind_beams) {
    if (beam < fan.reach.size()) {
      fan.reach[beam] = 0.0;
    }
  }
  for (const ScanPoint& point : scan.points) {
    if (point.beam < fan.reach.size()) {
      fan.reach[point.beam] = point.range;
    }
  }
  setFan(std::move(fan));
}

Visibility::Visibility(const FieldOfView& view, const std::vector<Box2>& seen,
                       const VisibilityOptions& options)
    : Visibility(options) {
  const double beams =
      std::max(0.0, std::round((view.max_bearing - view.min_bearing) / kFanSpacing));
  setFan({view.sensor_in_base, view.min_bearing + 0.5 * kFanSpacing, kFanSpacing, 0.0,
          view.sure_range, view.range, false,
          std::vector<double>(static_cast<std::size_t>(beams), view.range)});
  for (const Box2& box : seen) {
    const Outline outline(box, fan_.sensor);
    if (outline.holdsSensor()) {
      continue;
    }
    const auto parts = static_cast<std::size_t>(outline.width() / kFanSpacing) + 1;
    outline.forEachLook(parts, [this](double bearing, const LineCrossing& crossing) {
      if (const auto beam = beams_.indexAt(bearing, fan_.reach.size())) {
        // An object does not occlude itself.
        fan_.reach[*beam] = std::min(fan_.reach[*beam], crossing.exit);
      }
    });
  }
}

Visibility::Visibility(const std::vector<ViewFan>& fans, const VisibilityOptions& options)
    : Visibility(options) {
  for (const ViewFan& fan : fans) {
    if (fan_.reach.empty()) {
      setFan(fan);
    } else if (!fan.reach.empty()) {
      others_.emplace_back(std::vector<ViewFan>{fan}, options);
    }
  }
}

void Visibility::setFan(ViewFan fan) {
  fan_ = std::move(fan);
  beams_ = BeamFan(fan_.first_bearing, fan_.beam_spacing);
}

std::vector<ViewFan> Visibility::fans() const {
  std::vector<ViewFan> all;
  if (!fan_.reach.empty()) {
    all.push_back(fan_);
  }
  for (const Visibility& other : others_) {
    const std::vector<ViewFan> others = other.fans();
    all.insert(all.end(), others.begin(), others.end());
  }
  return all;
}

Visibility::Looks Visibility::looksAt(const Outline& outline) {
  Looks looks;
  std::size_t i = 0;
  outline.forEachLook(kLooks, [&](double bearing, const LineCrossing& crossing) {
    looks[i++] = {bearing, crossing.entry};
  });
  return looks;
}

double Visibility::clearShare(const Looks& looks, const Shift& shift) const {
  std::size_t clear = 0;
  for (const Look& look : looks) {
    const double range = look.range + shift.range;
    const bool in_range = range >= fan_.min_range && range <= fan_.range;
    const auto beam = beams_.indexAt(look.bearing + shift.bearing, fan_.reach.size());
    if (in_range && beam && range <= fan_.reach[*beam] + options_.blocking_distance) {
      ++clear;
    }
  }
  return static_cast<double>(clear) / kLooks;
}

double Visibility::strengthAt(double range) const {
  return range <= fan_.sure_range
             ? 1.0
             : std::max(0.0, (fan_.range - range) / (fan_.range - fan_.sure_range));
}

double Visibility::anyReturns(double beams, double chance) {
  // A width of 2.3 beams is hit by two of them, and by a third one with a probability of 0.3.
  const double whole = std::floor(std::min(beams, kManyBeams));
  const double rest = std::min(beams, kManyBeams) - whole;
  return 1.0 - std::pow(1.0 - chance, whole) * (1.0 - rest * chance);
}

double Visibility::detectionProbability(const Box2& box, double sigma) const {
  if (others_.empty()) {
    return ownDetectionProbability(box, sigma);
  }
  double missed = 1.0 - ownDetectionProbability(box, sigma);
  for (const Visibility& other : others_) {
    missed *= 1.0 - other.detectionProbability(box, sigma);
  }
  return std::min(1.0 - missed, options_.max_probability);
}

double Visibility::ownDetectionProbability(const Box2& box, double sigma) const {
  if (fan_.reach.empty()) {
    return options_.unknown_probability;
  }
  const Outline outline(box, fan_.sensor);
  if (outline.holdsSensor()) {
    return options_.unknown_probability;
  }
  const double beams = beams_.beamsIn(outline.width());
  const double strength = strengthAt(outline.distance());
  const Looks looks = looksAt(outline);
  const auto seenAt = [&](const Shift& shift) {
    const double clear = clearShare(looks, shift);
    return fan_.by_beams ? anyReturns(beams * clear, strength * options_.beam_detection)
                         : strength * clear;
  };
  double mean = seenAt({});
  if (sigma > 0.0) {
    // Third-order cubature with a center point (Julier & Uhlmann 2004, kappa = 1).
    const double step = std::sqrt(3.0) * sigma;
    const double turn = step / outline.distance();
    mean = mean / 3.0 + (seenAt({turn, 0.0}) + seenAt({-turn, 0.0}) + seenAt({0.0, step}) +
                         seenAt({0.0, -step})) /
                            6.0;
  }
  return std::clamp(options_.max_probability * mean, options_.min_probability,
                    options_.max_probability);
}

}  // namespace datmo
