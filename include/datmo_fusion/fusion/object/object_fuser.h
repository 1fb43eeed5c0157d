// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/fusion/object/object_association.h"
#include "datmo_fusion/fusion/object/position_covariance.h"
#include "datmo_fusion/visibility/scan_support.h"
#include "datmo_fusion/visibility/visibility.h"

namespace datmo {

/// One source of objects.
struct ObjectSourceOptions {
  bool use = true;
  double detection_probability = 0.5;        ///< 1
  double false_agreement_probability = 0.1;  ///< 1
  double late_by = 0.0;                      ///< s
  PositionCovarianceOptions covariance;

  void visit(OptionVisitor& visitor);
};

struct ObjectFuserOptions {
  std::map<std::string, ObjectSourceOptions> sources;  ///< by name; at first lidar and stereo
  std::string scanner = "lidar";                       ///< name of a source
  int max_objects = 500;
  ObjectAssociationOptions association;
  VisibilityOptions visibility;
  ScanSupportOptions scan_support;

  ObjectFuserOptions();

  void visit(OptionVisitor& visitor);
  void check() const;

  /// Names of the sources that are in use.
  std::vector<std::string> sourcesInUse() const;

  /// Allowed lateness, s, of the sources that are not waited for.
  std::map<std::string, double> lateSources() const;
};

/// The objects of one source, to be fused with those of others.
struct SourceObjects {
  std::string source;
  ObjectList list;          ///< vehicle's frame at the list's own stamp
  Pose2 base_in_reference;  ///< of the vehicle at that stamp, in its frame at the reference's stamp
};

/// Counts of one set of lists.
struct ObjectFusionCounts {
  std::size_t rejected = 0;  ///< invalid (isValid)
  std::size_t refused = 0;   ///< beyond the maximum of one list: the farthest
  std::size_t fused = 0;     ///< objects that two or more sources see
};

/// The fused list of all sources.
struct ObjectFusionResult {
  ObjectList list;  ///< vehicle's frame at the reference's stamp
  ObjectFusionCounts counts;
};

/// Fuses object lists of several sources (thesis 3.3.3).
///
/// Each list is moved by the vehicle's own motion to the vehicle's pose at the reference's stamp;
/// its objects keep the positions of their own time, given by `delay`. Then the lists are
/// associated one after another with the result so far (associate), pairs are fused (combined), and
/// all other objects are kept.
///
/// Existence: if one more source sees the object, the log odds rise by log(detection_probability /
/// false_agreement_probability); if a source that looked there does not see it (its field of view,
/// with what it saw as occluders; for the scanner the scan), they fall by log(1 - p), where p is
/// the probability that it would have seen it. If beams end on static points at the position of
/// another source's object, the object is static; this is decided before association, so that it is
/// not joined with a mover beside it. A pole is static unless it was seen to move.
///
/// The result depends neither on the order of a list's objects nor on earlier calls: no state.
class ObjectFuser {
 public:
  /// Throws OptionError.
  explicit ObjectFuser(const Checked<ObjectFuserOptions>& options);

  /// Fuses one set of lists, of which the first is the reference. There must be at least one, and
  /// all sources must be in the options (else std::out_of_range). `scan`: of the planar scanner at
  /// the reference's stamp, in its frame; null: unknown.
  ObjectFusionResult fuse(const std::vector<SourceObjects>& sources, const LabeledScan* scan) const;

 private:
  class Fusion;

  ObjectFuserOptions options_;
};

}  // namespace datmo
