// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "datmo_fusion/risk/host_motion.h"

namespace datmo {

/// The host, as it would go, and what it would touch.
struct Encounter {
  const BodyPath& host;
  const BodySize& host_size;
  const BodyPath& other;
  const BodySize& other_size;
};

/// The host's path if it brakes with `deceleration` (m/s^2, at least 0) from `start` (s) on, on the
/// same line: it comes to rest, and stays.
BodyPath braked(const BodyPath& host, double start, double deceleration);

/// The host's path if it steers aside from now on with that lateral acceleration (m/s^2, positive
/// to the left) on top of its own.
BodyPath steered(const BodyPath& host, double lateral);

/// How long the host can wait until it must brake with `max_braking` (m/s^2, more than 0) so that
/// there is no contact, s: 0 where that comes too late, the paths' duration where nothing is
/// touched (time to brake; Hillenbrand, Spieker, Kroschel, A Multilevel Collision Mitigation
/// Approach, IEEE Trans. ITS 7(4), 2006).
double timeToBrake(const Encounter& encounter, double max_braking);

/// The deceleration that avoids contact if the host brakes now, over `max_braking`: more than 1
/// cannot be reached (brake threat number; Brännström, Coelingh, Sjöberg, Model-Based Threat
/// Assessment for Avoiding Arbitrary Vehicle Collisions, IEEE Trans. ITS 11(3), 2010). 0: no
/// contact without braking; kHopeless: not even four times as much is enough.
double brakeThreat(const Encounter& encounter, double max_braking);

/// The same for the lateral acceleration that avoids contact to the left or to the right, the
/// smaller one, over `max_lateral` (steer threat number).
double steerThreat(const Encounter& encounter, double max_lateral);

/// A threat number of what nothing avoids.
inline constexpr double kHopeless = 4.0;

/// The time between one body leaving the ground that both paths share and the other reaching it, s:
/// the least time by which one of them must be shifted for them to touch (post-encroachment time;
/// Allen, Shin, Cooper, Analysis of Traffic Conflicts and Collisions, TRR 667, 1978, predicted). 0:
/// they touch; infinite: their paths share no ground.
double postEncroachmentTime(const Encounter& encounter);

}  // namespace datmo
