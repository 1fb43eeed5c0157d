// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/split_merge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "object_parts.h"

namespace datmo {

namespace {

double area(const Box2& box) { return box.length * box.width; }

Box2 widened(Box2 box, double margin) {
  box.length += 2.0 * margin;
  box.width += 2.0 * margin;
  return box;
}

bool mayBePartOf(const Object& object, const Box2& target, const SplitMergeOptions& options) {
  const Box2 around = widened(target, options.margin);
  return around.contains(object.box.center.position()) && object.box.length <= around.length;
}

bool mayCover(const Object& object, const Box2& target, const SplitMergeOptions& options) {
  return widened(object.box, options.margin).contains(target.center.position());
}

/// Another interpretation of some objects: the observations that replace them.
struct Alternative {
  std::vector<std::size_t> sources;  ///< ascending
  std::vector<std::size_t> observations;
};

class AlternativeFinder {
 public:
  AlternativeFinder(HypothesisCluster& cluster, AssociationScan& scan,
                    const AssociationOptions& association, const SplitMergeOptions& options,
                    const Interpretation& objects)
      : cluster_(cluster),
        scan_(scan),
        association_(association),
        options_(options),
        objects_(objects) {
    for (std::size_t tree = 0; tree < cluster.trees.size(); ++tree) {
      const int leaf = cluster.best().leaf_of_tree[tree];
      if (leaf != kAbsent) {
        const Target& target = cluster.trees[tree].leaves[static_cast<std::size_t>(leaf)].target;
        if (target.confirmed()) {
          confirmed_.push_back({tree, target.box()});
        }
      }
    }
  }

  std::vector<Alternative> alternatives() {
    std::vector<Alternative> result;
    for (const ExpectedTarget& target : confirmed_) {
      addUnion(target, result);
    }
    for (const std::size_t object : objects_) {
      addParts(object, result);
    }
    return result;
  }

 private:
  /// A confirmed target, by its tree, at its expected position in the best hypothesis.
  struct ExpectedTarget {
    std::size_t tree;
    Box2 box;
  };

  void addUnion(const ExpectedTarget& target, std::vector<Alternative>& result) {
    std::vector<std::size_t> inside;
    std::vector<const Object*> parts;
    for (const std::size_t index : objects_) {
      if (mayBePartOf(scan_.observations[index].object, target.box, options_)) {
        inside.push_back(index);
      }
    }
    if (inside.size() < 2 || options_.split_probability == 0.0) {
      return;
    }
    double log_density = 0.0;
    for (const std::size_t index : inside) {
      parts.push_back(&scan_.observations[index].object);
      log_density += scan_.observations[index].log_density;
    }
    log_density -=
        static_cast<double>(inside.size() - 1) *
        std::log(options_.split_probability / area(widened(target.box, options_.margin)));
    const Object whole = unionOf(parts, target.box.center.heading());
    result.push_back({inside, {observe(whole, inside, log_density, target.tree)}});
  }

  void addParts(std::size_t index, std::vector<Alternative>& result) {
    std::vector<ExpectedTarget> covered;
    for (const ExpectedTarget& target : confirmed_) {
      if (mayCover(scan_.observations[index].object, target.box, options_)) {
        covered.push_back(target);
      }
    }
    if (covered.size() != 2 || options_.merge_probability == 0.0) {
      return;
    }
    const Object object = scan_.observations[index].object;  // observe() moves the list
    std::array<std::vector<Point2>, 2> points;
    for (const Point2& point : object.points) {
      points[covered[1].box.distanceTo(point) < covered[0].box.distanceTo(point) ? 1 : 0].push_back(
          point);
    }
    if (points[0].empty() || points[1].empty()) {
      return;
    }
    const double log_density =
        0.5 * (scan_.observations[index].log_density -
               std::log(options_.merge_probability * area(widened(object.box, options_.margin))));
    const Point2 displacement = covered[1].box.center.position() - covered[0].box.center.position();
    Alternative both{{index}, {}};
    for (std::size_t i = 0; i < 2; ++i) {
      const Object part = partOf(object, std::move(points[i]), covered[i].box.center.heading(),
                                 i == 0 ? displacement : Point2(-displacement));
      both.observations.push_back(observe(part, {index}, log_density, covered[i].tree));
    }
    result.push_back(std::move(both));
  }

