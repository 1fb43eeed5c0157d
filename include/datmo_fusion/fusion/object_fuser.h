#pragma once

#include <map>
#include <string>
#include <vector>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/pose2.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/tracking/visibility.h"

namespace datmo {

/// One source of objects.
struct ObjectSourceOptions {
  bool use = true;

  void visit(OptionVisitor& visitor);
};

struct ObjectFuserOptions {
  std::map<std::string, ObjectSourceOptions> sources;  ///< by name; at first lidar and stereo

  ObjectFuserOptions();

  void visit(OptionVisitor& visitor);

  /// Names of the sources that are in use.
  std::vector<std::string> sourcesInUse() const;
};

/// The objects of one source, to be fused with others.
struct SourceObjects {
  std::string source;
  ObjectList list;          ///< vehicle's frame at the list's own stamp
  Pose2 base_in_reference;  ///< of the vehicle at that stamp, in its frame at the reference's stamp
};

/// What became of the objects of one set of lists.
struct ObjectFusionCounts {
  std::size_t rejected = 0;  ///< not valid (isValid)
  std::size_t refused = 0;   ///< beyond the most of one list: the farthest
  std::size_t fused = 0;     ///< objects that two or more sources see
};

struct ObjectFusionResult {
  ObjectList list;  ///< vehicle's frame at the reference's stamp
  ObjectFusionCounts counts;
};

/// Lists of objects of several sources -> one list (thesis 3.3.3).
class ObjectFuser {
 public:
  /// Throws OptionError.
  explicit ObjectFuser(const ObjectFuserOptions& options);

  /// The first list is the reference; all sources must be in the options (else std::out_of_range).
  /// `scan`: what the planar scanner saw at the reference's stamp, in its frame; null: not known.
  ObjectFusionResult fuse(const std::vector<SourceObjects>& sources, const SplitScan* scan) const;

 private:
  ObjectFuserOptions options_;
};

}  // namespace datmo
