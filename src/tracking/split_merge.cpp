#include "datmo_fusion/tracking/split_merge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace datmo {

namespace {

constexpr double kLeastArea = 1.0;  ///< m^2, of what is nearly a point

/// Outward normals of the sides of a box, in the order of BoxSide.
std::array<Point2, kBoxSides> normalsOf(const Box2& box) {
  const Point2 ahead = box.centre.rotate(Point2::UnitX());
  const Point2 left = box.centre.rotate(Point2::UnitY());
  return {ahead, -ahead, left, -left};
}

double area(const Box2& box) { return std::max(kLeastArea, box.length * box.width); }

/// How far the box reaches in a direction, from the origin, m.
double reachAlong(const Box2& box, const Point2& direction) {
  double reach = -std::numeric_limits<double>::infinity();
  for (const Point2& corner : box.corners()) {
    reach = std::max(reach, corner.dot(direction));
  }
  return reach;
}

/// Variance of the side that looks most in this direction.
double sideVariance(const Object& object, const Point2& direction) {
  const std::array<Point2, kBoxSides> normals = normalsOf(object.box);
  std::size_t best = 0;
  for (std::size_t side = 1; side < kBoxSides; ++side) {
    if (normals[side].dot(direction) > normals[best].dot(direction)) {
      best = side;
    }
  }
  return object.side_variance[best];
}

/// The smallest box of this heading that holds all points; at least one.
Box2 boxAround(const std::vector<Point2>& points, double heading) {
  const Pose2 axes(Point2::Zero(), heading);
  const Pose2 back = axes.inverse();
  Point2 least = back * points.front();
  Point2 most = least;
  for (const Point2& point : points) {
    const Point2 local = back * point;
    least = least.cwiseMin(local);
    most = most.cwiseMax(local);
  }
  const Point2 size = most - least;
  return {Pose2(axes * Point2(0.5 * (least + most)), heading), size.x(), size.y()};
}

/// Some of the cluster's objects as one, in the axes of the target that they may be parts of.
Object unionOf(const std::vector<const Object*>& parts, double heading) {
  Object whole = *parts.front();
  std::vector<Point2> corners;
  whole.points.clear();
  double moving_points = 0.0;
  for (const Object* part : parts) {
    const auto box = part->box.corners();
    corners.insert(corners.end(), box.begin(), box.end());
    whole.points.insert(whole.points.end(), part->points.begin(), part->points.end());
    moving_points += part->moving_fraction * static_cast<double>(part->points.size());
    if (part->position_covariance.trace() > whole.position_covariance.trace()) {
      whole.position_covariance = part->position_covariance;
    }
    whole.dynamic_state = std::max(whole.dynamic_state, part->dynamic_state);
  }
  whole.moving_fraction =
      whole.points.empty() ? 0.0 : moving_points / static_cast<double>(whole.points.size());
  whole.box = boxAround(corners, heading);
  const std::array<Point2, kBoxSides> normals = normalsOf(whole.box);
  for (std::size_t side = 0; side < kBoxSides; ++side) {
    const Object* outermost =
        *std::max_element(parts.begin(), parts.end(), [&](const Object* a, const Object* b) {
          return reachAlong(a->box, normals[side]) < reachAlong(b->box, normals[side]);
        });
    whole.side_variance[side] = sideVariance(*outermost, normals[side]);
  }
  return whole;
}

/// The points of an object as the part of it that belongs to one target; the other one is in the
/// direction `other`, where the part ends without having been seen to.
Object partOf(const Object& whole, std::vector<Point2> points, double heading,
              const Point2& other) {
  Object part = whole;
  part.box = boxAround(points, heading);
  part.points = std::move(points);
  const std::array<Point2, kBoxSides> normals = normalsOf(part.box);
  std::size_t inner = 0;
  for (std::size_t side = 0; side < kBoxSides; ++side) {
    part.side_variance[side] = sideVariance(whole, normals[side]);
    inner = normals[side].dot(other) > normals[inner].dot(other) ? side : inner;
  }
  part.side_variance[inner] = kHiddenSide;
  return part;
}

/// Another reading of some objects: the observations that take their place.
struct Alternative {
  std::vector<std::size_t> sources;  ///< rising
  std::vector<std::size_t> observations;
};

class Reader {
 public:
  Reader(HypothesisCluster& cluster, AssociationScan& scan, const AssociationOptions& association,
         const SplitMergeOptions& options, const Interpretation& objects)
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
    for (const Placed& target : confirmed_) {
      addUnion(target, result);
    }
    for (const std::size_t object : objects_) {
      addParts(object, result);
    }
    return result;
  }