  /// Adds an observation that can only belong to this target.
  std::size_t observe(const Object& object, const std::vector<std::size_t>& sources,
                      double log_density, std::size_t tree) {
    const std::size_t index = scan_.observations.size();
    scan_.observations.push_back({object, sources, log_density, ObservedTarget::kKnown});
    for (Leaf& leaf : cluster_.trees[tree].leaves) {
      addCandidate(leaf.target, scan_, index, association_, leaf.scores);
    }
    return index;
  }

  HypothesisCluster& cluster_;
  AssociationScan& scan_;
  const AssociationOptions& association_;
  const SplitMergeOptions& options_;
  const Interpretation& objects_;
  std::vector<ExpectedTarget> confirmed_;
};

bool overlap(const std::vector<std::size_t>& a, const std::vector<std::size_t>& b) {
  std::vector<std::size_t> common;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
  return !common.empty();
}

/// The interpretation with the alternative in place of its sources.
Interpretation replaced(const Interpretation& objects, const Alternative& alternative) {
  Interpretation result;
  std::set_difference(objects.begin(), objects.end(), alternative.sources.begin(),
                      alternative.sources.end(), std::back_inserter(result));
  result.insert(result.end(), alternative.observations.begin(), alternative.observations.end());
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

void SplitMergeOptions::visit(OptionVisitor& visitor) {
  visitor.number({"split_probability", "1",
                  "probability that a confirmed target is seen as one object too many (thesis "
                  "figure 4.11 d); 0: never"},
                 split_probability, {0.0, 1.0});
  visitor.number({"merge_probability", "1",
                  "probability that two confirmed targets close by are seen as one object (thesis "
                  "figure 4.11 e); 0: never"},
                 merge_probability, {0.0, 1.0});
  visitor.number({"margin", "m", "how far outside of a target's box its parts may lie"}, margin,
                 {0.01, 10.0});
  visitor.integer({"max_interpretations", "1",
                   "maximum number of interpretations of a cluster's objects: unchanged, split or "
                   "merged; bounds the time of a step"},
                  max_interpretations, {1, 100});
}

std::vector<std::size_t> relatedObjects(const Target& target, const AssociationScan& scan,
                                        const SplitMergeOptions& options,
                                        std::vector<std::size_t> memory) {
  std::vector<std::size_t> result = std::move(memory);
  result.clear();
  if (!target.confirmed()) {
    return result;
  }
  const bool splits = options.split_probability > 0.0;
  const bool merges = options.merge_probability > 0.0;
  const Box2 box = target.box();
  const double x = box.center.x();
  const double y = box.center.y();
  const double reach = 0.5 * (scan.extent + box.length + box.width) + 2.0 * options.margin;
  const auto end = scan.centers.end();
  auto center = std::lower_bound(scan.centers.begin(), end, x - reach,
                                 [](const Point2& point, double min) { return point.x() < min; });
  for (; center != end && center->x() <= x + reach; ++center) {
    if (std::abs(center->y() - y) > reach) {
      continue;
    }
    const auto index = static_cast<std::size_t>(center - scan.centers.begin());
    const Object& object = scan.observations[index].object;
    if ((splits && mayBePartOf(object, box, options)) ||
        (merges && mayCover(object, box, options))) {
      result.push_back(index);
    }
  }
  return result;
}

void addSplitAndMerged(HypothesisCluster& cluster, AssociationScan& scan,
                       const AssociationOptions& association, const SplitMergeOptions& options,
                       std::vector<Interpretation>& interpretations) {
  const Interpretation objects = interpretations.front();
  const std::vector<Alternative> alternatives =
      AlternativeFinder(cluster, scan, association, options, objects).alternatives();
  if (alternatives.empty()) {
    return;
  }
  Interpretation all = objects;
  std::vector<std::size_t> replaced_objects;
  std::size_t used = 0;
  const auto max = static_cast<std::size_t>(options.max_interpretations);
  for (const Alternative& alternative : alternatives) {
    if (interpretations.size() < max) {
      interpretations.push_back(replaced(objects, alternative));
    }
    if (!overlap(replaced_objects, alternative.sources)) {
      all = replaced(all, alternative);
      replaced_objects.insert(replaced_objects.end(), alternative.sources.begin(),
                              alternative.sources.end());
      std::sort(replaced_objects.begin(), replaced_objects.end());
      ++used;
    }
  }
  if (used > 1 && max > 1) {
    interpretations.resize(std::min(interpretations.size(), max - 1));
    interpretations.push_back(all);
  }
}

}  // namespace datmo
