// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "simulator/disparity_image.h"
#include "simulator/random_stream.h"

namespace datmo::simulator {

/// Faults of stereo matching, in the order in which they are applied to an image. Each changes only
/// `measured`.

/// Removes what the right camera does not see: background beside the left edge of nearer objects,
/// and what is left of the right image.
void removeHidden(DisparityImage& image);

/// At most `width` px beside a nearer object, and with this probability (0 to 1), background gets a
/// disparity between its own and the nearer one.
void mixEdges(DisparityImage& image, int width, double probability, RandomStream& random);

/// Adds noise of standard deviation `sigma` (px); `common_share` (0 to 1) of its variance is
/// common to neighbors, over patches of `patch` px.
void addNoise(DisparityImage& image, double sigma, double common_share, int patch,
              RandomStream& random);

/// Wrong matches: a share (0 to 1) of all patches of `patch` px gets a random disparity from `min`
/// to `max` px.
void addOutliers(DisparityImage& image, double share, int patch, double min, double max,
                 RandomStream& random);

}  // namespace datmo::simulator
