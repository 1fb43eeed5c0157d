// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "simulator/random_stream.h"
#include "simulator/ray_caster.h"
#include "simulator/viewpoint.h"
#include "simulator/world.h"

#include "datmo_fusion/common/options.h"

namespace datmo::simulator {

/// The demonstrator's scanner, a Hella IDIS 2.0 (thesis 1.3.3), and its faults.
struct LaserScannerOptions {
  double mount_x = 3.6;        ///< m
  double mount_y = 0.0;        ///< m
  double mount_heading = 0.0;  ///< deg
  double mount_height = 0.45;  ///< m

  double field_of_view = 160.0;   ///< deg
  double beam_spacing = 2.0;      ///< deg
  double scan_rate = 16.6;        ///< Hz
  double sweep_duration = 0.0;    ///< s
  double min_range = 1.0;         ///< m
  double max_range = 150.0;       ///< m
  double effective_range = 50.0;  ///< m

  double horizontal_opening = 1.0;    ///< deg
  int sub_rays = 5;                   ///< per beam
  double vertical_opening = 3.0;      ///< deg
  double second_plane_pitch = 3.0;    ///< deg
  int echoes = 2;                     ///< per beam
  double target_separation = 1.0;     ///< m
  double full_detection_share = 0.4;  ///< of a beam's width

  double range_noise = 0.2;            ///< m
  double azimuth_noise = 0.1;          ///< deg
  double azimuth_shake = 0.2;          ///< deg
  double pitch_shake = 0.3;            ///< deg
  double curb_hit_probability = 0.5;   ///< 0 to 1
  double paint_hit_probability = 0.1;  ///< 0 to 1
  double paint_range = 30.0;           ///< m

  void visit(OptionVisitor& visitor);

  /// Beams from the right border of the field of view to the left one.
  int beamCount() const;
};

/// One echo of a beam.
struct Echo {
  double range = 0.0;                ///< m, measured
  std::uint32_t object = kNoObject;  ///< of the object that reflected it
  Surface surface = Surface::kBody;  ///< that reflected it
  double true_range = 0.0;           ///< m, without noise
};

/// One measurement of all beams, from right to left.
struct EchoScan {
  double time = 0.0;                     ///< s, of the first beam
  std::vector<std::vector<Echo>> beams;  ///< echoes in order of range; none: no return
};

/// Scans a world.
///
/// A beam measures in two planes: the horizontal one and a second one above it; in each it
/// illuminates a band of heights and some width. A target that differs in range from the first one
/// is a second echo, whether from the other plane or from the beam's other half.
class LaserScanner {
 public:
  /// Throws OptionError for options that contradict each other.
  LaserScanner(const LaserScannerOptions& options, const RandomStream& random);

  /// The scan that starts at `time` (s); scans must be requested in order of time.
  EchoScan measure(const World& world, double time);

  Viewpoint viewpoint() const;

 private:
  /// Errors of one beam.
  struct BeamFaults {
    double azimuth = 0.0;  ///< rad
    double pitch = 0.0;    ///< rad
    bool curbs = false;    ///< curbs reflect this time
    bool paint = false;    ///< paint reflects this time
  };

  std::vector<Echo> measureBeam(const RayCaster& caster, const Pose2& scanner, double bearing,
                                const BeamFaults& faults);
  /// Groups the hits of one plane by range into targets, and drops some of the thin ones.
  void addTargets(const RayCaster& caster, double heading, double plane_pitch,
                  const BeamFaults& faults, std::vector<Echo>& targets);
  /// Hits of the sub-rays in one plane, in order of range.
  std::vector<Echo> castBeam(const RayCaster& caster, double heading, double plane_pitch,
                             const BeamFaults& faults) const;
  std::optional<RayHit> castSubRay(const RayCaster& caster, double heading, const HeightBand& band,
                                   const BeamFaults& faults) const;
  /// The nearest targets that are sufficiently separated, with noise and within the range limits.
  std::vector<Echo> reported(std::vector<Echo> targets);

  LaserScannerOptions options_;
  RandomStream random_;
};

}  // namespace datmo::simulator
