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

/// Inverse sensor model of a laser scanner: the evidence of one scan on each cell around the
/// vehicle (thesis 3.2.1, eq. 3.2.1). Free along each beam, over its opening angle; occupied where
/// it ends, across its width; unknown behind, within the range uncertainty before the end, and
/// where there are no beams.
///
/// Input: a motion-compensated Scan (slam/motion_compensation). Output: for grid fusion. Beyond the
/// thesis: a beam is as wide as its opening angle, not as the beam spacing; a beam without return
/// is free as far as it is known to see.
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
