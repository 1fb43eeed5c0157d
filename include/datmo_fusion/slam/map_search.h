// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <queue>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/grid/distance_field.h"
#include "datmo_fusion/grid/occupancy_map.h"
#include "datmo_fusion/slam/search_region.h"
#include "datmo_fusion/slam/searched_map.h"

namespace datmo {

struct MapSearchOptions {
  /// 0.001 to 1: mean share of the surfaces of one map that are contradicted by another map of the
  /// same place, made a short time later
  double changed_share = 0.03;
  double missing_share = 0.0;  ///< of the surfaces; 0: missing surfaces do not count
  double max_log_ratio = 6.0;  ///< between two hypotheses that are both kept
  /// 0 to 1: a pose that is contradicted by a larger share of the surfaces is rejected
  double max_changed_share = 0.15;
  /// 0 to 1: minimum share of surfaces that both maps have, at the pose found
  double min_shared = 0.4;
  double max_aligned_sigma = 1.5;  ///< m; 0: maps are never aligned
  /// 1 to 1000000: minimum number of static cells of the newer map for a search
  int min_surfaces = 60;
  double reach = 35.0;  ///< m
  int max_boxes = 60000;

  /// Returns options for a complete map of an area (a prior map), which lacks only what has
  /// changed.
  static MapSearchOptions inCompleteMap();

  void visit(OptionVisitor& visitor);
};

/// Finds where a recently started map lies in an older one.
///
/// Two maps of one area agree except for what has changed: only a small share of the surfaces of
/// one lie in space that the other has seen free. Agreeing surfaces, however many, prove less,
/// because parked cars repeat. So the negative log-likelihood of a hypothesis (a pose in the older
/// map) is that of its share of contradicted surfaces, which is exponentially distributed, plus its
/// distance from the prior; what is unknown in either map does not count. In a complete map of an
/// area, surfaces of the newer map that are missing count as well, with a share of their own (the
/// score of Hess et al. 2016): otherwise nothing would speak against the space outside of it.
/// Hardly anything contradicts the true pose, so it is among the hypotheses within `max_log_ratio`
/// of the best. The pose is found if all of them lie close together, at surfaces of both maps, so
/// that scans can be matched there. Along a street, where nothing tells how far the vehicle went,
/// they lie in a narrow region: then the maps are aligned, with a covariance that reaches all of
/// them. Otherwise the result is ambiguous.
///
/// Branch and bound (Olson 2009, 2015; Hess et al. 2016), best first: all poses of a box are
/// contradicted by surfaces that lie deeper in free space than the box can move them. The work can
/// be spread over several calls. The newer map is not kept.
class MapSearch {
 public:
  enum class Outcome {
    kUnfinished,  ///< call advance() again
    kFound,       ///< a unique pose is not contradicted
    kAligned,     ///< the poses that are not contradicted lie in a narrow region
    kAmbiguous,   ///< several poses are not contradicted, or there is too little to compare
    kNone,        ///< all poses within the prior are contradicted
  };

  /// The vehicle is at `in_newer` in the newer map, and within `region` in the older one. Throws
  /// OptionError.
  MapSearch(const Checked<MapSearchOptions>& options, std::shared_ptr<const SearchedMap> older,
            const OccupancyMap& newer, const SearchRegion& region, const Pose2& in_newer);

  /// Evaluates at most this many further boxes of poses.
  Outcome advance(int boxes);

  /// Returns the most likely pose in the older map, unique or not; none if there is none.
  std::optional<Pose2> likeliest() const;

  /// With kFound: returns the pose in the older map; its covariance includes the spread of the
  /// poses that are not contradicted.
  PoseWithCovariance found() const;

  /// With kAligned: returns the one nearest to the mean of the poses that are not contradicted,
  /// with a covariance that reaches all of them. Throws std::bad_optional_access otherwise.
  PoseWithCovariance aligned() const { return aligned_.value(); }

 private:
  /// Poses within `half` (m, m, rad) of a center.
  struct Box {
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< of the center from the prior
    Eigen::Vector3d half = Eigen::Vector3d::Zero();
    double contradicted = 0.0;  ///< share of surfaces, lower bound
    double cost = 0.0;          ///< negative log-likelihood, lower bound
  };
  struct Costlier {
    bool operator()(const Box& a, const Box& b) const { return a.cost > b.cost; }
  };
  /// A cell that contains a surface.
  struct Surface {
    Point2 position;  ///< m, in the newer map about the vehicle, in the older one in the map frame
    double distance = 0.0;  ///< m, from the vehicle, or from its prior position
  };