 private:
  /// A confirmed target, by its tree, where the best hypothesis expects it.
  struct Placed {
    std::size_t tree;
    Box2 box;
  };

  Box2 widened(Box2 box) const {
    box.length += 2.0 * options_.margin;
    box.width += 2.0 * options_.margin;
    return box;
  }

  void addUnion(const Placed& target, std::vector<Alternative>& result) {
    const Box2 around = widened(target.box);
    std::vector<std::size_t> inside;
    std::vector<const Object*> parts;
    for (const std::size_t index : objects_) {
      const Object& object = scan_.observations[index].object;
      if (around.contains(object.box.centre.position()) && object.box.length <= around.length) {
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
    log_density -= static_cast<double>(inside.size() - 1) *
                   std::log(options_.split_probability / area(around));
    const Object whole = unionOf(parts, target.box.centre.heading());
    result.push_back({inside, {observe(whole, inside, log_density, target.tree)}});
  }

  void addParts(std::size_t index, std::vector<Alternative>& result) {
    const Object object = scan_.observations[index].object;
    std::vector<Placed> covered;
    for (const Placed& target : confirmed_) {
      if (widened(object.box).contains(target.box.centre.position())) {
        covered.push_back(target);
      }
    }
    if (covered.size() != 2 || options_.merge_probability == 0.0) {
      return;
    }
    std::array<std::vector<Point2>, 2> points;
    for (const Point2& point : object.points) {
      points[covered[1].box.distanceTo(point) < covered[0].box.distanceTo(point) ? 1 : 0].push_back(
          point);
    }
    if (points[0].empty() || points[1].empty()) {
      return;
    }
    const double log_density = 0.5 * (scan_.observations[index].log_density -
                                      std::log(options_.merge_probability * area(object.box)));
    const Point2 way = covered[1].box.centre.position() - covered[0].box.centre.position();
    Alternative both{{index}, {}};
    for (std::size_t i = 0; i < 2; ++i) {
      const Object part = partOf(object, std::move(points[i]), covered[i].box.centre.heading(),
                                 i == 0 ? way : Point2(-way));
      both.observations.push_back(observe(part, {index}, log_density, covered[i].tree));
    }
    result.push_back(std::move(both));
  }

  /// Adds an observation that only this target may have been seen as.
  std::size_t observe(const Object& object, const std::vector<std::size_t>& sources,
                      double log_density, std::size_t tree) {
    const std::size_t index = scan_.observations.size();
    scan_.observations.push_back({object, sources, log_density, false, true});
    for (Leaf& leaf : cluster_.trees[tree].leaves) {
      addCandidate(leaf.target, scan_, index, association_, leaf.scores);
    }
    return index;
  }

  HypothesisCluster& cluster_;
  AssociationScan& scan_;
  const AssociationOptions& association_;
  const SplitMergeOptions& options_;
  const Interpretation objects_;
  std::vector<Placed> confirmed_;
};

bool overlap(const std::vector<std::size_t>& a, const std::vector<std::size_t>& b) {
  std::vector<std::size_t> common;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
  return !common.empty();
}

/// The reading with the alternative in the place of its sources.
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
                  "that a confirmed target is seen as one more object than it is (thesis figure "
                  "4.11 d); 0: never"},
                 split_probability, {0.0, 1.0});
  visitor.number({"merge_probability", "1",
                  "that two confirmed targets close by are seen as one object (thesis figure 4.11 "
                  "e); 0: never"},
                 merge_probability, {0.0, 1.0});
  visitor.number({"margin", "m", "how far outside of a target's box its parts may lie"}, margin,
                 {0.0, 10.0});
  visitor.integer({"most_readings", "1",
                   "readings of a cluster's objects, of each by itself and others; bounds the time "
                   "of a step"},
                  most_readings, {1, 100});
}

void addSplitAndMerged(HypothesisCluster& cluster, AssociationScan& scan,
                       const AssociationOptions& association, const SplitMergeOptions& options,
                       std::vector<Interpretation>& interpretations) {
  const Interpretation objects = interpretations.front();
  const std::vector<Alternative> alternatives =
      Reader(cluster, scan, association, options, objects).alternatives();
  Interpretation all = objects;
  std::vector<std::size_t> replaced_objects;
  std::size_t used = 0;
  for (const Alternative& alternative : alternatives) {
    if (interpretations.size() < static_cast<std::size_t>(options.most_readings)) {
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
  if (used > 1) {
    interpretations.push_back(all);
  }
}

}  // namespace datmo
