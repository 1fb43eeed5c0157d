// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>

#include "arguments.h"

namespace datmo {

/// Processes a bag with the stages, in the order of the messages' record times, as fast as
/// possible, and writes the results to a bag: /pose, /localization, /map, /labeled_scan, /objects,
/// /tracks, /tf. With --until only some of them, with --write-grids also /grids/*, with
/// --road-border /road_borders and /objects/dropped, with --object-fusion /objects/stereo and
/// /objects/fused, with --track-fusion /objects/stereo, /tracks/lidar and /tracks/stereo. Prints a
/// table to `out` at the end and a bar to `progress` (null: none); with --quiet neither. With
/// --times the processing times of the stages are written to a JSON file.
///
/// Throws NoUsableInput if all messages on a topic were rejected, no scan could be used or no
/// tracks were produced; otherwise std::exception with a readable message: a bag that cannot be
/// read, an invalid topic or option, an interruption. No output bag is left in these cases.
void runBag(const Arguments& arguments, std::ostream& out, std::ostream* progress);

}  // namespace datmo
