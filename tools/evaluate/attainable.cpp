// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/attainable.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "evaluate/beams_on_box.h"
#include "evaluate/motion_bound.h"

#include "datmo_fusion/common/quantile.h"

namespace datmo::evaluation {

namespace {

/// Number of standard deviations of the range by which a beam may end outside its object.
constexpr double kTolerance = 3.0;

double logOdds(double probability) { return std::log(probability / (1.0 - probability)); }

/// One object, from its first beam on.
class Observer {
 public:
  Observer(const Point2& position, const AttainableOptions& options)
      : start_(position), options_(options) {}

  void add(const Scan& scan, const Pose2& base_in_map, const Point2& position,
           const BoxObservation& observed) {
    const Point2 displacement = position - start_;
    for (const BeamOnBox& beam : observed.beams) {
      bound_.addRange(displacement, base_in_map.rotate(beam.direction),
                      base_in_map.rotate(beam.normal), options_.range_noise);
      motion_.seen.push_back(scan.stamp);
    }
    if (observed.lateral) {
      bound_.addInterval(displacement, base_in_map.rotate(observed.lateral->axis),
                         observed.lateral->width);
    }
    if (!motion_.detectable && bound_.logRatio() >= options_.requiredLogRatio()) {
      motion_.detectable = scan.stamp;
    }
  }

  const AttainableMotion& motion() const { return motion_; }

 private:
  Point2 start_;  // m, map
  const AttainableOptions& options_;
  MotionBound bound_;
  AttainableMotion motion_;
};

std::size_t countBetween(const std::vector<Stamp>& stamps, Stamp first, Stamp last) {
  return static_cast<std::size_t>(std::upper_bound(stamps.begin(), stamps.end(), last) -
                                  std::lower_bound(stamps.begin(), stamps.end(), first));
}

std::vector<Stamp> stampsOf(const std::vector<Scan>& scans) {
  std::vector<Stamp> stamps;
  std::transform(scans.begin(), scans.end(), std::back_inserter(stamps),
                 [](const Scan& scan) { return scan.stamp; });
  return stamps;
}

/// s; 0 for fewer than two scans.
double medianPeriod(const std::vector<Stamp>& stamps) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    periods.push_back(secondsBetween(stamps[i - 1], stamps[i]));
  }
  return periods.empty() ? 0.0 : quantile(periods, 0.5);
}

ComparedDelay compared(const ObjectScore& object, const AttainableMotion& motion, double period) {
  ComparedDelay result;
  if (motion.detectable) {
    result.attainable = std::max(0.0, secondsBetween(object.first, *motion.detectable));
    if (object.delay) {
      result.excess = *object.delay - *result.attainable;
      result.ratio = (*object.delay + period) / (*result.attainable + period);
    }
  }
  return result;
}

}  // namespace

void AttainableOptions::visit(OptionVisitor& visitor) {
  visitor.number({"range_noise", "m",
                  "standard deviation of the scanner's ranges, from its data sheet or the "
                  "simulated scene; KITTI's Velodyne: 0.02"},
                 range_noise, {1e-4, 5.0});
  visitor.number({"required_probability", "1",
                  "probability from which an object is considered moving; as in the tracker"},
                 required_probability, {0.5, 0.999999});
  visitor.number(
      {"moving_prior", "1", "prior probability that it moves, before any beam; as in the tracker"},
      moving_prior, {0.01, 0.99});
}

double AttainableOptions::requiredLogRatio() const {
  return logOdds(required_probability) - logOdds(moving_prior);
}

std::map<std::uint32_t, AttainableMotion> attainableMotions(const std::vector<Scan>& scans,
                                                            const TrueScene& scene,
                                                            const AttainableOptions& options) {
  std::map<std::uint32_t, Observer> observers;
  for (const Scan& scan : scans) {
    const auto view = scene.at(scan.stamp);
    if (!view) {
      continue;
    }
    for (const TrueState& object : view->objects) {
      Box2 box = object.box;
      const Point2 position = box.center.position();
      box.center = view->base_in_map.inverse() * box.center;
      const BoxObservation observed = observeBox(scan, box, kTolerance * options.range_noise);
      if (!observed.beams.empty()) {
        observers.try_emplace(object.id, position, options)
            .first->second.add(scan, view->base_in_map, position, observed);
      }
    }
  }
  std::map<std::uint32_t, AttainableMotion> motions;
  for (const auto& [id, observer] : observers) {
    motions[id] = observer.motion();
  }
  return motions;
}

std::vector<ComparedDelay> compareDelays(const std::vector<ObjectScore>& objects,
                                         const std::map<std::uint32_t, AttainableMotion>& motions,
                                         const std::vector<Scan>& scans) {
  const std::vector<Stamp> stamps = stampsOf(scans);
  const double period = medianPeriod(stamps);
  std::vector<ComparedDelay> result;
  for (const ObjectScore& object : objects) {
    const auto motion = motions.find(object.id);
    if (motion == motions.end()) {
      result.emplace_back();
      continue;
    }
    result.push_back(compared(object, motion->second, period));
    const std::size_t there = countBetween(stamps, object.first, object.last);
    const std::size_t beams = countBetween(motion->second.seen, object.first, object.last);
    result.back().beams_per_scan =
        there == 0 ? 0.0 : static_cast<double>(beams) / static_cast<double>(there);
  }
  return result;
}

}  // namespace datmo::evaluation