  /// Surfaces within reach of the vehicle, subsampled, and how many cells each represents.
  struct Surfaces {
    std::vector<Surface> all;
    double weight = 1.0;
  };

  /// A surface of the newer map about the vehicle, in cells of the older one.
  struct Pattern {
    Eigen::Vector2f position;
    float distance;  ///< from the vehicle
  };

  struct Circle {
    Point2 center;
    double radius;  ///< m
  };

  /// At most `max` of the positions within a circle.
  static Surfaces thinnedOut(const std::vector<Point2>& positions, const Circle& within,
                             std::size_t max);
  Box withinPrior();
  static Box wholeWindow(const GridWindow& window);
  Pose2 poseOf(const Box& box) const;
  void open(Box box);
  void split(const Box& box);
  bool isLeaf(const Box& box) const;
  static Eigen::Vector3d between(const Box& from, const Box& to);
  double priorCost(const Box& box) const;
  /// The parts of a box's cost; those of the newer map's surfaces as shares of them.
  struct Contradictions {
    double in_free_space = 0.0;
    double missing = 0.0;
  };
  Contradictions contradictionsOf(const Box& box) const;
  /// Minimum number of surfaces of the older map that all poses of the box see through.
  int seenThrough(const Box& box) const;
  void evaluate(Box& box) const;
  /// Distances (in cells, at most the tolerance) of the newer map's surfaces to those of the older
  /// one, at this pose.
  std::vector<float> distancesAt(const Pose2& pose) const;
  double sharedAt(const Pose2& pose) const;
  Eigen::Isometry2f patternAt(const Pose2& pose) const;
  /// Whether a leaf belongs to the same hypothesis as the best one.
  bool isSameHypothesis(const Box& leaf) const;
  /// Whether maps are aligned at all, and the leaf and the best one may lie in one narrow region.
  bool isInAlignedRegion(const Box& leaf) const;
  /// Whether a pose with this covariance aligns the maps, up to the surfaces that are compared.
  bool isNarrow(const Eigen::Matrix3d& covariance) const;
  /// Probability of each leaf, from its likelihood; their sum is 1.
  std::vector<double> leafProbabilities() const;
  /// The leaf nearest to their mean, weighted likewise.
  const Box& centralLeaf() const;
  /// Its pose, with a covariance that reaches all leaves.
  PoseWithCovariance centralPose() const;
  /// Mean square of the leaves' offsets from a pose, weighted by leafProbabilities().
  Eigen::Matrix3d spreadAbout(const Pose2& pose) const;
  /// The leaf of that hypothesis whose surfaces are nearest to those of the older map: the
  /// tolerance for equal surfaces is wider than the accuracy of a match.
  const Box& nearestLeaf() const;
  /// Sum of distancesAt().
  double distanceAt(const Pose2& pose) const;
  /// The pose near this one that minimizes distanceAt().
  Pose2 refined(Pose2 pose) const;
  Outcome evaluateLeaf(const Box& leaf);
  /// Whether all leaves that are kept belong to the hypothesis of the best one.
  bool areAllSameHypothesis() const;
  double maxShared() const;
  Outcome conclude();

  MapSearchOptions options_;
  std::shared_ptr<const SearchedMap> older_map_;
  DistanceField newer_free_;  ///< to the nearest cell that is not free
  PoseWithCovariance prior_;
  bool anywhere_;
  Pose2 in_newer_;
  Eigen::Matrix3d whitening_ = Eigen::Matrix3d::Zero();  ///< of differences from the prior
  Eigen::Vector3d leaf_half_size_;  ///< half size of a box that is not split further
  double tolerance_;                ///< m, by which surfaces may be off
  std::vector<Pattern> newer_;
  double newer_weight_ = 0.0;
  Surfaces older_;
  std::priority_queue<Box, std::vector<Box>, Costlier> open_;
  std::vector<Box> leaves_;                    ///< that are kept, best first
  std::optional<PoseWithCovariance> aligned_;  ///< with kAligned
  int evaluated_boxes_ = 0;
  Outcome outcome_ = Outcome::kUnfinished;
};

}  // namespace datmo
