// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "simulator/random_stream.h"
#include "simulator/viewpoint.h"
#include "simulator/world.h"

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/common/options.h"

namespace datmo::simulator {

/// A camera with an image detector, simulated by its reports, not by images. Its errors are those
/// of a given confusion matrix, so that fusion of classes can be measured over seeds.
struct ClassCameraOptions {
  bool enabled = false;
  double mount_x = 1.8;                  ///< m
  double mount_y = 0.0;                  ///< m
  double mount_height = 1.3;             ///< m
  double field_of_view = degrees(80.0);  ///< rad
  double range = 50.0;                   ///< m
  double rate = 10.0;                    ///< Hz
  double latency = 0.1;                  ///< s
  double min_visible_share = 0.5;        ///< 0 to 1
  double bearing_sigma = degrees(0.5);   ///< rad
  double range_share = 0.15;             ///< 1
  /// 0 to 1, shares: rows are the true classes pedestrian, cyclist, vehicle, columns the reported
  /// ones.
  std::vector<double> confusion = {0.85, 0.1, 0.0, 0.1, 0.82, 0.0, 0.0, 0.01, 0.95};

  void visit(OptionVisitor& visitor);
  /// Throws OptionError for a matrix of another size, or with a row of more than 1.
  void check() const;
};

/// The objects of a world as a detector in a camera's images reports them: bearing and range by
/// size, with consistent covariances, and a class whose probability follows from the confusion
/// matrix with equal priors.
class ClassCamera {
 public:
  /// Throws OptionError.
  ClassCamera(const Checked<ClassCameraOptions>& options, RandomStream random)
      : options_(*options), random_(std::move(random)) {}

  /// Objects in the vehicle's frame, without a stamp. Poles are not reported.
  ObjectList measure(const World& world, double time);

  Viewpoint viewpoint() const;

 private:
  /// The class reported for an object of this class; kUnknown: not reported.
  ObjectClass drawnReport(ObjectClass object_class);
  /// Given this report, if pedestrians, cyclists and vehicles were equally frequent.
  ClassProbabilities probabilitiesOf(ObjectClass reported) const;
  /// Whether some of it may be in range: most objects of a long street are not, and to look at one
  /// takes longer than all else.
  bool isNear(const ObjectState& object, const Pose2& base) const;
  Object seen(const ObjectState& object, const Pose2& base, ObjectClass reported);

  ClassCameraOptions options_;
  RandomStream random_;
};

}  // namespace datmo::simulator
