// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/detection/stereo_object_detector.h"

namespace datmo {

void StereoSurfaceOptions::visit(OptionVisitor& visitor) {
  visitor.number({"min_depth", "m", "nearer points are mismatches", Tier::kPublic}, min_depth,
                 {0.05, 10.0});
  visitor.number({"min_height", "m", "lower points belong to the road, curbs and low plants"},
                 min_height, {0.05, 2.0});
  visitor.number({"max_height", "m", "objects' heights are measured up to here"}, max_height,
                 {2.0, 20.0});
  visitor.number({"finest_depth", "m", "finest resolution of depths"}, finest_depth, {0.02, 1.0});
  visitor.integer({"min_points", "1", "minimum number of points in a column"}, min_points,
                  {1, 1000});
}

void SurfaceGroupOptions::visit(OptionVisitor& visitor) {
  visitor.number(
      {"depth_sigmas", "1",
       "neighboring surfaces belong to one object, too, if their depths differ by less than this "
       "many standard deviations"},
      depth_sigmas, {0.0, 10.0});
  visitor.number({"tall", "m", "a surface higher than this does not belong to one lower than low"},
                 tall, {0.5, 20.0});
  visitor.number({"low", "m", "see tall"}, low, {0.3, 20.0});
}

void StereoNoiseOptions::visit(OptionVisitor& visitor) {
  visitor.number({"common", "1",
                  "standard deviation of the error that all points of an object have in common, as "
                  "a multiple of a single point's"},
                 common, {0.0, 5.0});
  visitor.number(
      {"column", "1",
       "the same for the depth of one column of an object's points relative to the others"},
      column, {0.0, 5.0});
  visitor.number(
      {"correlated_width", "px",
       "width of matching windows or paths: points this far apart in the image have half of "
       "their noise in common"},
      correlated_width, {0.0, 512.0});
  visitor.number({"edge_sigma", "px", "standard deviation of the edge of a surface in the image"},
                 edge_sigma, {0.0, 20.0});
  visitor.number({"body_sigma", "m",
                  "standard deviation of the difference between bodies and boxes along each axis"},
                 body_sigma, {0.001, 2.0});
  visitor.number(
      {"height_sigma", "m", "standard deviation of heights, in addition to that of the edge"},
      height_sigma, {0.001, 2.0});
}

void StereoObjectDetectorOptions::visit(OptionVisitor& visitor) {
  visitor.group("surfaces", [&] { surfaces.visit(visitor); });
  visitor.group("groups", [&] { groups.visit(visitor); });
  visitor.group("noise", [&] { noise.visit(visitor); });
  visitor.group("classes", [&] { classes.visit(visitor); });
  RoadSceneOptions::visit(visitor);
  visitor.number(
      {"sure_range", "m", "up to here every visible object is detected; beyond, fewer and fewer",
       Tier::kPublic},
      sure_range, {1.0, 200.0});
  visitor.number(
      {"max_size", "m", "longer segments are not objects but walls or hedges", Tier::kPublic},
      max_size, {0.5, 100.0});
  visitor.number(
      {"max_doubt", "1", "most evidence that an unusual size can be against an object: log odds"},
      max_doubt, {0.0, 20.0});
}

}  // namespace datmo
