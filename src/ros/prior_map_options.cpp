// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/prior_map_options.h"

namespace datmo {

void PriorMapOptions::visit(OptionVisitor& visitor) {
  visitor.text({"file", "",
                "absolute path of a map to start in: one written by save_map, or a yaml file of "
                "map_server; empty: start a new map",
                Tier::kPublic},
               file, {});
  visitor.toggle({"anywhere", "", "search the whole map; false: near x, y, heading", Tier::kPublic},
                 anywhere);
  visitor.number(
      {"x", "m", "approximate start position of the vehicle in the map's frame", Tier::kPublic}, x,
      {-1e6, 1e6});
  visitor.number({"y", "m", "the same", Tier::kPublic}, y, {-1e6, 1e6});
  visitor.number({"heading", "rad", "the same", Tier::kPublic}, heading, {-kTurn, kTurn});
  visitor.number({"position_sigma", "m", "standard deviation of x and y"}, position_sigma,
                 {0.01, 1000.0});
  visitor.number({"heading_sigma", "rad", "standard deviation of the heading"}, heading_sigma,
                 {0.001, kPi});
}

SearchRegion PriorMapOptions::start() const {
  SearchRegion region;
  region.anywhere = anywhere;
  region.prior.pose = {x, y, heading};
  region.prior.covariance =
      Eigen::Vector3d(position_sigma * position_sigma, position_sigma * position_sigma,
                      heading_sigma * heading_sigma)
          .asDiagonal();
  return region;
}

}  // namespace datmo
