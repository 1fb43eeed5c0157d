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

/// Brings tracks and truth together: a frame for each message with tracks, at its stamp and in the
/// map of the truth, and one without tracks for each stamp of the truth at which the run is silent
/// (ScoreOptions::max_silence), so before its first tracks and after its last ones as well.
///
/// Left out are tracks that do not count: those that stand, if moving ones alone are wanted, and
/// those out of the region that are not on an object that has to be found.
///
/// `estimated`: poses of the run; `alignment`: of its map, none: not known, or not wanted.
BuiltFrames buildFrames(const std::vector<RecordedTracks>& tracks, const Trajectory& estimated,
                        const std::optional<Alignment>& alignment, const TrueScene& scene,
                        const ScoreOptions& options);

}  // namespace datmo::evaluation
