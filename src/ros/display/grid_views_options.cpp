// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/display/grid_views_options.h"

#include <algorithm>
#include <sstream>

#include "datmo_fusion/ros/topic_name.h"

namespace datmo {

void GridViewsOptions::visit(OptionVisitor& visitor) {
  const Bounds length{1.0, 500.0};
  visitor.text({"panels", "",
                "panels from left to right: sources of grid_fusion by name, `fused`, `conflict`, "
                "`map`; separated by spaces",
                Tier::kPublic},
               panels, {});
  visitor.number({"ahead", "m", "visible distance ahead of the vehicle", Tier::kPublic}, ahead,
                 length);
  visitor.number({"behind", "m", "visible distance behind it"}, behind, {0.0, length.max});
  visitor.number({"to_side", "m", "visible distance to each side of it"}, to_side, length);
  visitor.number({"pixels_per_meter", "px/m", "scale of all panels"}, pixels_per_meter,
                 {0.5, 50.0});
  visitor.number({"rate", "Hz", "maximum number of pictures per second"}, rate, {0.1, 30.0});
  visitor.number({"silent_after", "s",
                  "a grid older than the newest one by more than this is no longer drawn, nor is "
                  "one from before the clock jumped back by as much"},
                 silent_after, {0.1, 60.0});
}

std::vector<std::string> GridViewsOptions::panelNames() const {
  std::istringstream text(panels);
  std::vector<std::string> names;
  for (std::string name; text >> name;) {
    if (!canBeTopic(name) || std::find(names.begin(), names.end(), name) != names.end()) {
      throw OptionError("panels = '" + panels + "': '" + name +
                        "' is given twice or cannot be the name of a topic; expected names of "
                        "letters, digits and underscores, each once");
    }
    names.push_back(name);
  }
  if (names.empty()) {
    throw OptionError("panels = '" + panels + "': expected at least one name");
  }
  return names;
}

}  // namespace datmo
