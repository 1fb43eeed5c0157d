#pragma once

#include <cstddef>
#include <vector>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/tracking/target.h"

namespace datmo {

struct AssociationOptions {
  double gate = 13.8;             ///< 1
  double birth_density = 2.5e-4;  ///< 1/m^2

  void visit(OptionVisitor& visitor);
};

/// Which object is seen of which target. Each target and each object is named once.
struct Association {
  struct Pair {
    std::size_t target;
    std::size_t object;
  };
  std::vector<Pair> pairs;               ///< by rising target
  std::vector<std::size_t> missed;       ///< targets without an object
  std::vector<std::size_t> unexplained;  ///< objects of no target: new, or false
};

/// Decides in each scan which object belongs to which target. Multiple hypotheses (Reid 1979;
/// thesis 3.3.4) will be another implementation.
class Associator {
 public:
  virtual ~Associator() = default;

  /// Targets predicted to the time of the objects, which are in the fixed frame.
  virtual Association associate(const std::vector<Target>& targets,
                                const std::vector<Object>& objects) const = 0;
};

/// The one most likely association of this scan by itself. A pair scores the log-likelihood ratio
/// of "seen, and this is it" against "a new object, and the target was missed" (Bar-Shalom, Li,
/// Kirubarajan 2001; Blackman, Multiple Hypothesis Tracking for Multiple Target Tracking, 2004);
/// the sum over all pairs is optimal.
class GlobalNearestNeighbour : public Associator {
 public:
  explicit GlobalNearestNeighbour(const AssociationOptions& options) : options_(options) {}

  Association associate(const std::vector<Target>& targets,
                        const std::vector<Object>& objects) const override;

 private:
  double cost(const Target& target, const Object& object) const;

  AssociationOptions options_;
};

}  // namespace datmo
