// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "evaluate/recorded_data.h"
#include "evaluate/score_options.h"
#include "evaluate/trajectory.h"
#include "evaluate/true_scene.h"

namespace datmo::evaluation {

/// The frames of a run, and what could not be scored.
struct BuiltFrames {
  Frames frames;
  std::size_t left_out = 0;  ///< messages with tracks at whose stamp truth or pose is not known
};

/// Combines tracks and truth: a frame for each message with tracks, at its stamp and in the map of
/// the truth, and one without tracks for each stamp of the truth at which the run is silent
/// (ScoreOptions::max_silence), hence also before its first tracks and after its last ones.
///
/// Tracks that do not count are omitted: stationary ones, if only moving ones are scored, and those
/// outside the region that are not on an object that has to be found.
///
/// `estimated`: poses of the run; `alignment`: of its map, none: not known, or not requested.
BuiltFrames buildFrames(const std::vector<RecordedTracks>& tracks, const Trajectory& estimated,
                        const std::optional<Alignment>& alignment, const TrueScene& scene,
                        const ScoreOptions& options);

}  // namespace datmo::evaluation
