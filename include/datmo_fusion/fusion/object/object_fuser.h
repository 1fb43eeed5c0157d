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

  /// By how much those of them may be late that are not waited for, s.
  std::map<std::string, double> lateSources() const;
};

/// The objects of one source, to be fused with others.
struct SourceObjects {
  std::string source;
  ObjectList list;          ///< vehicle's frame at the list's own stamp
  Pose2 base_in_reference;  ///< of the vehicle at that stamp, in its frame at the reference's stamp
};

/// What became of the objects of one set of lists.
struct ObjectFusionCounts {
  std::size_t rejected = 0;       ///< not valid (isValid)
  std::size_t refused = 0;        ///< beyond the most of one list: the farthest
  std::size_t fused = 0;          ///< objects that two or more sources see
  std::size_t names_of_gone = 0;  ///< classes of another source's object that is not there
};

/// One list of all sources.
struct ObjectFusionResult {
  ObjectList list;  ///< vehicle's frame at the reference's stamp
  ObjectFusionCounts counts;
};

/// Lists of objects of several sources -> one list (thesis 3.3.3).
///
/// Every list is moved by the vehicle's own motion to where the vehicle is at the reference's
/// stamp; its objects stay where they were at their own time, which `delay` gives. Then each list
/// in turn is associated with what there is (associate), pairs are fused (combined), and all other
/// objects kept.
///
/// That it is an object at all: seen by one more source, the log-odds rise by
/// log(detection_probability / false_agreement_probability); not seen by one that looked there (its
/// view, with what it saw as occluders; of the scanner the scan) they fall by log(1 - p), p being
/// that it would have been seen. Where beams end on static points at the position of an object of
/// another source, it stands still: known before the association, so that it is not joined with
/// what moves beside it. So does a pole, unless it was seen to move.
///
/// Neither the order of a list's objects nor anything before matters. No state.
class ObjectFuser {
 public:
  /// Throws OptionError.
  explicit ObjectFuser(const Checked<ObjectFuserOptions>& options);

  /// The first list is the reference; all sources must be in the options, and there must be one
  /// (else std::out_of_range).
  /// `scan`: what the planar scanner saw at the reference's stamp, in its frame; null: not known.
  ObjectFusionResult fuse(const std::vector<SourceObjects>& sources, const LabeledScan* scan) const;

 private:
  class Fusion;

  ObjectFuserOptions options_;
};

}  // namespace datmo
