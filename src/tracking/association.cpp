// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/association.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory_resource>
#include <utility>

#include "datmo_fusion/common/square.h"
#include "datmo_fusion/tracking/kalman_filter.h"

namespace datmo {

namespace {

double diagonal(const Box2& box) { return std::hypot(box.length, box.width); }

Box2 moved(const Pose2& frame, const Box2& box) {
  return {frame * box.center, box.length, box.width};
}

/// The expected position of a target, and its gate.
struct Expected {
  Box2 box;
  double variance;  ///< m^2, sum over both coordinates
  CenterGate gate;
};

double detectionProbability(const Expected& target, const AssociationScan& scan) {
  const double sigma = std::sqrt(0.5 * target.variance);
  return scan.visibility->detectionProbability(moved(scan.fixed_in_base, target.box), sigma);
}

/// The single objects that may be within a target's gate, in the order of distance: most pairs are
/// so far apart that nothing else needs to be computed for them, and if many objects are near, the
/// first few are enough.
class NearObjects {
 public:
  NearObjects(const Expected& target, const AssociationScan& scan,
              const AssociationOptions& options) {
    heap_.reserve(kMany);
    const Box2& box = target.box;
    const Point2& position = box.center.position();
    const double sigma = std::sqrt(target.variance);
    const double gate = std::sqrt(options.gate);
    const double moved = scan.bound.delay * (target.gate.speed + gate * target.gate.velocity_std);
    const double reach =
        std::min(gate * (sigma + scan.noise) + 0.5 * scan.extent + 0.5 * diagonal(box) + moved,
                 target.gate.reach(scan.bound));
    const auto end = scan.centers.end();
    auto center = std::lower_bound(scan.centers.begin(), end, position.x() - reach,
                                   [](const Point2& point, double min) { return point.x() < min; });
    for (; center != end && center->x() <= position.x() + reach; ++center) {
      const double distance2 = (*center - position).squaredNorm();
      const auto index = static_cast<std::size_t>(center - scan.centers.begin());
      if (distance2 <= reach * reach &&
          distance2 <= square(target.gate.reach(scan.bounds[index]))) {
        heap_.emplace_back(distance2, index);
      }
    }
    std::make_heap(heap_.begin(), heap_.end(), std::greater<>());
  }

  std::size_t left() const { return heap_.size(); }

  std::size_t takeNearest() {
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    const std::size_t object = heap_.back().second;
    heap_.pop_back();
    return object;
  }

 private:
  /// Squared distance (m^2), and index.
  using NearObject = std::pair<double, std::size_t>;

  /// Number of objects for which the stack has room.
  static constexpr std::size_t kMany = 128;

  alignas(NearObject) std::array<std::byte, kMany * sizeof(NearObject)> scratch_;
  std::pmr::monotonic_buffer_resource memory_{scratch_.data(), scratch_.size()};
  std::pmr::vector<NearObject> heap_{&memory_};
};

}  // namespace

void AssociationOptions::visit(OptionVisitor& visitor) {
  visitor.number({"gate", "1",
                  "largest Mahalanobis distance squared between an object and a target: 13.8 is "
                  "the 99.9 % quantile of chi-square with two degrees of freedom"},
                 gate, {0.1, 1000.0});
  visitor.number({"min_same_class", "1",
                  "an object is not associated with a target if the probability that they are of "
                  "the same class is smaller (thesis 3.3.4: classes that differ)"},
                 min_same_class, {0.0, 1.0});
  visitor.integer({"max_candidates", "1",
                   "maximum number of objects that a target may be associated with in one scan, "
                   "the nearest ones; bounds the time of a step"},
                  max_candidates, {1, 1000});
  visitor.integer({"max_targets", "1", "maximum number of targets; bounds the time of a step"},
                  max_targets, {1, 5000});
  visitor.integer({"max_work", "1",
                   "pairs, rows and columns examined for one assignment (1 ns to 2 ns each) before "
                   "the remaining targets take the nearest free object"},
                  max_work, {1000, 1e9});
}

TargetScores scoresOf(const Target& target, const AssociationScan& scan, double existence,
                      const AssociationOptions& options, TargetScores memory) {
  const Expected expected{target.box(), target.positionCovariance().trace(),
                          target.gateOf(options.gate)};
  TargetScores scores = std::move(memory);
  scores.candidates.clear();
  scores.detection_probability = detectionProbability(expected, scan);
  const double seen = existence * scores.detection_probability;
  scores.missed = std::log1p(-seen);
  scores.seen = std::log(seen) - scores.missed;
  const auto max = static_cast<std::size_t>(options.max_candidates);
  NearObjects near(expected, scan, options);
  scores.candidates.reserve(std::min(near.left(), max));
  while (near.left() > 0 && scores.candidates.size() < max) {
    addCandidate(target, scan, near.takeNearest(), options, scores);
  }
  std::sort(scores.candidates.begin(), scores.candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.observation < b.observation; });
  return scores;
}

void addCandidate(const Target& target, const AssociationScan& scan, std::size_t index,
                  const AssociationOptions& options, TargetScores& scores) {
  const Observation& observation = scan.observations[index];
  const double same_class = target.sameClassProbability(observation);
  if (same_class < options.min_same_class) {
    return;
  }
  const PositionMeasurement measured = target.measurementOf(observation.object);
  const Innovation innovation = innovationOf(target.filter().estimate(), measured);
  if (!(innovation.squaredDistance() <= options.gate)) {  // excludes NaN
    return;
  }
  // Equal classes are no evidence beyond chance: objects of no target have classes, too.
  const double of_class = std::log(std::min(1.0, same_class / kChanceOfClass));
  const double likelihood = target.filter().logLikelihood(measured) + of_class;
  scores.candidates.push_back({index, scores.seen + likelihood - observation.log_density});
}

}  // namespace datmo
