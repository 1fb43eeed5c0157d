// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "simulator/laser_scanner.h"

namespace datmo::simulator {

namespace {

void visitMount(LaserScannerOptions& o, OptionVisitor& visitor) {
  visitor.number({"mount_x", "m", "scanner ahead of the rear axle; front bumper (thesis fig. 1.4)"},
                 o.mount_x, {-10.0, 10.0});
  visitor.number({"mount_y", "m", "scanner left of the vehicle's middle"}, o.mount_y, {-3.0, 3.0});
  visitor.number({"mount_heading", "deg", "scanner's x axis, to the left of the vehicle's"},
                 o.mount_heading, {-180.0, 180.0});
  visitor.number({"mount_height", "m", "scanner above the road; a bumper's height, assumed"},
                 o.mount_height, {0.05, 5.0});
}

void visitBeams(LaserScannerOptions& o, OptionVisitor& visitor) {
  visitor.number({"field_of_view", "deg", "thesis 1.3.3: 160"}, o.field_of_view, {1.0, 360.0});
  visitor.number({"beam_spacing", "deg", "thesis 1.3.3: 2 (81 beams), at best 1 (161 beams)"},
                 o.beam_spacing, {0.05, 30.0});
  visitor.number({"scan_rate", "Hz", "thesis 1.3.3: 16.6"}, o.scan_rate, {0.1, 100.0});
  visitor.number({"sweep_duration", "s",
                  "from the first to the last beam of a scan, which a moving vehicle distorts; 0: "
                  "all beams at once"},
                 o.sweep_duration, {0.0, 1.0});
  visitor.number({"min_range", "m", "thesis 1.3.3: 1"}, o.min_range, {0.0, 10.0});
  visitor.number({"max_range", "m", "of the hardware; thesis 1.3.3: 150"}, o.max_range,
                 {1.0, 500.0});
  visitor.number({"effective_range", "m",
                  "echoes beyond it are dropped; thesis 1.3.3: 50, because at most one beam hits a "
                  "farther object"},
                 o.effective_range, {1.0, 500.0});
  visitor.number({"horizontal_opening", "deg",
                  "width of a beam; assumed: as wide as the finest spacing of thesis 1.3.3"},
                 o.horizontal_opening, {0.0, 10.0});
  visitor.integer({"sub_rays", "1", "rays that sample the width of a beam"}, o.sub_rays, {1, 101});
  visitor.number({"vertical_opening", "deg", "of a beam in each plane; thesis 1.3.3: 3"},
                 o.vertical_opening, {0.0, 30.0});
  visitor.number({"second_plane_pitch", "deg",
                  "second plane above the horizontal one; thesis 1.3.3: 3, upwards assumed"},
                 o.second_plane_pitch, {-30.0, 30.0});
  visitor.integer({"echoes", "1",
                   "targets per beam: 2 as in thesis 1.3.3 (MultiEchoLaserScan), or 1, the nearest "
                   "(LaserScan)"},
                  o.echoes, {1, 2});
  visitor.number({"target_separation", "m",
                  "minimum difference in range of two targets (thesis 1.3.3 mentions the "
                  "threshold, but no value)"},
                 o.target_separation, {0.0, 50.0});
}

void visitFaults(LaserScannerOptions& o, OptionVisitor& visitor) {
  visitor.number({"full_detection_share", "1",
                  "share of a beam's width above which a target is always seen; below it the "
                  "probability falls in proportion: thin poles are missed (thesis 3.2.1)"},
                 o.full_detection_share, {0.01, 1.0});
  visitor.number({"range_noise", "m",
                  "standard deviation along the beam; the larger part of the noise (thesis 6), no "
                  "value given there"},
                 o.range_noise, {0.0, 5.0});
  visitor.number({"azimuth_noise", "deg", "standard deviation of each beam's direction"},
                 o.azimuth_noise, {0.0, 5.0});
  visitor.number(
      {"azimuth_shake", "deg",
       "standard deviation of a rotation of the whole scan: shaking beams (thesis 1.3.3)"},
      o.azimuth_shake, {0.0, 5.0});
  visitor.number(
      {"pitch_shake", "deg",
       "standard deviation of the pitch of the whole scan: shaking beams (thesis 1.3.3)"},
      o.pitch_shake, {0.0, 5.0});
  visitor.number(
      {"curb_hit_probability", "1", "probability that a beam that hits a curb is reflected by it"},
      o.curb_hit_probability, {0.0, 1.0});
  visitor.number({"paint_hit_probability", "1",
                  "probability that a beam that hits white paint on the road is reflected by it: "
                  "false returns from lane markings (thesis 1.3.3, fig. 3.8)"},
                 o.paint_hit_probability, {0.0, 1.0});
  visitor.number({"paint_range", "m", "longest range of returns from white paint"}, o.paint_range,
                 {0.0, 500.0});
}

}  // namespace

void LaserScannerOptions::visit(OptionVisitor& visitor) {
  visitMount(*this, visitor);
  visitBeams(*this, visitor);
  visitFaults(*this, visitor);
}

int LaserScannerOptions::beamCount() const {
  return static_cast<int>(std::lround(field_of_view / beam_spacing)) + 1;
}

}  // namespace datmo::simulator
