// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>

#include "arguments.h"

namespace datmo {

/// Takes a bag through the pipeline, in the order of the messages' record times, as fast as it
/// goes, and writes what comes out to a bag: /pose, /map, /labeled_scan, /objects, /tracks, /tf.
/// With --until some of them, with --write-grids /grids/* too, with --road-border /road_borders
/// and /objects/dropped, with --object-fusion /objects/stereo and /objects/fused, with
/// --track-fusion /objects/stereo, /tracks/lidar and /tracks/stereo. Prints a table to `out` at the
/// end and a bar to `progress` (null: none); with --quiet neither. With --times it
/// writes the stages' times to a JSON file.
///
/// Throws NoUsableInput if all messages on a topic were refused, no scan could be used or no tracks
/// came out; std::exception else, with a message for people: a bag that cannot be read, a topic or
/// an option that is wrong, an interruption. No output bag is left behind then.
void runBag(const Arguments& arguments, std::ostream& out, std::ostream* progress);

}  // namespace datmo
