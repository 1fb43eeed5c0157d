// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/detection/stereo_object_detector.h"

namespace datmo {

void StereoSurfaceOptions::visit(OptionVisitor& visitor) {
  visitor.number({"min_depth", "m", "nearer points are mismatches", Tier::kPublic}, min_depth,
                 {0.05, 10.0});
  visitor.number({"min_height", "m", "lower points are of the road, curbs and low plants"},
                 min_height, {0.05, 2.0});
  visitor.number({"max_height", "m", "up to here it is looked how high objects are"}, max_height,
                 {2.0, 20.0});
  visitor.number({"finest_depth", "m", "resolution of depths: not finer than this"}, finest_depth,
                 {0.02, 1.0});
  visitor.integer({"min_points", "1", "points that must be seen in a column"}, min_points,
                  {1, 1000});
}

void SurfaceGroupOptions::visit(OptionVisitor& visitor) {
  visitor.number({"depth_gap", "m", "neighboring surfaces of one object differ in depth by less"},
                 depth_gap, {0.01, 5.0});
  visitor.number({"depth_sigmas", "1", "or by so many standard deviations of the depth"},
                 depth_sigmas, {0.0, 10.0});
  visitor.number(
      {"tall", "m", "what is higher than this does not belong to what is lower than low"}, tall,
      {0.5, 20.0});
  visitor.number({"low", "m", "see tall"}, low, {0.3, 20.0});
}

void StereoNoiseOptions::visit(OptionVisitor& visitor) {
  visitor.number({"common", "1",
                  "standard deviation of an object's depth, in those of a single point's: what all "
                  "its points have in common"},
                 common, {0.0, 5.0});
  visitor.number({"column", "1",
                  "the same of the depth of one column of an object's points against the others"},
                 column, {0.0, 5.0});
  visitor.number({"correlated_width", "px",
                  "of matching windows or paths: points so far apart in the image have half of "
                  "their noise in common"},
                 correlated_width, {0.0, 512.0});
  visitor.number({"edge_sigma", "px", "standard deviation of where a surface ends in the image"},
                 edge_sigma, {0.0, 20.0});
  visitor.number(
      {"body_sigma", "m", "standard deviation of what bodies differ from boxes along each axis"},
      body_sigma, {0.001, 2.0});
  visitor.number({"height_sigma", "m", "standard deviation of heights, besides that of the edge"},
                 height_sigma, {0.001, 2.0});
}

void StereoObjectDetectorOptions::visit(OptionVisitor& visitor) {
  visitor.group("surfaces", [&] { surfaces.visit(visitor); });
  visitor.group("groups", [&] { groups.visit(visitor); });
  visitor.group("noise", [&] { noise.visit(visitor); });
  visitor.group("classes", [&] { classes.visit(visitor); });
  RoadSceneOptions::visit(visitor);
  visitor.number(
      {"sure_range", "m", "up to here all is found that can be seen; from there on less and less",
       Tier::kPublic},
      sure_range, {1.0, 200.0});
  visitor.number({"min_surface", "m^2", "an object of which less is seen is none"}, min_surface,
                 {0.0, 10.0});
  visitor.number({"max_size", "m", "longer segments are no objects: walls, hedges", Tier::kPublic},
                 max_size, {0.5, 100.0});
  visitor.number({"max_doubt", "1",
                  "at most so much evidence against an object is its size: logarithm of odds"},
                 max_doubt, {0.0, 20.0});
}

}  // namespace datmo
