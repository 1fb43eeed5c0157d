// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/options.h"
#include "datmo_fusion/common/scan.h"
#include "datmo_fusion/grid/beam_end.h"
#include "datmo_fusion/grid/grid_window_options.h"
#include "datmo_fusion/grid/sensor_grid.h"

namespace datmo {

struct LidarGridOptions {
  GridWindowOptions window;
  double occupied_probability = 0.8;
  double free_probability = 0.2;
  double beam_width = 0.0;               ///< rad
  double min_incidence = degrees(10.0);  ///< rad
  BeamEndOptions beam_end;

  void visit(OptionVisitor& visitor);
};

/// One scan -> its evidence on each cell around the vehicle: the inverse sensor model of a laser
/// scanner (thesis 3.2.1, eq. 3.2.1). Free along each beam, as wide as the beam opens; occupied
/// where it ends, across its width; unknown behind, nearer to the end than its range is uncertain,
/// and where no beam looks.
///
/// In: a Scan that is compensated for the vehicle's motion (slam/motion_compensation). Out: to
/// grid fusion. Beyond the thesis: a beam is as wide as it opens, not as its neighbors are apart;
/// a beam without return is free as far as it is known to see.
class LidarGridModel {
 public:
  /// Throws OptionError.
  explicit LidarGridModel(const Checked<LidarGridOptions>& options);

  SensorGrid grid(const Scan& scan) const;

 private:
  LidarGridOptions options_;
  GridWindow window_;
};

}  // namespace datmo
